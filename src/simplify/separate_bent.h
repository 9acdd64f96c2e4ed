// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_SEPARATE_BENT_H
#define PGDR_SIMPLIFY_SEPARATE_BENT_H

#include <vector>

#include <pgdr/domain/default_kernel.h>

namespace pgdr::simplify_detail {

/// Keeps facets from being fused that cannot be made plane together, by segments on the edges between those of them that are: the theory is about plane facets, and
/// next to a bent one there need not be an end. Not where that would make many needles of it.
/// \param bent groups of facets that would be fused
Plc separated(Plc plc, const std::vector<std::vector<Index>>& bent, bool triangulate);

}  // namespace pgdr::simplify_detail

#endif
