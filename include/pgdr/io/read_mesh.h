// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_READ_MESH_H
#define PGDR_IO_READ_MESH_H

#include <filesystem>
#include <string>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// The extensions that `read_mesh` knows: `.mesh`, `.vtu` and `.msh`.
const std::vector<std::string>& readable_mesh_extensions();

/// Reads tetrahedra, with the triangles, edges, markers, regions and names that the file has: Medit's ASCII format (`read_medit`), Gmsh's (`read_gmsh`), or VTK's unstructured grids (tetrahedra and triangles, of
/// those of second order the corners; cell data `region` and `marker`, or `attribute`; other cells are left out).
/// Throws `Input_error`.
Indexed_mesh_3 read_mesh(const std::filesystem::path& path);

/// The PLC of a mesh that is to be refined further: all of its points, its triangles and edges with their markers, and a seed for each part with its region. Triangles between parts,
/// or on the boundary, that the mesh does not list are added with the marker 0. A mesh of it has all points of the old one and, if that was Delaunay, all of its tetrahedra that need not
/// be refined.
/// Throws `Input_error` for a mesh in which more than two tetrahedra share a triangle.
Plc plc_of_mesh(const Indexed_mesh_3& mesh);

}  // namespace pgdr

#endif
