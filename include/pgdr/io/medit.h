// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_MEDIT_H
#define PGDR_IO_MEDIT_H

#include <filesystem>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// Writes a mesh as Medit ASCII (`MeshVersionFormatted 2`): vertices, edges, triangles and tetrahedra with
/// their references, 1-based; doubles in the fewest digits that read back bit for bit.
/// Formatted on all threads of the caller's arena; the bytes do not depend on how many there are.
/// `point_dimensions` and `exempt` have no place in the format. Throws `Output_error`;
/// the file appears complete or not at all.
void write_medit(const Indexed_mesh_3& mesh, const std::filesystem::path& path);

/// Reads a Medit ASCII mesh: sections in any order, comments, unknown sections skipped.
/// Nothing about the mesh is judged but that numbers are finite and indices exist.
/// Throws `Input_error` with file and 1-based line.
Indexed_mesh_3 read_medit(const std::filesystem::path& path);

}  // namespace pgdr

#endif
