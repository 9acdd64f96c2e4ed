// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_NARROW_CORNERS_H
#define PGDR_SIMPLIFY_NARROW_CORNERS_H

#include <algorithm>

#include <pgdr/domain/small_angles_3.h>

namespace pgdr::simplify_detail {

/// How often a corner of a facet would have to be halved to get from the angle above which the bound on the ratio can hold to its own, with fractions.
/// Tetrahedra that needles cost go by it, about a thousand for each: a knob (a26) has 7,546 of them, all together, and 7.0 million, after 1e-4d 385 and 0.5; cones17 710
/// and 0.6, or 1,145 and 0.9.
inline double halvings(double angle_deg) {
  constexpr double least = 1e-9;
  double n = 0;
  for (double angle = Small_angles::critical_plane_angle_deg; angle_deg < angle && angle > least; angle /= 2) n += std::min(1.0, angle / std::max(angle_deg, least) - 1);
  return n;
}

}  // namespace pgdr::simplify_detail

#endif
