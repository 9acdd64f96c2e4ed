// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_SURFACE_DISTANCE_H
#define PGDR_SIMPLIFY_SURFACE_DISTANCE_H

#include <optional>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// How far the facets of two PLCs are from each other at most (two-sided Hausdorff distance).
struct Surface_distance {
  double seen = 0;         ///< the largest distance of a point of one from the other that was met: it is no less
  bool is_within = false;  ///< it is at most the limit, at every point of either
  Vec_3 at;                ///< a point with the distance `seen`
};

/// Compares two PLCs in the same unit, without any knowledge of how one came from the other. Where a triangle of one is within the limit of a
/// single triangle of the other at its corners, it is at all of its points, since distances from a convex set are convex functions; others are
/// divided. A part smaller than a thousandth of the limit that still has no such triangle counts as too far, and so does what takes too long to be divided.
/// \param limit a length
/// \return nothing if a facet of either cannot be understood
std::optional<Surface_distance> surface_distance(const Plc& a, const Plc& b, double limit);

}  // namespace pgdr

#endif
