// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_patches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <pgdr/domain/vec_3.h>

#include "aabb_tree.h"

namespace pgdr::quality_detail {

namespace {

using Facet_triangle = Tagged<Plain::Triangle_3>;
using Tree = Aabb_tree<Plain::Triangle_3>;

double twice_area(const Indexed_mesh_3& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec_3 a = to_vec(mesh.points[t[0]]);
  return length(cross(to_vec(mesh.points[t[1]]) - a, to_vec(mesh.points[t[2]]) - a));
}

/// The facet within the tolerance of all vertices of `t` and of its centroid that is nearest to them.
std::uint32_t nearest_facet(const Indexed_mesh_3& mesh, const std::array<std::uint32_t, 3>& t,
                            const Epick_domain& domain, const Tree& tree, double reach) {
  std::array<Vec_3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = to_vec(mesh.points[t[i]]);
  const Vec_3 c = (1.0 / 3) * (p[0] + p[1] + p[2]);
  const Vec_3 normal = cross(p[1] - p[0], p[2] - p[0]);
  const Plain::Point_3 centroid(c.x, c.y, c.z);
  std::vector<const Facet_triangle*> hits;
  tree.all_intersected_primitives(
      Plain::Iso_cuboid_3(c.x - reach, c.y - reach, c.z - reach, c.x + reach, c.y + reach, c.z + reach),
      std::back_inserter(hits));
  std::uint32_t best = none;
  double best_distance = 0, best_cosine = 0;
  std::sort(hits.begin(), hits.end());  // positions in one array: the order of the facets
  for (const auto* hit : hits) {
    const auto& facet = domain.facets[hit->tag];
    const Vec_3 n = to_vec(facet.normal);
    double distance = std::sqrt(CGAL::squared_distance(centroid, hit->shape));
    for (const Vec_3& q : p) distance = std::max(distance, std::abs(dot(n, q - to_vec(facet.origin))));
    const double cosine = std::abs(dot(n, normal));
    if (best == none || distance < best_distance || (distance == best_distance && cosine > best_cosine)) {
      best = hit->tag;
      best_distance = distance;
      best_cosine = cosine;
    }
  }
  return best;
}

}  // namespace

std::vector<Triangle_edge> triangle_edges(const Indexed_mesh_3& mesh) {
  std::vector<std::array<std::uint32_t, 2>> listed(mesh.edges);
  for (auto& e : listed) std::sort(e.begin(), e.end());
  std::sort(listed.begin(), listed.end());
  std::vector<Triangle_edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const auto [a, b] = std::minmax(mesh.triangles[i][j], mesh.triangles[i][(j + 1) % 3]);
      const std::array<std::uint32_t, 2> key{a, b};
      edges.push_back({a, b, i, std::binary_search(listed.begin(), listed.end(), key)});
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::vector<std::uint32_t> facets_of_triangles(const Indexed_mesh_3& mesh, const Epick_domain& domain,
                                               const Expected& expected,
                                               const std::vector<Triangle_edge>& edges) {
  // Patches: a forest in which every root is the smallest index of its tree.
  std::vector<std::uint32_t> patch(mesh.triangles.size());
  std::iota(patch.begin(), patch.end(), 0u);
  const auto root = [&patch](std::uint32_t i) {
    while (patch[i] != i) i = patch[i] = patch[patch[i]];
    return i;
  };
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i].listed || !edges[i].same_edge(edges[i - 1])) continue;
    const auto [a, b] = std::minmax({root(edges[i].triangle), root(edges[i - 1].triangle)});
    patch[b] = a;
  }
  std::vector<std::uint32_t> largest(mesh.triangles.size(), none);
  std::vector<double> area(mesh.triangles.size());
  for (std::uint32_t i = 0; i < patch.size(); ++i) {
    area[i] = twice_area(mesh, mesh.triangles[i]);
    std::uint32_t& l = largest[root(i)];
    if (l == none || area[i] > area[l]) l = i;
  }

  std::vector<Facet_triangle> items;
  for (std::uint32_t f = 0; f < domain.facets.size(); ++f)
    for (std::size_t k = 0; k < domain.facets[f].triangles.size(); ++k) {
      if (!expected.facet_triangles[f][k]) continue;
      std::array<Plain::Point_3, 3> p;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto& q = domain.vertices[domain.facets[f].triangles[k][i]];
        p[i] = Plain::Point_3(q.x(), q.y(), q.z());
      }
      items.push_back({Plain::Triangle_3(p[0], p[1], p[2]), f});
    }
  const Tree tree(items.begin(), items.end());
  const double reach = 2 * domain.tolerance + rounding_distance(domain);
  std::vector<std::uint32_t> facet(mesh.triangles.size(), none);
  for (std::uint32_t i = 0; i < patch.size(); ++i)
    if (root(i) == i && !items.empty())
      facet[i] = nearest_facet(mesh, mesh.triangles[largest[i]], domain, tree, reach);
  for (std::uint32_t i = 0; i < patch.size(); ++i) facet[i] = facet[root(i)];
  return facet;
}

}  // namespace pgdr::quality_detail
