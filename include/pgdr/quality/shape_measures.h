// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_QUALITY_SHAPE_MEASURES_H
#define PGDR_QUALITY_SHAPE_MEASURES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <pgdr/quality/measures.h>

namespace pgdr {

/// Measures of a tetrahedron's shape by their names in VTK's Verdict library (Stimpson, Ernst, Knupp, Pebay, Thompson: The Verdict
/// library reference manual, 2007, section 6): numbers without a unit, each 1 for the regular tetrahedron.
struct Shape_measures {
  double edge_ratio;       ///< longest over shortest edge: 1 or more
  double aspect_ratio;     ///< longest edge over 2 sqrt(6) times the inradius: 1 or more, infinite where the volume is not positive
  double mean_ratio;       ///< 12 (3 volume)^(2/3) over the sum of the squared edges: 1 or less, Verdict's 1 / aspect Frobenius
  double scaled_jacobian;  ///< 6 sqrt(2) times the volume over the largest product of three edges at a corner: 1 or less
};

/// The measures of a tetrahedron abcd with these squared lengths of ab, ac, ad, bc, bd, cd, this surface and this `orientation_determinant`:
/// the volume is exact but for rounding, all else is double arithmetic. Mean ratio and scaled Jacobian have the sign of the volume and are 0
/// where that is.
inline Shape_measures shape_measures(const std::array<double, 6>& squared_edges, double surface, double determinant) {
  const auto [ab, ac, ad, bc, bd, cd] = squared_edges;
  const double longest = std::max(std::max(std::max(ab, ac), std::max(ad, bc)), std::max(bd, cd));
  const double shortest = std::min(std::min(std::min(ab, ac), std::min(ad, bc)), std::min(bd, cd));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Shape_measures m{shortest > 0 ? std::sqrt(longest / shortest) : infinity, infinity, 0, 0};
  if (determinant == 0) return m;
  constexpr double sqrt_2 = 1.41421356237309505, sqrt_6 = 2.44948974278317810;
  // The inradius is three volumes over the surface.
  if (determinant > 0) m.aspect_ratio = std::sqrt(longest) * surface / (sqrt_6 * determinant);
  const double root = std::cbrt(determinant / 2);
  m.mean_ratio = std::copysign(12 * root * root / (ab + ac + ad + bc + bd + cd), determinant);
  const double corners = std::max(std::max(ab * ac * ad, ab * bc * bd), std::max(ac * bc * cd, ad * bd * cd));
  m.scaled_jacobian = sqrt_2 * determinant / std::sqrt(corners);
  return m;
}

/// The measures of the tetrahedron whose `orientation_determinant` is `determinant`.
inline Shape_measures shape_measures(const std::array<double, 3>& a, const std::array<double, 3>& b, const std::array<double, 3>& c,
                                     const std::array<double, 3>& d, double determinant) {
  namespace q = quality_detail;
  const auto u = q::difference<double>(b, a), v = q::difference<double>(c, a), w = q::difference<double>(d, a);
  const auto x = q::difference<double>(c, b), y = q::difference<double>(d, b), z = q::difference<double>(d, c);
  const auto twice_area = [](const q::Vector<double>& s, const q::Vector<double>& t) {
    const auto normal = q::cross(s, t);
    return std::sqrt(q::dot(normal, normal));
  };
  return shape_measures({q::dot(u, u), q::dot(v, v), q::dot(w, w), q::dot(x, x), q::dot(y, y), q::dot(z, z)},
                        (twice_area(u, v) + twice_area(u, w) + twice_area(v, w) + twice_area(x, y)) / 2, determinant);
}

inline Shape_measures shape_measures(const std::array<double, 3>& a, const std::array<double, 3>& b, const std::array<double, 3>& c,
                                     const std::array<double, 3>& d) {
  return shape_measures(a, b, c, d, orientation_determinant(a, b, c, d));
}

}  // namespace pgdr

#endif
