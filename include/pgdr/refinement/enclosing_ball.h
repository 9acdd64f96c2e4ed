// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_ENCLOSING_BALL_H
#define PGDR_REFINEMENT_ENCLOSING_BALL_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/mesh/triangle_ball.h>

namespace pgdr {

/// Upper bound, tight but for rounding, of the radius m of the smallest ball that holds a tetrahedron: the figure
/// that the zone theorem asks for. Unlike the circumradius it is small for slivers and flat tetrahedra.
inline double enclosing_radius(const Tetrahedron_points& p) {
  constexpr double up = 1 + 1e-9;
  const auto reach = [&p](const Vec_3& center) {
    double d2 = 0;
    for (const Vec_3& q : p) d2 = std::max(d2, squared_distance(center, q));
    return std::sqrt(d2);
  };
  // The smallest ball is that of an edge, of a triangle or the circumball; any center gives an upper bound.
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) best = std::min(best, reach(0.5 * (p[i] + p[j])));
    const Vec_3 c = triangle_circumcenter(p[(i + 1) % 4], p[(i + 2) % 4], p[(i + 3) % 4]);
    if (std::isfinite(c.x + c.y + c.z)) best = std::min(best, reach(c));
  }
  const Tetrahedron_ball b = tetrahedron_ball(p);
  if (std::isfinite(b.squared_radius)) best = std::min(best, reach(b.center));
  return up * best;
}

}  // namespace pgdr

#endif
