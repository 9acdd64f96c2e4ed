// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_IO_READ_SIZES_H
#define PGDR_IO_READ_SIZES_H

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <pgdr/sizing/grid_sizing_field.h>

namespace pgdr {

/// Values at points, as files with a background mesh have them.
struct Nodal_values {
  std::vector<std::array<double, 3>> points;
  std::vector<double> values;
  std::optional<Sizing_grid> grid;  ///< the points of an image
};

/// Reads an array with one component from a VTK XML file: an unstructured grid (`.vtu`), or image data (`.vti`), of one piece, little endian, in any of the encodings (ASCII,
/// base64 or raw, compressed by zlib or not). Cell data of a grid are averaged at the nodes of the cells; those of an image stand at the centers of its cells.
/// Throws `Input_error` that names the arrays there are if there is no such one.
Nodal_values read_nodal_values(const std::filesystem::path& path, const std::string& array);

}  // namespace pgdr

#endif
