// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_OUTER_TRIANGLES_H
#define PGDR_IO_OUTER_TRIANGLES_H

#include <cstddef>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// Removes the triangles that have tetrahedra on both sides, between regions and on facets inside one: a solver that takes triangles as boundary
/// conditions may refuse them there (deal.II does, and so does SU2). The others keep their order.
/// \return how many were removed
std::size_t keep_outer_triangles(Indexed_mesh_3& mesh);

}  // namespace pgdr

#endif
