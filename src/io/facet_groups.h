// SPDX-License-Identifier: GPL-3.0-or-later
// Private to src/io: which facets of a surface file belong together, and what the file calls them.
#ifndef PGDR_SRC_IO_FACET_GROUPS_H
#define PGDR_SRC_IO_FACET_GROUPS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/default_kernel.h>

namespace pgdr::io_detail {

/// A name as UTF-8, which outputs are written in: one that is not is taken for Latin-1.
inline std::string as_utf8(const std::string& name) {
  bool is_valid = true;
  for (std::size_t i = 0; i < name.size() && is_valid;) {
    const auto byte = [&](std::size_t k) { return k < name.size() ? static_cast<unsigned char>(name[k]) : 0u; };
    const std::size_t length = byte(i) < 0x80 ? 1 : byte(i) < 0xc2 ? 0 : byte(i) < 0xe0 ? 2 : byte(i) < 0xf0 ? 3 : byte(i) < 0xf5 ? 4 : 0;
    is_valid = length > 0;
    for (std::size_t k = 1; k < length; ++k) is_valid = is_valid && (byte(i + k) & 0xc0) == 0x80;
    i += length;
  }
  if (is_valid) return name;
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) text += static_cast<char>(0xc0 | byte >> 6);
    text += static_cast<char>(byte < 0x80 ? byte : 0x80 | (byte & 0x3f));
  }
  return text;
}

/// "#ff8000", of red, green and blue from 0 to 255.
inline std::string color_name(const std::array<double, 3>& rgb) {
  constexpr const char* digits = "0123456789abcdef";
  std::string name = "#";
  for (const double x : rgb) {
    const auto level = static_cast<unsigned>(x > 0 ? std::min(x + 0.5, 255.0) : 0.0);
    name += digits[level / 16];
    name += digits[level % 16];
  }
  return name;
}

/// Facets by the names that hold where they stand. A name has two parts, as in an OBJ file, where a facet has a group and a material.
class Facet_groups {
 public:
  using Name = std::pair<std::string, std::string>;

  /// What the facets that follow are called; either part may be empty.
  void enter(Name name) {
    if (!groups_.empty() && name == names_[current_]) return;
    const auto [found, is_new] = groups_.try_emplace(std::move(name), static_cast<std::uint32_t>(names_.size()));
    if (is_new) names_.push_back(found->first);
    current_ = found->second;
  }
  void enter(std::string name) { enter(Name(std::move(name), std::string())); }

  /// The next facet.
  void add_facet() {
    if (names_.empty()) enter(Name());
    of_facet_.push_back(current_);
  }

  /// Gives the facets of a surface their markers: 1, 2, ... in the order in which the groups begin where there are several, else 0.
  void mark(Plc& plc) const {
    std::vector<int> marker(names_.size(), 0);
    std::vector<std::uint32_t> used;
    for (const std::uint32_t g : of_facet_) {
      if (marker[g] != 0) continue;
      used.push_back(g);
      marker[g] = static_cast<int>(used.size());
    }
    const bool is_one = used.size() == 1;
    if (used.size() > 1)
      for (std::size_t f = 0; f < plc.facets.size(); ++f) plc.facets[f].marker = marker[of_facet_[f]];
    const bool by_first = tells_apart(&Name::first, used), by_second = tells_apart(&Name::second, used);
    for (const std::uint32_t g : used)
      if (std::string name = by_first ? names_[g].first : by_second ? names_[g].second : both(names_[g]); !name.empty()) plc.names.markers[is_one ? 0 : marker[g]] = as_utf8(name);
  }

 private:
  /// Whether one part of their names tells all groups apart.
  bool tells_apart(std::string Name::*part, const std::vector<std::uint32_t>& used) const {
    std::set<std::string> values;
    for (const std::uint32_t g : used)
      if ((names_[g].*part).empty() || !values.insert(names_[g].*part).second) return false;
    return true;
  }

  static std::string both(const Name& name) { return name.first.empty() || name.second.empty() ? name.first + name.second : name.first + ":" + name.second; }

  std::map<Name, std::uint32_t> groups_;
  std::vector<Name> names_;
  std::vector<std::uint32_t> of_facet_;
  std::uint32_t current_ = 0;
};

}  // namespace pgdr::io_detail

#endif
