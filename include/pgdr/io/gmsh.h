// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_GMSH_H
#define PGDR_IO_GMSH_H

#include <filesystem>
#include <optional>
#include <string_view>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// The versions of Gmsh's `.msh` format that are written.
enum class Gmsh_format {
  binary_4_1,  ///< what Gmsh itself, DOLFINx and meshio read fastest
  ascii_4_1,
  ascii_2_2    ///< what older readers know: gmshToFoam, MFEM
};

/// The format called "4.1", "4.1-ascii" or "2.2".
std::optional<Gmsh_format> gmsh_format_named(std::string_view name);

/// Writes tetrahedra, and triangles on facets, as Gmsh's `.msh` (Gmsh manual, sections "MSH file format" and "MSH file format version 2").
///
/// Each region is a volume and a physical group with its name, or "region_ID", each marker a surface and a physical group with its name, or "marker_M". Tags are the ids and markers where these are positive, else
/// the smallest positive numbers that are not taken. Elements are of second order if the mesh is. Nodes and elements are numbered from 1, elements by triangles, then tetrahedra; nodes keep their order, within a group so do elements.
/// Throws `Output_error`; the file appears complete or not at all.
void write_gmsh(const Indexed_mesh_3& mesh, const std::filesystem::path& path, Gmsh_format format = Gmsh_format::binary_4_1);

/// Reads tetrahedra and triangles, of those of second order the corners, and lines of physical curves: Gmsh's formats 4.1, text or binary, and 2.2, text. Regions and markers are
/// the first physical group of each entity, with its name, or 0.
/// Throws `Input_error`, also for hexahedra, prisms and pyramids, and for a mesh in partitions.
Indexed_mesh_3 read_gmsh(const std::filesystem::path& path);

}  // namespace pgdr

#endif
