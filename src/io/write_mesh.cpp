// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/write_mesh.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include <pgdr/io/abaqus.h>
#include <pgdr/io/medit.h>
#include <pgdr/io/su2.h>
#include <pgdr/io/tetgen.h>
#include <pgdr/io/vtk.h>

#include "readers.h"

namespace pgdr {
namespace {

struct Format {
  const char* extension;
  int order;  ///< the highest that it has
  void (*write)(const Indexed_mesh_3&, const std::filesystem::path&, const Write_options&);
};

/// A writer whose format leaves nothing to choose.
template <void (*write)(const Indexed_mesh_3&, const std::filesystem::path&)>
void plain(const Indexed_mesh_3& mesh, const std::filesystem::path& path, const Write_options&) {
  write(mesh, path);
}

constexpr std::array formats{
    Format{".vtu", 2, [](const Indexed_mesh_3& mesh, const std::filesystem::path& path, const Write_options& o) { write_vtu(mesh, path, o.vtu); }},
    Format{".vtk", 2, plain<write_vtk>},
    Format{".mesh", 1, plain<write_medit>},
    Format{".msh", 2, [](const Indexed_mesh_3& mesh, const std::filesystem::path& path, const Write_options& o) { write_gmsh(mesh, path, o.gmsh); }},
    Format{".inp", 2, plain<write_abaqus>},
    Format{".su2", 1, plain<write_su2>},
    Format{".ele", 2, plain<write_tetgen>},
};

const Format* format_of(const std::filesystem::path& path) {
  const auto found = std::ranges::find(formats, io_detail::lower_extension(path), &Format::extension);
  return found == formats.end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> mesh_extensions(int order) {
  std::vector<std::string> extensions;
  for (const Format& f : formats)
    if (order <= f.order) extensions.emplace_back(f.extension);
  return extensions;
}

bool is_known_mesh_extension(const std::filesystem::path& path) { return format_of(path) != nullptr; }

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path) {
  return io_detail::lower_extension(path) == ".ele" ? tetgen_files(path) : std::vector{path};
}

void write_mesh(const Indexed_mesh_3& mesh, const std::filesystem::path& path, const Write_options& options) {
  const Format* const format = format_of(path);
  const int order = mesh.tetrahedron_nodes.empty() ? 1 : 2;
  if (format && order <= format->order) return format->write(mesh, path, options);
  std::string known;
  for (const std::string& e : mesh_extensions(order)) known += (known.empty() ? "" : ", ") + e;
  throw std::invalid_argument("cannot write '" + path.string() + "': the extension '" + path.extension().string() + "' is not one of " + known +
                              (format ? ", which have elements of second order" : ""));
}

}  // namespace pgdr
