// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstddef>
#include <string>

#include <pgdr/io/atomic_file.h>
#include <pgdr/io/su2.h>

#include "mesh_groups.h"

namespace pgdr {

void write_su2(const Indexed_mesh_3& mesh, const std::filesystem::path& path) {
  using io_detail::put_char;
  using io_detail::put_number;
  // VTK's types of cells.
  constexpr int triangle = 5, tetrahedron = 10;
  const auto tetrahedra = io_detail::tetrahedra_of(mesh, io_detail::edges_in_vtk);
  const auto triangles = io_detail::triangles_of(mesh);
  io_detail::require_first_order(mesh, path);
  Atomic_file out(path);
  out.write("NDIME= 3\nNELEM= " + std::to_string(mesh.tetrahedra.size()) + "\n");
  io_detail::write_rows(out, mesh.tetrahedra.size(), 6, [&](std::size_t first, std::size_t last, char* text) {
    for (std::size_t i = first; i < last; ++i) {
      text = io_detail::put_nodes(put_number(text, tetrahedron), tetrahedra, i, 0, ' ');
      text = put_char(put_number(put_char(text, ' '), i), '\n');
    }
    return text;
  });
  out.write("NPOIN= " + std::to_string(mesh.points.size()) + "\n");
  io_detail::write_rows(out, mesh.points.size(), 5, [&](std::size_t first, std::size_t last, char* text) {
    for (std::size_t i = first; i < last; ++i) text = put_char(put_number(put_char(io_detail::put_point(text, mesh, i, ' '), ' '), i), '\n');
    return text;
  });
  const auto markers = io_detail::markers_of(mesh, io_detail::word_of);
  out.write("NMARK= " + std::to_string(markers.size()) + "\n");
  for (const io_detail::Mesh_group& g : markers) {
    out.write("MARKER_TAG= " + g.name + "\nMARKER_ELEMS= " + std::to_string(g.elements.size()) + "\n");
    io_detail::write_rows(out, g.elements.size(), 4, [&](std::size_t first, std::size_t last, char* text) {
      for (std::size_t i = first; i < last; ++i) text = put_char(io_detail::put_nodes(put_number(text, triangle), triangles, g.elements[i], 0, ' '), '\n');
      return text;
    });
  }
  out.commit();
}

}  // namespace pgdr
