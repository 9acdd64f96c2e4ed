// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_WRITE_MESH_H
#define PGDR_IO_WRITE_MESH_H

#include <filesystem>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// Whether `write_mesh` knows the extension (in any case): `.mesh` or `.vtu`.
bool is_known_mesh_extension(const std::filesystem::path& path);

/// Writes a mesh in the format that the extension names.
/// Throws `std::invalid_argument` for an unknown extension, `Output_error` when the file cannot be written.
void write_mesh(const Indexed_mesh_3& mesh, const std::filesystem::path& path);

}  // namespace pgdr

#endif
