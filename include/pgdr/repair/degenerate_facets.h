// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPAIR_DEGENERATE_FACETS_H
#define PGDR_REPAIR_DEGENERATE_FACETS_H

#include <cstddef>

#include <pgdr/domain/default_kernel.h>

namespace pgdr {

/// Takes facets without area away, and divides the edges of others where these had a vertex: where a CAD program wrote a vertex that lies on
/// the edge of a triangle, it filled the gap of no width with such a facet. The surface stays the same set of points.
///
/// What is taken away keeps its number, and has no polygon any more. Facets with several polygons or hole seeds are left, and refused by `make_domain_3` if they have no area.
/// \return how many were taken away
std::size_t take_degenerate_facets_away(Plc& plc);

}  // namespace pgdr

#endif
