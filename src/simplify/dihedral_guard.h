// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_DIHEDRAL_GUARD_H
#define PGDR_SIMPLIFY_DIHEDRAL_GUARD_H

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/detail/facet_pieces.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/small_angles_3.h>

namespace pgdr::simplify_detail {

/// Finds the segments where a move made a small dihedral angle of a larger one: a facet has fallen onto its neighbor.
class Dihedral_guard {
 public:
  explicit Dihedral_guard(const Domain_3<Default_kernel>& before) {
    for_each_angle(before, [&](const auto& segment, double angle) { before_.push_back({ends(before, segment), angle}); });
    std::ranges::sort(before_);
  }

  /// Adds the input facets at such segments.
  void add_sharpened(const Domain_3<Default_kernel>& now, std::vector<Index>& input_facets) const {
    constexpr double small = 60, much = 0.5;  // degrees, as elsewhere: above, refinement has no trouble; and of what it was
    for_each_angle(now, [&](const auto& segment, double angle) {
      if (angle >= small) return;
      const auto ends_now = ends(now, segment);
      const auto was = std::ranges::lower_bound(before_, std::pair(ends_now, 0.0));
      if (was != before_.end() && was->first == ends_now && angle >= much * was->second) return;
      for (const Index f : segment.facets)
        input_facets.insert(input_facets.end(), now.facets[f].input_facets.begin(), now.facets[f].input_facets.end());
    });
  }

 private:
  static domain_detail::Index_pair ends(const Domain_3<Default_kernel>& domain, const Domain_3<Default_kernel>::Segment& s) {
    return domain_detail::sorted_pair(domain.input_vertex[s.vertices[0]], domain.input_vertex[s.vertices[1]]);
  }

  template <class Found>
  static void for_each_angle(const Domain_3<Default_kernel>& domain, const Found& found) {
    const std::vector<double> angles = dihedral_angles_3(domain, domain_detail::Facet_edges(domain));
    for (std::size_t s = 0; s < angles.size(); ++s) found(domain.segments[s], angles[s]);
  }

  std::vector<std::pair<domain_detail::Index_pair, double>> before_;
};

}  // namespace pgdr::simplify_detail

#endif
