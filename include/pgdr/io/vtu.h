// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_VTU_H
#define PGDR_IO_VTU_H

#include <filesystem>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

struct Vtu_options {
  bool triangles = false;  ///< those on facets become cells, too, behind the tetrahedra
  int compression = 1;     ///< zlib's level, 0 (none) to 9; each step beyond 1 takes longer for a few percent
};

/// Writes the tetrahedra as a VTK XML unstructured grid, appended raw binary, zlib-compressed; of second order if the mesh is.
///
/// Cell data: `region` (Int32), `radius_edge_ratio` and `min_dihedral_angle` in degrees (Float32: for looking
/// at, not for checking a bound), `exempt` and `unrefined` (UInt8, 1 for the cells in
/// `mesh.exempt` and `mesh.unrefined`). With triangles also `marker`, `attribute` (regions and markers as positive numbers, what MFEM
/// reads) and, where the mesh has them, `input_facet` (-1 for tetrahedra); what tetrahedra have is 0 for triangles, and the other way around.
/// Point data: `reference` (Int32) and, unless `point_dimensions` is empty, `in_dimension` (UInt8). Field data: for each name of a marker
/// or region an array of that name, with the number and the dimension 2 or 3, as meshio has it.
/// Coordinates are Float64. Memory beside the mesh: a few blocks of 64 KiB for each thread of the
/// caller's arena, all of which work; the bytes do not depend on how many there are.
/// Throws `Output_error`; the file appears complete or not at all.
void write_vtu(const Indexed_mesh_3& mesh, const std::filesystem::path& path, const Vtu_options& options = {});

}  // namespace pgdr

#endif
