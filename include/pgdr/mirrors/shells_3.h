// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MIRRORS_SHELLS_3_H
#define PGDR_MIRRORS_SHELLS_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <vector>

#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mirrors/mirror_image.h>

namespace pgdr {

/// The radii of the shells around a domain vertex on which the segments that end there are split, in units of powers of two.
///
/// They are nearly equal. If they were equal, any four points on two shells and two segments would be cocircular. So where angles are below `limit` each
/// segment has a factor of its own, by its direction. Those of two segments with unit vectors u and v differ by |u - v| / 16 of the smallest angle at the
/// vertex at most, which is an eighth of what the lemma of `Segment_wedges_3` leaves them.
class Shells_3 {
 public:
  /// At wider angles, in degrees, what is flat is removed as other slivers are.
  static constexpr double limit = Small_angles::critical_plane_angle_deg;
  /// By how much shells are off at most, of their radius: far more than rounding, and less than gaps are wide. Table in docs/robustness.md.
  static constexpr double share = 1e-7;

  template <class K>
  Shells_3(const Domain_3<K>& domain, const Small_angles& angles) {
    for (const auto& s : domain.segments) {
      ends_.push_back(s.vertices);
      std::array<double, 2>& factors = factors_.emplace_back();
      for (std::size_t k = 0; k < 2; ++k) {
        const Vec_3 along = to_vec(domain.vertices[s.vertices[1 - k]]) - to_vec(domain.vertices[s.vertices[k]]);
        const double degrees = angles.vertex_deg[s.vertices[k]];
        const double most = degrees < limit ? std::min(degrees * std::numbers::pi / 180 / 8, share) : 0;
        factors[k] = 1 - most * (1 + dot(along, aslant) / length(along)) / 2;
      }
    }
  }

  /// A little less than 1. \pre the segment ends in this domain vertex
  double factor(Index segment, Index end) const { return factors_[segment][ends_[segment][1] == end ? 1 : 0]; }

 private:
  std::vector<std::array<Index, 2>> ends_;       ///< of each segment
  std::vector<std::array<double, 2>> factors_;  ///< there
};

}  // namespace pgdr

#endif
