// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pgdr/io/atomic_file.h>
#include <pgdr/io/tetgen.h>

#include "mesh_groups.h"

namespace pgdr {
namespace {

using io_detail::put_char;
using io_detail::put_number;

/// A line for each item behind a first one: number, what `put` writes, reference.
template <class Put>
void write_items(Atomic_file& out, std::size_t count, const std::string& header, const std::vector<std::int32_t>& references, const Put& put) {
  out.write(std::to_string(count) + header + "\n");
  io_detail::write_rows(out, count, 6, [&](std::size_t first, std::size_t last, char* text) {
    for (std::size_t i = first; i < last; ++i) {
      text = put(put_number(text, i), i);
      text = put_char(put_number(put_char(text, ' '), io_detail::reference_of(references, i)), '\n');
    }
    return text;
  });
}

}  // namespace

void write_tetgen(const Indexed_mesh_3& mesh, const std::filesystem::path& path) {
  const auto file = [&path](const char* extension) { return std::filesystem::path(path).replace_extension(extension); };
  Atomic_file node(file(".node")), ele(path), face(file(".face")), edge(file(".edge"));
  const auto vertices_of = [](const auto& elements) {
    return [&elements](char* text, std::size_t i) { return io_detail::put_vertices(text, elements[i], 0, ' '); };
  };
  write_items(node, mesh.points.size(), " 3 0 1", mesh.point_references, [&](char* text, std::size_t i) { return io_detail::put_point(text, mesh, i, ' '); });
  write_items(ele, mesh.tetrahedra.size(), " 4 1", mesh.tetrahedron_references, vertices_of(mesh.tetrahedra));
  write_items(face, mesh.triangles.size(), " 1", mesh.triangle_references, vertices_of(mesh.triangles));
  write_items(edge, mesh.edges.size(), " 1", mesh.edge_references, vertices_of(mesh.edges));
  for (Atomic_file* f : {&node, &ele, &face, &edge}) f->commit();
}

}  // namespace pgdr
