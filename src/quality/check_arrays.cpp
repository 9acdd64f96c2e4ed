// SPDX-License-Identifier: GPL-3.0-or-later
// The checks that need the arrays only: indices, vertices, duplicates, orientation, edges.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_reduce.h>
#include <pgdr/parallel/parallel_sort.h>

#include "check_parts.h"

namespace pgdr::quality_detail {

namespace {

template <std::size_t N>
void find_bad_indices(const std::vector<std::array<std::uint32_t, N>>& items, std::size_t references,
                      std::size_t n_vertices, const char* name, Failures& failures) {
  if (items.size() != references)
    failures.add(items.size(), " items, but ", references, " references in the section of ", name);
  for (std::size_t i = 0; i < items.size(); ++i)
    for (const std::uint32_t v : items[i])
      if (v >= n_vertices) failures.add(name, " ", i, " has vertex ", v, " of ", n_vertices);
}

/// Adds a failure for every item with a repeated vertex and for every item that is there again.
template <std::size_t N>
void find_duplicates(const std::vector<std::array<std::uint32_t, N>>& items, const char* name,
                     Failures& failures) {
  std::vector<std::array<std::uint32_t, N>> sorted(items);
  const auto repeats = parallel_collect(sorted.size(), default_grain, [&](std::size_t first, std::size_t last) {
    std::vector<std::size_t> found;
    for (std::size_t i = first; i < last; ++i) {
      std::sort(sorted[i].begin(), sorted[i].end());
      if (std::adjacent_find(sorted[i].begin(), sorted[i].end()) != sorted[i].end()) found.push_back(i);
    }
    return found;
  });
  for (const std::size_t i : repeats) failures.add(name, " ", i, " has a vertex twice");
  parallel_sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] == sorted[i - 1])
      failures.add(name, " with the vertices ", sorted[i][0], ", ", sorted[i][1], N > 2 ? ", ..." : "",
                   " is there more than once");
}

}  // namespace

Check_line check_indices(const Indexed_mesh_3& mesh, std::size_t most_tetrahedra) {
  Failures failures;
  const std::size_t n = mesh.points.size();
  if (mesh.tetrahedra.empty()) failures.add("there are no tetrahedra");
  if (mesh.tetrahedra.size() > most_tetrahedra) failures.add("more than ", most_tetrahedra, " tetrahedra cannot be checked");
  if (mesh.point_references.size() != n)
    failures.add(n, " vertices, but ", mesh.point_references.size(), " vertex references");
  for (std::size_t v = 0; v < n; ++v)
    for (const double x : mesh.points[v])
      if (!std::isfinite(x)) failures.add("vertex ", v, " has the coordinate ", x);
  find_bad_indices(mesh.edges, mesh.edge_references.size(), n, "edge", failures);
  find_bad_indices(mesh.triangles, mesh.triangle_references.size(), n, "triangle", failures);
  find_bad_indices(mesh.tetrahedra, mesh.tetrahedron_references.size(), n, "tetrahedron", failures);
  return failures.line("indices", text(n, " vertices, ", mesh.edges.size(), " edges, ", mesh.triangles.size(),
                                       " triangles, ", mesh.tetrahedra.size(), " tetrahedra"));
}

Check_line check_vertices(const Indexed_mesh_3& mesh) {
  Failures failures;
  std::vector<bool> used(mesh.points.size());
  for (const auto& t : mesh.tetrahedra)
    for (const std::uint32_t v : t) used[v] = true;
  std::size_t unused = 0, twins = 0;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (!used[v]) ++unused, failures.add("vertex ", v, " belongs to no tetrahedron");

  std::vector<std::uint32_t> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0u);
  parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return mesh.points[a] != mesh.points[b] ? mesh.points[a] < mesh.points[b] : a < b;
  });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (mesh.points[order[i]] == mesh.points[order[i - 1]])
      ++twins, failures.add("vertices ", order[i - 1], " and ", order[i], " are at the same place");
  return failures.line("vertices", text(unused, " unused, ", twins, " at the place of another"));
}

Check_line check_duplicates(const Indexed_mesh_3& mesh) {
  Failures failures;
  find_duplicates(mesh.tetrahedra, "tetrahedron", failures);
  find_duplicates(mesh.triangles, "triangle", failures);
  find_duplicates(mesh.edges, "edge", failures);
  return failures.line("duplicates", text(failures.count(), " found"));
}

Check_line check_orientation(const Indexed_mesh_3& mesh) {
  Failures failures;
  std::size_t flat = 0, negative = 0;
  const auto bad = parallel_collect(mesh.tetrahedra.size(), default_grain, [&](std::size_t first, std::size_t last) {
    std::vector<std::pair<std::size_t, CGAL::Orientation>> found;
    for (std::size_t i = first; i < last; ++i) {
      const auto& t = mesh.tetrahedra[i];
      const auto orientation =
          CGAL::orientation(point(mesh, t[0]), point(mesh, t[1]), point(mesh, t[2]), point(mesh, t[3]));
      if (orientation != CGAL::POSITIVE) found.emplace_back(i, orientation);
    }
    return found;
  });
  for (const auto& [i, orientation] : bad) {
    ++(orientation == CGAL::COPLANAR ? flat : negative);
    failures.add("tetrahedron ", i);
  }
  return failures.line("orientation",
                       text(negative, " negative, ", flat, " flat of ", mesh.tetrahedra.size()));
}

Check_line check_edges(const Indexed_mesh_3& mesh) {
  // The listed edges, sorted with the smaller vertex first, and where those of each smaller vertex start.
  std::vector<std::array<std::uint32_t, 2>> edges(mesh.edges);
  for (auto& e : edges) std::sort(e.begin(), e.end());
  std::sort(edges.begin(), edges.end());
  std::vector<std::size_t> begin(mesh.points.size() + 1, 0);
  for (const auto& e : edges) ++begin[e[0] + 1];
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];

  std::vector<bool> found(edges.size());
  for (const auto& t : mesh.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const auto [a, b] = std::minmax(t[i], t[j]);
        for (std::size_t e = begin[a]; e < begin[a + 1]; ++e)
          if (edges[e][1] == b) found[e] = true;
      }
  Failures failures;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (!found[e])
      failures.add("no tetrahedron has the edge between vertices ", edges[e][0], " and ", edges[e][1]);
  return failures.line("edges",
                       text(edges.size(), " listed, all of tetrahedra: ", failures.none() ? "yes" : "no"));
}

}  // namespace pgdr::quality_detail
