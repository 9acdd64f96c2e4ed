// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_INPUT_FACETS_H
#define PGDR_IO_INPUT_FACETS_H

#include <pgdr/domain/default_kernel.h>
#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// Fills `triangle_input_facets`: for each triangle the facet of the input that is nearest to its centroid, by the number that the file counts it
/// by (in `.poly` files facets of nothing but segments are not counted). Where the mesh was made of the input as it is, that is the facet on which the centroid lies; where it was simplified, one within the tolerance.
/// Between facets equally near, any is taken, the same one each time. Distances are those of double arithmetic. Does nothing for an input
/// without facets. Throws `Input_error` for facets that are none.
void find_input_facets(Indexed_mesh_3& mesh, const Plc& input);

}  // namespace pgdr

#endif
