// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_LOCAL_FEATURE_SIZES_H
#define PGDR_SIZING_LOCAL_FEATURE_SIZES_H

#include <limits>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/sizing/distance_sizing_field.h>

namespace pgdr {

/// Bounds in proportion to the local feature size, so that edges are so short that `cells_across` of them span what is meshed where it is narrow.
///
/// Ruppert's local feature size (1995) at a point of a facet is the distance of the nearest feature without a common point with it. What counts here is what can be
/// seen from there through a volume that is meshed: the facet that the normal meets first, if it has no vertex in common with the facet where it starts and is within 60
/// degrees of parallel to it, and the distance is that of its plane. So the width of walls counts; the gap between them does not where nothing is meshed in it, nor do
/// steps and the strips of a curved surface, and facets that meet, at whatever angle, ask for nothing.
///
/// Next to a point of a facet where the width is w, the bound is w / `cells_across` / `mean_edge` up to the distance w / 2, so that it holds across, and grows by
/// `gradation` for each unit of distance from there. A width is measured once for what is within a third of it, and those within a factor of sqrt(2) make one field, with
/// the smallest of them.
/// \param cells_across above 0
/// \param gradation above 0 and below 1
/// \param largest no bound above this one is needed
/// Throws `std::invalid_argument` for numbers without sense. Empty where nothing is narrow enough.
std::vector<Distance_sizing_field> local_feature_sizes(const Domain_3<Default_kernel>& domain, double cells_across, double gradation = 0.5,
                                                       double largest = std::numeric_limits<double>::infinity());

}  // namespace pgdr

#endif
