// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_PATCHES_H
#define PGDR_DOMAIN_PATCHES_H

#include <cstddef>

#include <pgdr/domain/default_kernel.h>

namespace pgdr {

/// Divides the facets without a marker into patches, at edges where the normal turns by more than `angle_deg` degrees, and where not exactly two
/// of them meet. Each patch gets the smallest marker from 1 on that no facet has yet, in the order of their first facets.
/// Returns how many there are. Facets of several polygons stay by themselves.
std::size_t mark_patches(Plc& plc, double angle_deg);

}  // namespace pgdr

#endif
