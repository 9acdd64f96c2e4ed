// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_TETRAHEDRON_JUDGE_H
#define PGDR_SLIVERS_TETRAHEDRON_JUDGE_H

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/mesh/mesh_triangulation_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>

namespace pgdr {

/// Whether a tetrahedron that would be made is one that the refinement would leave, and how small its angles are.
template <class Criteria>
class Tetrahedron_judge {
 public:
  static constexpr double refused = 2;  ///< more than any cosine

  /// `acute`: where tetrahedra may be over the ratio; nowhere without.
  Tetrahedron_judge(const Criteria& criteria, double min_edge_length, const Acute_neighborhood_3* acute = nullptr)
      : criteria_(&criteria), squared_min_edge_(min_edge_length * min_edge_length), acute_(acute) {}

  /// The largest cosine of a dihedral angle; `refused` if it is not below the limit, or if the tetrahedron is poor or has too short an edge.
  double operator()(const Tetrahedron_points& corners, std::int32_t subdomain, double limit) const {
    const Tetrahedron_frame frame(corners);
    const double cosine = frame.largest_dihedral_cosine();
    if (cosine >= limit) return refused;
    return refuses(frame.ball(), subdomain) ? refused : cosine;
  }

  /// The same, but in the place of others that are exempt, with ratios up to the root of `squared_ratio`, one that is over the ratio will do,
  /// too, if small angles explain it: `is_exempt`, where that is yet to be asked.
  double instead_of_exempt(const Tetrahedron_points& corners, std::int32_t subdomain, double limit, double squared_ratio, bool& is_exempt) const {
    const Tetrahedron_frame frame(corners);
    const double cosine = frame.largest_dihedral_cosine();
    is_exempt = false;
    if (cosine >= limit || frame.is_flat()) return refused;
    const Tetrahedron_ball ball = frame.ball();
    if (!refuses(ball, subdomain)) return cosine;
    is_exempt = acute_ && ball.squared_shortest >= squared_min_edge_ && ball.squared_radius <= squared_ratio * ball.squared_shortest &&
                !criteria_->is_over_size(ball, subdomain);
    return is_exempt ? cosine : refused;
  }
  /// Whether a small angle is as near as to those that it explains (docs/theory.md, section 11). Takes as long as a hundred of the questions above.
  bool is_explained(const Tetrahedron_points& corners) const {
    constexpr double reach = 4;
    const double distance = reach * std::sqrt(tetrahedron_ball(corners).squared_radius);
    return std::ranges::any_of(corners, [&](const Vec_3& p) { return acute_->contains(p, distance); });
  }

  /// For a tetrahedron that was made, as `instead_of_exempt` let it be.
  template <class Cell_handle>
  void mark_exempt(Cell_handle c) const {
    if (refuses(tetrahedron_ball(tetrahedron_points(c)), c->subdomain())) c->set_state(Cell_state::exempt);
  }

  /// Whether it is poor or has too short an edge.
  bool refuses(const Tetrahedron_ball& ball, std::int32_t subdomain) const {
    return ball.squared_shortest < squared_min_edge_ || criteria_->is_poor(ball, subdomain);
  }

 private:
  const Criteria* criteria_;
  double squared_min_edge_;
  const Acute_neighborhood_3* acute_;
};

}  // namespace pgdr

#endif
