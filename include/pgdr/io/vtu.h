// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_VTU_H
#define PGDR_IO_VTU_H

#include <filesystem>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// Writes the tetrahedra as a VTK XML unstructured grid, appended raw binary, zlib-compressed.
///
/// Cell data: `region` (Int32), `radius_edge_ratio` and `min_dihedral_angle` in degrees (Float32: for looking
/// at, not for checking a bound), `exempt` and `unrefined` (UInt8, 1 for the cells in
/// `mesh.exempt` and `mesh.unrefined`).
/// Point data: `reference` (Int32) and, unless `point_dimensions` is empty, `in_dimension` (UInt8).
/// Coordinates are Float64. Memory beside the mesh: a few blocks of 64 KiB for each thread of the
/// caller's arena, all of which work; the bytes do not depend on how many there are.
/// Throws `Output_error`; the file appears complete or not at all.
void write_vtu(const Indexed_mesh_3& mesh, const std::filesystem::path& path);

}  // namespace pgdr

#endif
