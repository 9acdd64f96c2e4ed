// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/write_mesh.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <pgdr/io/abaqus.h>
#include <pgdr/io/medit.h>
#include <pgdr/io/su2.h>
#include <pgdr/io/tetgen.h>
#include <pgdr/io/vtu.h>

#include "readers.h"

namespace pgdr {

const std::vector<std::string>& mesh_extensions() {
  static const std::vector<std::string> extensions{".vtu", ".mesh", ".msh", ".inp", ".su2", ".ele"};
  return extensions;
}

bool is_known_mesh_extension(const std::filesystem::path& path) {
  return std::ranges::find(mesh_extensions(), io_detail::lower_extension(path)) != mesh_extensions().end();
}

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files{path};
  if (io_detail::lower_extension(path) == ".ele")
    for (const char* extension : {".node", ".face", ".edge"}) files.push_back(std::filesystem::path(path).replace_extension(extension));
  return files;
}

void write_mesh(const Indexed_mesh_3& mesh, const std::filesystem::path& path, Gmsh_format gmsh) {
  const std::string extension = io_detail::lower_extension(path);
  if (extension == ".vtu") return write_vtu(mesh, path);
  if (extension == ".mesh") return write_medit(mesh, path);
  if (extension == ".msh") return write_gmsh(mesh, path, gmsh);
  if (extension == ".inp") return write_abaqus(mesh, path);
  if (extension == ".su2") return write_su2(mesh, path);
  if (extension == ".ele") return write_tetgen(mesh, path);
  std::string known;
  for (const std::string& e : mesh_extensions()) known += (known.empty() ? "" : ", ") + e;
  throw std::invalid_argument("cannot write '" + path.string() + "': the extension '" + extension + "' is not one of " + known);
}

}  // namespace pgdr
