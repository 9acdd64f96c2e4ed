// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_VTK_H
#define PGDR_IO_VTK_H

#include <filesystem>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// Writes tetrahedra, then triangles on facets, as VTK's legacy format (version 3.0, binary), for readers that do not know `.vtu`; of second
/// order if the mesh is. Cell data: `attribute` (Int32), the region of a tetrahedron, the marker of a triangle.
/// Throws `Output_error`; the file appears complete or not at all. Throws `std::length_error` for more than 2^31 numbers in a list of cells.
void write_vtk(const Indexed_mesh_3& mesh, const std::filesystem::path& path);

}  // namespace pgdr

#endif
