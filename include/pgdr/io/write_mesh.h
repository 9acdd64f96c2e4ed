// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_WRITE_MESH_H
#define PGDR_IO_WRITE_MESH_H

#include <filesystem>
#include <string>
#include <vector>

#include <pgdr/io/gmsh.h>
#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// The extensions that `write_mesh` knows: `.vtu`, `.mesh`, `.msh`, `.inp`, `.su2` and `.ele`.
const std::vector<std::string>& mesh_extensions();

/// Whether `write_mesh` knows the extension (in any case).
bool is_known_mesh_extension(const std::filesystem::path& path);

/// The files that `write_mesh` writes: `path`, and three beside it for TetGen's format (`.ele`).
std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path);

/// Writes a mesh in the format that the extension names, see `write_vtu`, `write_medit`, `write_gmsh`, `write_abaqus`, `write_su2` and `write_tetgen`.
/// \param gmsh which version of Gmsh's format, for `.msh`
/// Throws `std::invalid_argument` for an unknown extension, `Output_error` when the file cannot be written.
void write_mesh(const Indexed_mesh_3& mesh, const std::filesystem::path& path, Gmsh_format gmsh = Gmsh_format::binary_4_1);

}  // namespace pgdr

#endif
