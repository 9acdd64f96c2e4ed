// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SRC_IO_READERS_H
#define PGDR_SRC_IO_READERS_H

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/io/read_plc.h>

#include "facet_groups.h"

namespace pgdr::io_detail {

/// The extension in lower case, with its dot.
std::string lower_extension(const std::filesystem::path& path);

enum class Tetgen_format { poly, smesh };
enum class Surface_format { off, stl, ply, obj };

Plc read_tetgen(const std::filesystem::path& path, Tetgen_format format);
/// Whether a TetGen file takes its vertices from the file beside it.
bool has_node_file(const std::filesystem::path& path);
inline std::filesystem::path node_file(std::filesystem::path path) { return path.replace_extension(".node"); }
Plc read_surface(const std::filesystem::path& path, Surface_format format, Markers_from markers);

/// What CGAL's reader gets to see, and what it has to find there.
///
/// CGAL's readers stop at a wrong file without saying where, and take some wrong files for right ones.
/// So each file is checked first, word by word; the text formats are also reduced to coordinates and indices.
struct Checked_surface {
  std::string text;
  std::size_t vertices = 0;  ///< 0 where the format does not count them (`.stl`)
  std::size_t facets = 0;
  Facet_groups groups;  ///< empty where the format has none, or they were not asked for
};

Checked_surface check_off(std::string_view text, const std::filesystem::path& path, Markers_from markers);
Checked_surface check_obj(std::string_view text, const std::filesystem::path& path, Markers_from markers);
Checked_surface check_stl(std::string_view text, const std::filesystem::path& path, Markers_from markers);
Checked_surface check_ply(std::string_view text, const std::filesystem::path& path, Markers_from markers);

}  // namespace pgdr::io_detail

#endif
