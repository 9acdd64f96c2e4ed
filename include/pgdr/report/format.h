// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPORT_FORMAT_H
#define PGDR_REPORT_FORMAT_H

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

namespace pgdr {

/// "1,234,567".
inline std::string with_separators(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

/// `digits` significant digits, without trailing zeros.
inline std::string significant(double value, int digits = 4) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// `digits` digits after the point.
inline std::string fixed(double value, int digits = 2) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

/// "3 tetrahedra", "1 tetrahedron".
inline std::string counted(std::uint64_t count, const std::string& one, const std::string& many) {
  return with_separators(count) + " " + (count == 1 ? one : many);
}

/// "a, b, c": the texts of items, with something in between.
template <class Range, class Text = std::identity>
std::string joined(const Range& items, const std::string& between = ", ", Text text = {}) {
  std::string all;
  bool is_first = true;
  for (const auto& item : items) {
    if (!std::exchange(is_first, false)) all += between;
    all += text(item);
  }
  return all;
}

/// "517 MiB": binary units, three significant digits.
inline std::string memory_size(std::size_t bytes) {
  static constexpr const char* units[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (value >= 1000 && unit + 1 < std::size(units)) {
    value /= 1024;
    ++unit;
  }
  return significant(value, 3) + " " + units[unit];
}

}  // namespace pgdr

#endif
