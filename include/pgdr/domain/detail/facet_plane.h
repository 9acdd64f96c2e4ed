// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_FACET_PLANE_H
#define PGDR_DOMAIN_DETAIL_FACET_PLANE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <CGAL/Exact_rational.h>

#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/plc.h>

namespace pgdr::domain_detail {

/// A reference plane: a point of it and its unit normal.
struct Facet_plane {
  Vec_3 origin;
  Vec_3 normal;
};

/// Twice the area of a closed polygon times its normal (Newell's formula), relative to its first vertex.
inline Vec_3 twice_area_vector(const std::vector<Vec_3>& points, std::span<const Index> loop) {
  Vec_3 total;
  double scale = 0;
  const Vec_3& p0 = points[loop[0]];
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Vec_3 a = points[loop[i]] - p0;
    const Vec_3 b = points[loop[i + 1]] - p0;
    total = total + cross(a, b);
    scale = std::max({scale, dot(a, a), dot(b, b)});
  }
  if (length(total) > 1e-6 * scale) return total;
  // A needle: cancellation would spoil the direction, so the sum is exact.
  using Rational = CGAL::Exact_rational;
  std::array<Rational, 3> exact{0, 0, 0};
  const auto exact_difference = [&](Index i) {
    const Vec_3& p = points[i];
    return std::array<Rational, 3>{Rational(p[0]) - Rational(p0[0]), Rational(p[1]) - Rational(p0[1]),
                                   Rational(p[2]) - Rational(p0[2])};
  };
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const auto a = exact_difference(loop[i]);
    const auto b = exact_difference(loop[i + 1]);
    for (std::size_t k = 0; k < 3; ++k)
      exact[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  }
  return {CGAL::to_double(exact[0]), CGAL::to_double(exact[1]), CGAL::to_double(exact[2])};
}

/// A direction normal to points that belong to no closed polygon; zero when they are collinear.
inline Vec_3 spread_normal(const std::vector<Vec_3>& points, std::span<const Index> used) {
  const Vec_3& p0 = points[used.front()];
  Vec_3 far, best;
  for (Index i : used)
    if (const Vec_3 d = points[i] - p0; dot(d, d) > dot(far, far)) far = d;
  for (Index i : used)
    if (const Vec_3 c = cross(far, points[i] - p0); dot(c, c) > dot(best, best)) best = c;
  return best;
}

/// The plane with normal direction `direction` midway between the extreme points of `used`.
///
/// Where all points share a coordinate exactly, the normal is exactly that axis.
/// \param thickness receives half the distance of the extreme points along the normal.
/// \pre `direction` is not zero.
inline Facet_plane plane_through(const std::vector<Vec_3>& points, std::span<const Index> used,
                                 Vec_3 direction, double& thickness) {
  const Vec_3& p0 = points[used.front()];
  for (int k = 0; k < 3; ++k) {
    bool shared = true;
    for (Index i : used) shared = shared && points[i][k] == p0[k];
    if (!shared || direction[k] == 0) continue;
    Facet_plane plane{p0, {}};
    plane.normal[k] = direction[k] > 0 ? 1.0 : -1.0;
    thickness = 0;
    return plane;
  }
  Facet_plane plane{p0, normalized(direction)};
  double lowest = 0, highest = 0, largest = 0;
  for (Index i : used) {
    const double d = dot(plane.normal, points[i] - p0);
    lowest = std::min(lowest, d);
    highest = std::max(highest, d);
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(points[i][k]));
  }
  thickness = (highest - lowest) / 2;
  // Rounding is no reason to move the plane off a vertex.
  if (thickness > 4 * std::numeric_limits<double>::epsilon() * largest)
    plane.origin = p0 + ((highest + lowest) / 2) * plane.normal;
  return plane;
}

}  // namespace pgdr::domain_detail

#endif
