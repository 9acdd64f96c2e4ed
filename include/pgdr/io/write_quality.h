// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_WRITE_QUALITY_H
#define PGDR_IO_WRITE_QUALITY_H

#include <filesystem>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// Writes the quality of every tetrahedron as comma-separated values, a line each behind a line of names: its number in the mesh, counted
/// from 0, its region, volume, circumradius, radius-edge ratio, smallest and largest dihedral angle in degrees, the four
/// `Shape_measures`, and, `with_marks`, 1 or 0 for exempt and for unrefined (a mesh that was read from a file does not know which are). Lengths
/// are in the units of the input; what has no unit is rounded to single precision.
/// Throws `Output_error` when the file cannot be written.
void write_quality(const Indexed_mesh_3& mesh, const std::filesystem::path& path, bool with_marks = true);

}  // namespace pgdr

#endif
