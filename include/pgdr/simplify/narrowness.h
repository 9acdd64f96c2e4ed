// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_NARROWNESS_H
#define PGDR_SIMPLIFY_NARROWNESS_H

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>

namespace pgdr {

/// What makes elements small in the facets of a domain.
struct Narrowness {
  /// How often all corners of facets together would have to be halved to get from the angle above which the bound on the ratio can hold to their own,
  /// with fractions.
  double halvings = 0;
  /// How many times as long as the facet is wide above them all segments are together, on each of their facets, and one more for each. Where the sides of
  /// a corner run apart nothing is counted.
  double widths = 0;

  /// About how many tetrahedra a mesh has, by quality alone, to compare what can be made of one input.
  ///
  /// Fitted to 144 models (26 inputs, 118 parts; exact): within a factor of 2.5 for 111 of them, and of 4 for all but seven. What a halving costs is from 100 (a13)
  /// to 1,600 (V0_Extrusion_Drilling_Guide), and a width from 0.35 (a30) to 5.
  double tetrahedra() const { return 200 * halvings + 1.4 * widths; }
};

Narrowness narrowness(const Domain_3<Default_kernel>& domain);

}  // namespace pgdr

#endif
