// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_SIZING_PLACES_H
#define PGDR_SIZING_SIZING_PLACES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pgdr {

namespace sizing_detail {

/// Of any vector whose components are doubles, their squares or not.
inline double length(const std::array<double, 3>& v) {
  const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  if (!(largest > 0)) return 0;
  double squared = 0;
  for (const double x : v) squared += (x / largest) * (x / largest);
  return largest * std::sqrt(squared);
}

}  // namespace sizing_detail

/// A closed axis-aligned box in which circumradii are at most `radius`.
struct Sizing_box {
  std::array<double, 3> lower{};
  std::array<double, 3> upper{};
  double radius = 0;

  bool contains(const std::array<double, 3>& p) const {
    return lower[0] <= p[0] && p[0] <= upper[0] && lower[1] <= p[1] && p[1] <= upper[1] && lower[2] <= p[2] && p[2] <= upper[2];
  }

  /// How far p is from the box; 0 inside.
  double distance(const std::array<double, 3>& p) const {
    std::array<double, 3> off;
    for (std::size_t k = 0; k < 3; ++k) off[k] = std::max({lower[k] - p[k], p[k] - upper[k], 0.0});
    return sizing_detail::length(off);
  }
};

/// A closed ball in which circumradii are at most `radius`.
struct Sizing_ball {
  std::array<double, 3> center{};
  double extent = 0;  ///< of the ball: 0 for a point
  double radius = 0;

  /// How far p is from the ball; 0 inside.
  double distance(const std::array<double, 3>& p) const {
    return std::max(sizing_detail::length({p[0] - center[0], p[1] - center[1], p[2] - center[2]}) - extent, 0.0);
  }
  bool contains(const std::array<double, 3>& p) const { return distance(p) == 0; }
};

}  // namespace pgdr

#endif
