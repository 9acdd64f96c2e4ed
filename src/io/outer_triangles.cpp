// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/outer_triangles.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_sort.h>

namespace pgdr {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

Triangle ascending(Triangle t) {
  std::ranges::sort(t);
  return t;
}

/// For each triangle how many tetrahedra have it as a face.
std::vector<std::uint32_t> tetrahedra_at(const Indexed_mesh_3& mesh) {
  std::vector<Triangle> corners(mesh.triangles.size());
  std::ranges::transform(mesh.triangles, corners.begin(), ascending);
  std::vector<std::uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0u);
  parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return corners[a] < corners[b]; });
  // Most tetrahedra have too few vertices on the boundary to be worth a search.
  std::vector<char> is_on_triangle(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t p : t) is_on_triangle[p] = 1;

  std::vector<std::uint32_t> count(corners.size(), 0);
  parallel_for_chunks(mesh.tetrahedra.size(), default_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t opposite = 0; opposite < 4; ++opposite) {
        const auto& t = mesh.tetrahedra[i];
        const Triangle face = ascending({t[opposite == 0 ? 1 : 0], t[opposite <= 1 ? 2 : 1], t[opposite <= 2 ? 3 : 2]});
        if (!std::ranges::all_of(face, [&](std::uint32_t p) { return is_on_triangle[p] != 0; })) continue;
        const auto found = std::ranges::lower_bound(order, face, {}, [&](std::uint32_t k) { return corners[k]; });
        if (found != order.end() && corners[*found] == face) std::atomic_ref(count[*found]).fetch_add(1, std::memory_order_relaxed);
      }
  });
  return count;
}

}  // namespace

std::size_t keep_outer_triangles(Indexed_mesh_3& mesh) {
  const std::vector<std::uint32_t> count = tetrahedra_at(mesh);
  const auto keep_outer = [&](auto& values) {
    if (values.empty()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count.size(); ++i)
      if (count[i] < 2) values[kept++] = values[i];
    values.resize(kept);
  };
  keep_outer(mesh.triangle_references);
  keep_outer(mesh.triangle_input_facets);
  keep_outer(mesh.triangle_nodes);
  keep_outer(mesh.triangles);
  return count.size() - mesh.triangles.size();
}

}  // namespace pgdr
