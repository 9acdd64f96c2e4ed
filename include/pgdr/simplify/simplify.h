// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_SIMPLIFY_H
#define PGDR_SIMPLIFY_SIMPLIFY_H

#include <cstddef>
#include <optional>

#include <pgdr/domain/default_kernel.h>

namespace pgdr {

/// What `simplify` did.
struct Simplification {
  std::size_t facets = 0;            ///< that are left; 0 where nothing was done
  std::size_t collapsed_edges = 0;   ///< shorter than the tolerance: one of their ends is gone
  std::size_t removed_needles = 0;   ///< triangles that were lower than the tolerance: their longest edge goes through their third corner
  double largest_change = 0;         ///< no point of either boundary is farther from the other one; at most the tolerance

  bool is_none() const { return collapsed_edges + removed_needles == 0; }
};

/// Takes away what makes elements small without need: edges shorter than `tolerance`, and triangles lower than that, smallest first. No
/// vertex moves; some are gone in the end, and some edges go through vertices that were next to them.
///
/// The boundary changes by at most `tolerance` (two-sided Hausdorff distance, bounded by a map of the input onto the result). It keeps its
/// topology and gets no intersections: a step that would break that, decided by exact predicates, is not done. Only triangles change;
/// polygons with more corners, explicit segments, and the vertices of either stay.
/// \param tolerance a length; 0 or less: nothing is changed
/// \return `plc` itself where nothing was to be done
/// \param most_rounds how often it may be done again without the steps that left something low; where that is not enough nothing is done
Plc simplify(const Plc& plc, double tolerance, Simplification* done = nullptr, std::optional<int> most_rounds = std::nullopt);

/// Length of the diagonal of the bounding box of the vertices.
double bounding_diagonal(const Plc& plc);

}  // namespace pgdr

#endif
