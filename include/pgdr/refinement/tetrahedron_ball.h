// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_TETRAHEDRON_BALL_H
#define PGDR_REFINEMENT_TETRAHEDRON_BALL_H

#include <algorithm>
#include <array>
#include <cmath>

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// What the refinement asks of a tetrahedron.
struct Tetrahedron_ball {
  Vec_3 center;                 ///< of the circumball
  double squared_radius = 0;    ///< of the circumball
  double squared_shortest = 0;  ///< length of the shortest edge, squared
  double volume = 0;
};

using Tetrahedron_points = std::array<Vec_3, 4>;

inline double squared_shortest_edge(const Tetrahedron_points& p) {
  return std::min({squared_distance(p[0], p[1]), squared_distance(p[0], p[2]), squared_distance(p[0], p[3]),
                   squared_distance(p[1], p[2]), squared_distance(p[1], p[3]), squared_distance(p[2], p[3])});
}

/// The same by rational arithmetic, each figure rounded once; for cells so flat that doubles have no say.
inline Tetrahedron_ball exact_tetrahedron_ball(const Tetrahedron_points& p) {
  using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  std::array<Exact::Point_3, 4> q;
  for (std::size_t i = 0; i < 4; ++i) q[i] = Exact::Point_3(p[i].x, p[i].y, p[i].z);
  Tetrahedron_ball b;
  b.squared_shortest = squared_shortest_edge(p);
  const auto volume = CGAL::volume(q[0], q[1], q[2], q[3]);
  b.volume = CGAL::to_double(volume);
  if (volume == 0) {
    b.squared_radius = std::numeric_limits<double>::infinity();
    return b;
  }
  const auto c = CGAL::circumcenter(q[0], q[1], q[2], q[3]);
  b.center = {CGAL::to_double(c.x()), CGAL::to_double(c.y()), CGAL::to_double(c.z())};
  b.squared_radius = CGAL::to_double(CGAL::squared_distance(c, q[0]));
  return b;
}

/// Circumball, shortest edge and volume of a tetrahedron, all to about nine digits.
inline Tetrahedron_ball tetrahedron_ball(const Tetrahedron_points& p) {
  const Vec_3 u = p[1] - p[0], v = p[2] - p[0], w = p[3] - p[0];
  const double uu = squared_length(u), vv = squared_length(v), ww = squared_length(w);
  const Vec_3 vw = cross(v, w);
  const double det = dot(u, vw);
  // The determinant's rounding error is a few units of 1e-16 |u||v||w|.
  if (det * det < 1e-12 * uu * vv * ww) return exact_tetrahedron_ball(p);
  const Vec_3 offset = (0.5 / det) * (uu * vw + vv * cross(w, u) + ww * cross(u, v));
  Tetrahedron_ball b;
  b.center = p[0] + offset;
  b.squared_radius = squared_length(offset);
  b.squared_shortest =
      std::min({uu, vv, ww, squared_distance(p[1], p[2]), squared_distance(p[1], p[3]), squared_distance(p[2], p[3])});
  b.volume = det / 6;
  return b;
}

}  // namespace pgdr

#endif
