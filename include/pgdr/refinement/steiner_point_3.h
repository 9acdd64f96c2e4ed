// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_STEINER_POINT_3_H
#define PGDR_REFINEMENT_STEINER_POINT_3_H

#include <cmath>
#include <utility>
#include <vector>

#include <pgdr/conforming/feature_request.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/refinement/hull_box_3.h>
#include <pgdr/refinement/point_placement.h>

namespace pgdr {

/// What came of the attempts before to make room for a tetrahedron.
struct Tried {
  std::vector<Obstacle_id> refused;  ///< what is in the way, and may not be split for its sake
  bool is_strict = true;             ///< with the floor everywhere
};

/// A tetrahedron that is looked at, and its Steiner point.
template <class Tr>
struct Steiner_attempt_3 {
  Cell_id_3<typename Tr::Cell_handle> id;
  Tetrahedron_points corners;
  Tetrahedron_ball ball;
  Vec_3 at;
  Tried tried;

  typename Tr::Point point() const { return typename Tr::Point(at.x, at.y, at.z); }
  bool is_outside() const { return id.cell->subdomain() == 0; }
  /// A bound of the distance from the Steiner point to all vertices: the circumball is empty.
  double least_distance() const { return std::sqrt(ball.squared_radius) - length(at - ball.center); }
};

/// Where the Steiner points of tetrahedra are: where `Placement` says, but within the hull.
template <class Tr, class Criteria, class Placement>
class Steiner_points_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Attempt = Steiner_attempt_3<Tr>;

  Steiner_points_3(const Tr& tr, const Criteria& criteria, Placement placement)
      : criteria_(criteria), placement_(std::move(placement)), hull_(tr) {}

  const Hull_box_3<Tr>& hull() const { return hull_; }
  const Placement& placement() const { return placement_; }

  Attempt attempt(const Cell_id_3<Cell_handle>& id, Tried tried) const {
    Attempt t{id, tetrahedron_points(id.cell), {}, {}, std::move(tried)};
    t.ball = tetrahedron_ball(t.corners);
    t.at = of(t.is_outside(), t.ball, t.corners);
    return t;
  }

  /// The Steiner point of a tetrahedron; `outside`: of the domain.
  Vec_3 of(bool outside, const Tetrahedron_ball& ball, const Tetrahedron_points& corners) const {
    if (outside) return hull_.attract(ball);
    return hull_.pull_in(placement_(poor_tetrahedron(ball, corners)), corners);
  }

  Poor_tetrahedron poor_tetrahedron(const Tetrahedron_ball& ball, const Tetrahedron_points& corners) const {
    return {corners, ball, criteria_.is_over_ratio(ball), criteria_.radius_edge_ratio()};
  }

  /// Good enough to find the leaf that will look at it; that one computes the point itself.
  Vec_3 roughly(Cell_handle c) const {
    const Certified_ball& b = c->ball();
    if (b.has_center()) {
      const Vec_3 p{static_cast<double>(b.center[0]), static_cast<double>(b.center[1]),
                    static_cast<double>(b.center[2])};
      if (hull_.box().contains_closed(p)) return p;
    }
    const Tetrahedron_points corners = tetrahedron_points(c);
    return of(c->subdomain() == 0, tetrahedron_ball(corners), corners);
  }

 private:
  const Criteria& criteria_;
  Placement placement_;
  Hull_box_3<Tr> hull_;
};

}  // namespace pgdr

#endif
