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
  io_detail::write_rows(out, count, 12, [&](std::size_t first, std::size_t last, char* text) {
    for (std::size_t i = first; i < last; ++i) {
      text = put(put_number(text, i), i);
      text = put_char(put_number(put_char(text, ' '), io_detail::reference_of(references, i)), '\n');
    }
    return text;
  });
}

}  // namespace

std::vector<std::filesystem::path> tetgen_files(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files{path};
  for (const char* extension : {".node", ".face", ".edge"}) files.push_back(std::filesystem::path(path).replace_extension(extension));
  return files;
}

void write_tetgen(const Indexed_mesh_3& mesh, const std::filesystem::path& path) {
  const std::vector<std::filesystem::path> files = tetgen_files(path);
  Atomic_file ele(files[0]), node(files[1]), face(files[2]), edge(files[3]);
  const auto tetrahedra = io_detail::tetrahedra_of(mesh, io_detail::edges_in_tetgen);
  write_items(node, mesh.points.size(), " 3 0 1", mesh.point_references, [&](char* text, std::size_t i) { return io_detail::put_point(text, mesh, i, ' '); });
  write_items(ele, tetrahedra.size(), " " + std::to_string(tetrahedra.nodes_of_each()) + " 1", mesh.tetrahedron_references,
              [&](char* text, std::size_t i) { return io_detail::put_nodes(text, tetrahedra, i, 0, ' '); });
  const auto triangles = io_detail::triangles_of(mesh);
  write_items(face, triangles.size(), " 1", mesh.triangle_references, [&](char* text, std::size_t i) { return io_detail::put_nodes(text, triangles, i, 0, ' '); });
  write_items(edge, mesh.edges.size(), " 1", mesh.edge_references, [&](char* text, std::size_t i) {
    for (const std::uint32_t v : mesh.edges[i]) text = put_number(put_char(text, ' '), v);
    return mesh.edge_nodes.empty() ? text : put_number(put_char(text, ' '), mesh.edge_nodes[i]);
  });
  for (Atomic_file* f : {&node, &ele, &face, &edge}) f->commit();
}

}  // namespace pgdr
