// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_SECOND_ORDER_H
#define PGDR_IO_SECOND_ORDER_H

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// Gives a mesh a node in the middle of each edge of its tetrahedra, behind the points that it has, and fills `tetrahedron_nodes`,
/// `triangle_nodes` and `edge_nodes`. Edges stay straight. A node has the reference 0 and the smallest dimension of what its edge lies on. The
/// nodes are in the order of their edges' vertices, whatever the number of threads; does nothing to a mesh that has such nodes.
/// \pre the corners of triangles and edges are ends of edges of tetrahedra
/// Throws `std::length_error` for a mesh whose nodes cannot be numbered.
void add_midside_nodes(Indexed_mesh_3& mesh);

/// The mesh as it was before it got them.
Indexed_mesh_3 without_midside_nodes(Indexed_mesh_3 mesh);

}  // namespace pgdr

#endif
