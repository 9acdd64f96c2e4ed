// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_READ_PLC_H
#define PGDR_IO_READ_PLC_H

#include <filesystem>

#include <pgdr/domain/default_kernel.h>

namespace pgdr {

/// What in a surface file becomes markers of facets. Facets with different markers are never fused to one.
enum class Markers_from {
  names,   ///< the solids of an ASCII STL file, the groups (or objects) and materials of an OBJ file
  colors,  ///< the colours of faces in OFF and PLY files, named like "#ff8000"
  nothing
};

/// Reads a PLC; the extension (in any case) tells the format.
///
/// `.poly`, `.smesh`: TetGen's PLC formats, with comments, 0- or 1-based numbers, facets of several polygons,
/// facet holes, markers, volume holes and regions; a file without vertices takes them from the `.node`
/// file beside it. A facet that holds nothing but two-vertex polygons becomes explicit segments.
/// `.off`, `.stl` (ASCII and binary), `.ply` (ASCII and binary), `.obj`: surfaces, one facet per polygon, `Nesting::alternate`; normals
/// and textures are left out. Where `markers` finds several groups of facets in such a file, they have the markers 1, 2, ... in the order
/// in which they begin, and their names; a single one has the marker 0.
///
/// `.mesh`, `.vtu`, `.msh`: a mesh that is to be refined further (`read_mesh`, `plc_of_mesh`).
///
/// Throws `Input_error`, whose message is one sentence with the file and, in text files, the 1-based line.
Plc read_plc(const std::filesystem::path& path, Markers_from markers = Markers_from::names);

/// The files that `read_plc` reads: this one, and the `.node` file beside it if the vertices are there. It need not exist.
std::vector<std::filesystem::path> plc_files(const std::filesystem::path& path);

/// Whether the extension is that of a surface format.
bool is_surface_file(const std::filesystem::path& path);

/// Whether `read_plc` knows the extension.
bool is_known_plc_extension(const std::filesystem::path& path);

}  // namespace pgdr

#endif
