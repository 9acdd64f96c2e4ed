// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/read_plc.h>

#include <algorithm>
#include <string>
#include <vector>

#include <pgdr/domain/reference_names.h>
#include <pgdr/io/read_mesh.h>

#include "file_text.h"
#include "readers.h"

namespace pgdr {
namespace io_detail {

std::string lower_extension(const std::filesystem::path& path) {
  return in_lower_case(path.extension().string());
}

}  // namespace io_detail

namespace {

bool is_mesh(const std::string& extension) { return std::ranges::find(readable_mesh_extensions(), extension) != readable_mesh_extensions().end(); }

Plc read_any(const std::filesystem::path& path, Markers_from markers) {
  using namespace io_detail;
  const std::string extension = lower_extension(path);
  if (extension == ".poly") return read_tetgen(path, Tetgen_format::poly);
  if (extension == ".smesh") return read_tetgen(path, Tetgen_format::smesh);
  if (extension == ".off") return read_surface(path, Surface_format::off, markers);
  if (extension == ".stl") return read_surface(path, Surface_format::stl, markers);
  if (extension == ".ply") return read_surface(path, Surface_format::ply, markers);
  if (extension == ".obj") return read_surface(path, Surface_format::obj, markers);
  if (is_mesh(extension)) return plc_of_mesh(read_mesh(path));
  fail_at(path, 0, Input_problem::Kind::unreadable,
          "the extension '" + extension + "' is not one of .poly, .smesh, .off, .stl, .ply, .obj, .mesh, .vtu, .msh");
}

}  // namespace

Plc read_plc(const std::filesystem::path& path, Markers_from markers) {
  Plc plc = read_any(path, markers);
  plc.name = io_detail::as_utf8(path.stem().string());
  return plc;
}

std::vector<std::filesystem::path> plc_files(const std::filesystem::path& path) {
  const std::string extension = io_detail::lower_extension(path);
  std::vector<std::filesystem::path> files{path};
  if ((extension == ".poly" || extension == ".smesh") && io_detail::has_node_file(path)) files.push_back(io_detail::node_file(path));
  return files;
}

bool is_surface_file(const std::filesystem::path& path) {
  const std::string extension = io_detail::lower_extension(path);
  return extension == ".off" || extension == ".stl" || extension == ".ply" || extension == ".obj";
}

bool is_known_plc_extension(const std::filesystem::path& path) {
  const std::string extension = io_detail::lower_extension(path);
  return extension == ".poly" || extension == ".smesh" || is_surface_file(path) || is_mesh(extension);
}

}  // namespace pgdr
