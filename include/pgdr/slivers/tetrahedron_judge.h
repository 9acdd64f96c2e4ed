// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_TETRAHEDRON_JUDGE_H
#define PGDR_SLIVERS_TETRAHEDRON_JUDGE_H

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

  /// `acute`: what tetrahedra over the ratio are explained by; none are without.
  Tetrahedron_judge(const Criteria& criteria, double min_edge_length, const Acute_neighborhood_3* acute = nullptr)
      : criteria_(&criteria), squared_min_edge_(min_edge_length * min_edge_length), acute_(acute) {}

  /// The largest cosine of a dihedral angle; `refused` if it is not below the limit, or if the tetrahedron is poor or has too short an edge.
  double operator()(const Tetrahedron_points& corners, std::int32_t subdomain, double limit) const {
    const Tetrahedron_frame frame(corners);
    const double cosine = frame.largest_dihedral_cosine();
    if (cosine >= limit) return refused;
    return refuses(frame.ball(), subdomain) ? refused : cosine;
  }

  /// The same, but in the place of others that are exempt one that is over the ratio will do, too, if it is not flat: then `squared_ratio`
  /// is its ratio, squared, else 0. Whether small angles explain it is yet to be asked (`Exempt_tetrahedra_3`).
  double instead_of_exempt(const Tetrahedron_points& corners, std::int32_t subdomain, double limit, double& squared_ratio) const {
    squared_ratio = 0;
    const Tetrahedron_frame frame(corners);
    const double cosine = frame.largest_dihedral_cosine();
    if (cosine >= limit || frame.is_flat()) return refused;
    const Tetrahedron_ball ball = frame.ball();
    if (!refuses(ball, subdomain)) return cosine;
    if (ball.squared_shortest < squared_min_edge_ || criteria_->is_over_size(ball, subdomain)) return refused;
    squared_ratio = ball.squared_ratio();
    return cosine;
  }

  /// For a tetrahedron that was made, as `instead_of_exempt` let it be.
  template <class Cell_handle>
  void mark_exempt(Cell_handle c) const {
    if (refuses(tetrahedron_ball(tetrahedron_points(c)), c->subdomain())) c->set_state(Cell_state::exempt);
  }

  const Acute_neighborhood_3* acute() const { return acute_; }

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
