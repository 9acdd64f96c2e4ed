// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/write_mesh.h>

#include <stdexcept>
#include <string>

#include <pgdr/io/medit.h>
#include <pgdr/io/vtu.h>

#include "readers.h"

namespace pgdr {

bool is_known_mesh_extension(const std::filesystem::path& path) {
  const std::string extension = io_detail::lower_extension(path);
  return extension == ".mesh" || extension == ".vtu";
}

void write_mesh(const Indexed_mesh_3& mesh, const std::filesystem::path& path) {
  const std::string extension = io_detail::lower_extension(path);
  if (extension == ".mesh") return write_medit(mesh, path);
  if (extension == ".vtu") return write_vtu(mesh, path);
  throw std::invalid_argument("cannot write '" + path.string() + "': the extension '" + extension +
                              "' is not one of .mesh, .vtu");
}

}  // namespace pgdr
