// SPDX-License-Identifier: GPL-3.0-or-later
#include "unknown_option.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

namespace pgdr::app {

namespace {

/// How many letters have to be added, taken away, replaced or swapped with their neighbour (Damerau, 1964).
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

}  // namespace

std::optional<std::string> unknown_option_text(const CLI::App& parser) {
  constexpr std::size_t most_slips = 3;
  const std::vector<std::string> unknown = parser.remaining(true);
  const auto option = std::ranges::find_if(unknown, [](const std::string& word) { return word.starts_with('-'); });
  if (option == unknown.end()) return std::nullopt;
  const std::string typed = option->substr(0, option->find('='));
  std::string nearest;
  std::size_t slips = std::min(most_slips, typed.size() / 2) + 1;
  for (const CLI::Option* known : parser.get_options())
    for (const std::string& name : known->get_lnames())
      if (const std::size_t d = distance(typed, "--" + name); d < slips) {
        slips = d;
        nearest = name;
      }
  return "there is no option " + typed + (nearest.empty() ? "" : "; did you mean --" + nearest + "?");
}

std::optional<std::string> empty_value_text(const CLI::App& parser) {
  for (const CLI::Option* option : parser.get_options())
    if (option->get_items_expected_max() > 0 && std::ranges::any_of(option->results(), &std::string::empty)) return option->get_name() + " has an empty value";
  return std::nullopt;
}

}  // namespace pgdr::app
