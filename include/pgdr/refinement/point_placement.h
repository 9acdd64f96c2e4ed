// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_POINT_PLACEMENT_H
#define PGDR_REFINEMENT_POINT_PLACEMENT_H

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>

#include <boost/container/static_vector.hpp>

#include <pgdr/independence/selection_ball.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/parameters.h>

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

using Point_choice = boost::container::static_vector<Vec_3, 16>;

/// A placement that offers more than one point. Where the first one leaves a dihedral angle with a larger cosine than
/// `placement.enough(tetrahedron)`, in a tetrahedron that is going to stay since it is not poor, the engine looks at those that
/// `placement.alternatives(tetrahedron, choice)` appends, other points of the type-I ball: it takes the first one that leaves none, if there is
/// one. Those that lie in another leaf, or encroach a feature, do not count. With 1, the first point will do.
template <class P>
concept ChoosingPlacement = PointPlacement<P> && requires(const P& placement, const Poor_tetrahedron& t, Point_choice& choice) {
  { placement.enough(t) } -> std::convertible_to<double>;
  placement.alternatives(t, choice);
};

/// The circumcenter, as far from all vertices as can be.
struct Circumcenter_placement {
  Vec_3 operator()(const Poor_tetrahedron& t) const { return t.ball.center; }
};

/// Middle of the shortest edge of a tetrahedron.
inline Vec_3 middle_of_shortest_edge(const Tetrahedron_points& p) {
  const auto [a, b] = shortest_edge(p);
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
/// bound asks, and no smaller than it has to be. What is too large only is split at its circumcenter: anywhere else
/// would make more tetrahedra.
struct Type_1_placement {
  Vec_3 operator()(const Poor_tetrahedron& t) const {
    return t.is_over_ratio ? towards_shortest_edge(t, t.type_1_radius()) : t.ball.center;
  }
};

/// The same in the type-II ball. At B = 2 that is the circumcenter.
struct Type_2_placement {
  Vec_3 operator()(const Poor_tetrahedron& t) const {
    return t.is_over_ratio ? towards_shortest_edge(t, t.type_2_radius()) : t.ball.center;
  }
};

/// The dihedral angle, in degrees, below which another point is looked for where `wanted` is to be the smallest one in the end.
///
/// Points off the circumcenter take more vertices, the more the larger this angle; removing what they leave takes time, and vertices
/// where no move helps. So that both stay below half a per cent of the vertices (table in docs/robustness.md): up to 12.5 degrees the angle itself,
/// above 14 less, down to 7.4 at 20.
constexpr double angle_of_choice(double wanted) {
  constexpr double most = 12.5, kink = 14, less_per_degree = 0.85;
  return std::max(0.0, std::min(wanted, most - less_per_degree * std::max(0.0, wanted - kink)));
}

/// The circumcenter, unless a dihedral angle comes out too small: then the corners of a cube and of an octahedron around it are tried.
///
/// For tetrahedra that are poor by size alone. What is over the ratio leaves tetrahedra that hardly ever stay, and of other points than
/// the center come shorter edges: with a choice in the type-I ball, models by quality alone took up to seven times as many
/// tetrahedra, with one in a tenth of the circumradius as many, in up to twice the time, and as many slivers as without in the end.
struct Lazy_placement {
  double cosine = 1;  ///< of the `angle_of_choice`

  Vec_3 operator()(const Poor_tetrahedron& t) const { return t.ball.center; }
  double enough(const Poor_tetrahedron& t) const { return t.is_over_ratio ? 1 : cosine; }
  void alternatives(const Poor_tetrahedron& t, Point_choice& choice) const {
    const double s = (1 - 1e-6) * size_selection_radius(t.circumradius());
    constexpr double third = 0.57735026918962576;  // of the square root of 3
    for (int k = 0; k < 8; ++k)
      choice.push_back(t.ball.center + s * third * Vec_3{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0});
    for (int k = 0; k < 6; ++k) {
      Vec_3 axis;
      axis[k / 2] = k % 2 ? s : -s;
      choice.push_back(t.ball.center + axis);
    }
  }
};

/// Any of these, named at run time.
struct Standard_placement {
  Point_placement policy = Point_placement::lazy;
  Lazy_placement lazy = {};

  Vec_3 operator()(const Poor_tetrahedron& t) const {
    switch (policy) {
      case Point_placement::type1: return Type_1_placement()(t);
      case Point_placement::type2: return Type_2_placement()(t);
      default: return t.ball.center;
    }
  }
  double enough(const Poor_tetrahedron& t) const { return policy == Point_placement::lazy ? lazy.enough(t) : 1; }
  void alternatives(const Poor_tetrahedron& t, Point_choice& choice) const { lazy.alternatives(t, choice); }
};

static_assert(PointPlacement<Circumcenter_placement> && PointPlacement<Type_1_placement> &&
              PointPlacement<Type_2_placement>);
static_assert(ChoosingPlacement<Lazy_placement> && ChoosingPlacement<Standard_placement>);

}  // namespace pgdr

#endif
