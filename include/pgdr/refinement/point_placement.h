// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_POINT_PLACEMENT_H
#define PGDR_REFINEMENT_POINT_PLACEMENT_H

#include <cmath>
#include <concepts>
#include <cstddef>

#include <pgdr/independence/selection_ball.h>
#include <pgdr/refinement/tetrahedron_ball.h>

namespace pgdr {

/// A tetrahedron that is to be split.
struct Poor_tetrahedron {
  const Tetrahedron_points& corners;
  const Tetrahedron_ball& ball;
  bool is_over_ratio = false;  ///< else it is poor by size alone
  double ratio_bound = 2;

  double circumradius() const { return std::sqrt(ball.squared_radius); }
  /// Radii of the largest balls around the circumcenter that keep the guarantees.
  double type_1_radius() const {
    const double r = circumradius();
    return is_over_ratio ? type_1_selection_radius(r, std::sqrt(ball.squared_shortest)) : size_selection_radius(r);
  }
  double type_2_radius() const {
    const double r = circumradius();
    return is_over_ratio ? type_2_selection_radius(r, ratio_bound) : size_selection_radius(r);
  }
};

/// Where the Steiner point of a poor tetrahedron goes: `placement(tetrahedron)` is a point of its type-I selection ball.
///
/// A function of its argument alone, for any thread at any time: the mesh must not depend on who asks.
template <class P>
concept PointPlacement = std::copy_constructible<P> && requires(const P& placement, const Poor_tetrahedron& t) {
  { placement(t) } -> std::convertible_to<Vec_3>;
};

/// The circumcenter, as far from all vertices as can be.
struct Circumcenter_placement {
  Vec_3 operator()(const Poor_tetrahedron& t) const { return t.ball.center; }
};

/// Middle of the shortest edge of a tetrahedron.
inline Vec_3 middle_of_shortest_edge(const Tetrahedron_points& p) {
  std::size_t a = 0, b = 1;
  double shortest = squared_distance(p[0], p[1]);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      if (const double d = squared_distance(p[i], p[j]); d < shortest) {
        shortest = d;
        a = i;
        b = j;
      }
  return 0.5 * (p[a] + p[b]);
}

/// The point of a ball around the circumcenter that is nearest to the middle of the shortest edge. A hair inside, so
/// that rounding cannot carry it out.
inline Vec_3 towards_shortest_edge(const Poor_tetrahedron& t, double radius) {
  const Vec_3 way = middle_of_shortest_edge(t.corners) - t.ball.center;
  const double distance = length(way);
  const double step = (1 - 1e-6) * radius;
  // An exactly computed circumcenter may lie beyond what the corners can be compared with.
  return distance > step && step > 0 ? t.ball.center + (step / distance) * way : t.ball.center;
}

/// As close to the shortest edge as the type-I ball allows: the new tetrahedron at that edge is no worse than the
/// bound asks, and no smaller than it has to be.
struct Type_1_placement {
  Vec_3 operator()(const Poor_tetrahedron& t) const { return towards_shortest_edge(t, t.type_1_radius()); }
};

/// The same in the type-II ball.
struct Type_2_placement {
  Vec_3 operator()(const Poor_tetrahedron& t) const { return towards_shortest_edge(t, t.type_2_radius()); }
};

static_assert(PointPlacement<Circumcenter_placement> && PointPlacement<Type_1_placement> &&
              PointPlacement<Type_2_placement>);

}  // namespace pgdr

#endif
