// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pgdr/domain/scale.h>
#include <pgdr/io/atomic_file.h>
#include <pgdr/io/medit.h>

#include "mesh_groups.h"

namespace pgdr {
namespace {

using io_detail::put_char;
using io_detail::put_number;
using io_detail::reference_of;

/// Of the longest rows: four vertices and a reference.
constexpr std::size_t most_columns = 5;

/// Formats the rows [first, last) of the vertex section; returns the end of the text.
char* format_points(const Indexed_mesh_3& mesh, std::size_t first, std::size_t last, char* out) {
  const double unit = unit_of(mesh);
  for (std::size_t i = first; i < last; ++i) {
    for (const double x : mesh.points[i]) out = put_char(put_number(out, unit * x), ' ');
    out = put_char(put_number(out, reference_of(mesh.point_references, i)), '\n');
  }
  return out;
}

/// Formats the rows [first, last) of an element section; returns the end of the text.
template <std::size_t N>
char* format_elements(const std::vector<std::array<std::uint32_t, N>>& elements,
                      const std::vector<std::int32_t>& references, std::size_t first, std::size_t last,
                      char* out) {
  for (std::size_t i = first; i < last; ++i) {
    for (const std::uint32_t vertex : elements[i])
      out = put_char(put_number(out, std::uint64_t(vertex) + 1), ' ');
    out = put_char(put_number(out, reference_of(references, i)), '\n');
  }
  return out;
}

template <class Format>
void write_section(Atomic_file& out, const char* keyword, std::size_t count, const Format& format) {
  out.write("\n" + std::string(keyword) + "\n" + std::to_string(count) + "\n");
  io_detail::write_rows(out, count, most_columns, format);
}

template <std::size_t N>
void write_elements(Atomic_file& out, const char* keyword,
                    const std::vector<std::array<std::uint32_t, N>>& elements,
                    const std::vector<std::int32_t>& references) {
  write_section(out, keyword, elements.size(), [&](std::size_t first, std::size_t last, char* text) {
    return format_elements(elements, references, first, last, text);
  });
}

}  // namespace

void write_medit(const Indexed_mesh_3& mesh, const std::filesystem::path& path) {
  io_detail::require_first_order(mesh, path);
  Atomic_file out(path);
  out.write("MeshVersionFormatted 2\n\nDimension 3\n");
  write_section(out, "Vertices", mesh.points.size(), [&](std::size_t first, std::size_t last, char* text) {
    return format_points(mesh, first, last, text);
  });
  if (!mesh.edges.empty()) write_elements(out, "Edges", mesh.edges, mesh.edge_references);
  if (!mesh.triangles.empty()) write_elements(out, "Triangles", mesh.triangles, mesh.triangle_references);
  write_elements(out, "Tetrahedra", mesh.tetrahedra, mesh.tetrahedron_references);
  out.write("\nEnd\n");
  out.commit();
}

}  // namespace pgdr
