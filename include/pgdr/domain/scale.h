// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_SCALE_H
#define PGDR_DOMAIN_SCALE_H

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include <pgdr/domain/input_error.h>
#include <pgdr/domain/plc.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// The user's unit of length for something with an `exponent`: what coordinates are multiplied by to be those of the file. A power of two, so
/// that nothing is rounded.
template <class T>
double unit_of(const T& t) {
  return std::ldexp(1.0, t.exponent);
}

namespace domain_detail {

// Squares and cubes of lengths, and their products, stay far from the ends of double's range, and radii from those of float's. Nearly all
// files are within that and keep their coordinates.
constexpr double largest_unscaled = 0x1p60, smallest_unscaled = 0x1p-60;
// Outside of these, points between the input's, or the diagonal, are not doubles in the user's unit any more.
constexpr int largest_exponent = 1000, smallest_exponent = -900;

inline double largest_coordinate(const Vec_3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

}  // namespace domain_detail

/// The exponent that `normalized` gives to points whose largest coordinate has this absolute value, on top of the one they have.
inline int exponent_for(double largest) {
  using namespace domain_detail;
  const bool is_fit = !(largest > 0) || !std::isfinite(largest) || (largest >= smallest_unscaled && largest <= largest_unscaled);
  return is_fit ? 0 : std::ilogb(largest);
}

/// The exponent for a PLC; 0 where its coordinates may stay as they are.
template <class K>
int exponent_for(const Piecewise_linear_complex_3<K>& plc) {
  double largest = 0;
  for (const auto& p : plc.vertices)
    if (const double x = domain_detail::largest_coordinate(to_vec(p)); std::isfinite(x)) largest = std::max(largest, x);
  return exponent_for(largest);
}

/// The same PLC with coordinates of about 1, where they are so large or small that products of them would not be doubles; all lengths in it are
/// divided by the same power of two. Throws `Input_error` where a coordinate of a vertex would lose digits.
template <class K>
Piecewise_linear_complex_3<K> normalized(Piecewise_linear_complex_3<K> plc) {
  using namespace domain_detail;
  const int k = exponent_for(plc);
  if (k == 0) return plc;
  const auto fail = [](const char* why, double least, double most) {
    char text[160];
    std::snprintf(text, sizeof text, "coordinates from %.3g to %.3g %s", least, most, why);
    throw Input_error(Input_problem::Kind::bad_coordinate, text);
  };
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const auto& p : plc.vertices) {
    const Vec_3 v = to_vec(p);
    for (const double x : {std::abs(v.x), std::abs(v.y), std::abs(v.z)})
      if (x > 0 && std::isfinite(x)) least = std::min(least, x), most = std::max(most, x);
  }
  if (plc.exponent + k > largest_exponent || plc.exponent + k < smallest_exponent) fail("leave no room for points between them", least, most);
  if (std::ldexp(std::ldexp(least, -k), k) != least) fail("are too far apart for double precision", least, most);
  using FT = typename K::FT;
  const FT factor(std::ldexp(1.0, -k));
  const auto scale = [&factor](auto& p) { p = typename K::Point_3(p.x() * factor, p.y() * factor, p.z() * factor); };
  for (auto& p : plc.vertices) scale(p);
  for (auto& p : plc.holes) scale(p);
  for (auto& facet : plc.facets)
    for (auto& p : facet.holes) scale(p);
  for (auto& region : plc.regions) {
    scale(region.point);
    // What cannot be told from zero is still a bound.
    const auto bound = [](double& x, int power) { if (x > 0) x = std::max(std::ldexp(x, power), std::numeric_limits<double>::denorm_min()); };
    bound(region.max_volume, -3 * k);
    bound(region.max_circumradius, -k);
  }
  plc.exponent += k;
  return plc;
}

}  // namespace pgdr

#endif
