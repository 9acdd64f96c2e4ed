// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/second_order.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_sort.h>

namespace pgdr {
namespace {

/// The ends of an edge, the smaller one first: ascending numbers are edges in order.
std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

constexpr std::array<std::array<std::size_t, 2>, 6> ends_in_tetrahedron{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<std::array<std::size_t, 2>, 3> ends_in_triangle{{{0, 1}, {1, 2}, {2, 0}}};

std::vector<std::uint64_t> edges_of(const std::vector<std::array<std::uint32_t, 4>>& tetrahedra) {
  std::vector<std::uint64_t> edges(6 * tetrahedra.size());
  parallel_for_chunks(tetrahedra.size(), default_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t)
      for (std::size_t k = 0; k < 6; ++k) edges[6 * t + k] = key(tetrahedra[t][ends_in_tetrahedron[k][0]], tetrahedra[t][ends_in_tetrahedron[k][1]]);
  });
  parallel_sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

void add_midside_nodes(Indexed_mesh_3& mesh) {
  if (!mesh.tetrahedron_nodes.empty()) return;
  const std::vector<std::uint64_t> edges = edges_of(mesh.tetrahedra);
  const std::size_t corners = mesh.points.size();
  if (edges.size() > std::numeric_limits<std::uint32_t>::max() - corners) throw std::length_error("the mesh has too many edges for a node on each");
  const auto node = [&](std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint32_t>(corners + static_cast<std::size_t>(std::ranges::lower_bound(edges, key(a, b)) - edges.begin()));
  };

  mesh.points.resize(corners + edges.size());
  parallel_for_chunks(edges.size(), default_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) {
      const auto& a = mesh.points[edges[e] >> 32];
      const auto& b = mesh.points[edges[e] & 0xffffffffu];
      for (std::size_t k = 0; k < 3; ++k) mesh.points[corners + e][k] = a[k] / 2 + b[k] / 2;
    }
  });
  const auto fill = [&](const auto& elements, const auto& ends, auto& nodes) {
    nodes.resize(elements.size());
    parallel_for_chunks(elements.size(), default_grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        for (std::size_t k = 0; k < ends.size(); ++k) nodes[i][k] = node(elements[i][ends[k][0]], elements[i][ends[k][1]]);
    });
  };
  fill(mesh.tetrahedra, ends_in_tetrahedron, mesh.tetrahedron_nodes);
  fill(mesh.triangles, ends_in_triangle, mesh.triangle_nodes);
  for (const auto& [a, b] : mesh.edges) mesh.edge_nodes.push_back(node(a, b));

  if (!mesh.point_references.empty()) mesh.point_references.resize(mesh.points.size(), 0);
  if (mesh.point_dimensions.empty()) return;
  mesh.point_dimensions.resize(mesh.points.size(), 3);
  for (const auto& nodes : mesh.triangle_nodes)
    for (const std::uint32_t n : nodes) mesh.point_dimensions[n] = 2;
  for (const std::uint32_t n : mesh.edge_nodes) mesh.point_dimensions[n] = 1;
}

Indexed_mesh_3 without_midside_nodes(Indexed_mesh_3 mesh) {
  std::uint32_t first = static_cast<std::uint32_t>(mesh.points.size());
  for (const auto& nodes : mesh.tetrahedron_nodes) first = std::min(first, *std::ranges::min_element(nodes));
  mesh.points.resize(first);
  if (!mesh.point_references.empty()) mesh.point_references.resize(first);
  if (!mesh.point_dimensions.empty()) mesh.point_dimensions.resize(first);
  mesh.tetrahedron_nodes.clear();
  mesh.triangle_nodes.clear();
  mesh.edge_nodes.clear();
  return mesh;
}

}  // namespace pgdr
