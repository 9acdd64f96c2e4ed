// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_TETRAHEDRON_JUDGE_H
#define PGDR_SLIVERS_TETRAHEDRON_JUDGE_H

#include <cstdint>

#include <pgdr/mesh/tetrahedron_ball.h>

namespace pgdr {

/// Whether a tetrahedron that would be made is one that the refinement would leave, and how small its angles are.
template <class Criteria>
class Tetrahedron_judge {
 public:
  static constexpr double refused = 2;  ///< more than any cosine

  Tetrahedron_judge(const Criteria& criteria, double min_edge_length)
      : criteria_(&criteria), squared_min_edge_(min_edge_length * min_edge_length) {}

  /// The largest cosine of a dihedral angle; `refused` if it is not below the limit, or if the tetrahedron is poor or has too short an edge.
  double operator()(const Tetrahedron_points& corners, std::int32_t subdomain, double limit) const {
    const Tetrahedron_frame frame(corners);
    const double cosine = frame.largest_dihedral_cosine();
    if (cosine >= limit) return refused;
    return refuses(frame.ball(), subdomain) ? refused : cosine;
  }

  /// Whether it is poor or has too short an edge.
  bool refuses(const Tetrahedron_ball& ball, std::int32_t subdomain) const {
    return ball.squared_shortest < squared_min_edge_ || criteria_->is_poor(ball, subdomain);
  }

 private:
  const Criteria* criteria_;
  double squared_min_edge_;
};

}  // namespace pgdr

#endif
