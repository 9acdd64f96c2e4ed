// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_TETGEN_H
#define PGDR_IO_TETGEN_H

#include <filesystem>
#include <vector>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// The four files of a mesh whose `.ele` file is `path`: itself, `.node`, `.face`, `.edge`.
std::vector<std::filesystem::path> tetgen_files(const std::filesystem::path& path);

/// Writes a mesh as TetGen does: `.node` (points with the input vertex's marker), `.ele` (tetrahedra with the region as their attribute), `.face` (triangles on facets with their
/// marker) and `.edge` (edges on segments), counted from 0; of a mesh of second order, tetrahedra have their ten nodes in TetGen's order: `path` is the second one, the others have its name but for the extension.
/// Throws `Output_error`; each file appears complete or not at all.
void write_tetgen(const Indexed_mesh_3& mesh, const std::filesystem::path& path);

}  // namespace pgdr

#endif
