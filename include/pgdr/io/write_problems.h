// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_WRITE_PROBLEMS_H
#define PGDR_IO_WRITE_PROBLEMS_H

#include <filesystem>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/input_error.h>
#include <pgdr/domain/plc.h>

namespace pgdr {

/// Writes what problems name as a VTK XML unstructured grid, to look at in ParaView: facets as polygons, two vertices as the edge
/// between them, other vertices as points. What cannot be drawn, since its vertices are missing or not finite, is left out.
///
/// Cell data: `problem` (Int32), the position of the problem among `problems`; `facet` (Int32), in the numbering of the input
/// file, -1 for edges and points. Point data: `vertex` (Int32), in that numbering. Coordinates are Float64, all as text.
/// Throws `Output_error`; the file appears complete or not at all.
void write_problems(const Plc& plc, const std::vector<Input_problem>& problems, const std::filesystem::path& path);

}  // namespace pgdr

#endif
