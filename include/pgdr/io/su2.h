// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_SU2_H
#define PGDR_IO_SU2_H

#include <filesystem>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// Writes tetrahedra and boundary markers, by their names or "marker_M", in the native format of the flow solver SU2. Regions have no place in it; triangles between or inside regions are
/// markers like all others.
/// Throws `Output_error`; the file appears complete or not at all.
void write_su2(const Indexed_mesh_3& mesh, const std::filesystem::path& path);

}  // namespace pgdr

#endif
