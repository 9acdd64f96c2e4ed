// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_ABAQUS_H
#define PGDR_IO_ABAQUS_H

#include <filesystem>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// Writes tetrahedra (`C3D4`, of second order `C3D10`), and surfaces by marker, as an Abaqus input deck, as CalculiX reads it, too: nodes and elements without material, steps or
/// loads. Coordinates take at most 20 characters, all that such a deck may have: some are rounded to 13 digits. Element sets have the names of regions, surfaces (sides of tetrahedra) those of markers, as far as sets may, else "region_ID" and "marker_M". Numbers are from 1.
/// Throws `Output_error`; the file appears complete or not at all.
void write_abaqus(const Indexed_mesh_3& mesh, const std::filesystem::path& path);

}  // namespace pgdr

#endif
