// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_WRITE_MESH_H
#define PGDR_IO_WRITE_MESH_H

#include <filesystem>
#include <string>
#include <vector>

#include <pgdr/io/gmsh.h>
#include <pgdr/io/vtu.h>
#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// What some formats leave to choose.
struct Write_options {
  Gmsh_format gmsh = Gmsh_format::binary_4_1;
  Vtu_options vtu;
};

/// The extensions that `write_mesh` knows: `.vtu`, `.vtk`, `.mesh`, `.msh`, `.inp`, `.su2` and `.ele`.
/// \param order 2: only those that can hold elements of second order
std::vector<std::string> mesh_extensions(int order = 1);

/// Whether `write_mesh` knows the extension (in any case).
bool is_known_mesh_extension(const std::filesystem::path& path);

/// The files that `write_mesh` writes: `path`, and three beside it for TetGen's format (`.ele`).
std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path);

/// Writes a mesh in the format that the extension names, see `write_vtu`, `write_vtk`, `write_medit`, `write_gmsh`, `write_abaqus`, `write_su2` and `write_tetgen`.
/// Throws `std::invalid_argument` for an unknown extension, or one that has no elements of second order if the mesh has them; `Output_error` when the file
/// cannot be written.
void write_mesh(const Indexed_mesh_3& mesh, const std::filesystem::path& path, const Write_options& options = {});

}  // namespace pgdr

#endif
