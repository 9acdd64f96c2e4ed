// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_INDEXED_MESH_OF_3_H
#define PGDR_REFINEMENT_INDEXED_MESH_OF_3_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <pgdr/mesh/indexed_mesh_3.h>
#include <pgdr/refinement/refined_mesh_3.h>
#include <pgdr/refinement/tetrahedron_ball.h>

namespace pgdr {

namespace internal {

/// Interleaves 21 bits each of three coordinates scaled to [0, 1].
inline std::uint64_t morton_code(const Vec_3& unit) {
  const auto spread = [](double t) {
    auto x = static_cast<std::uint64_t>(std::clamp(t, 0.0, 1.0) * 2097151.0);
    x = (x | x << 32) & 0x1f00000000ffffull;
    x = (x | x << 16) & 0x1f0000ff0000ffull;
    x = (x | x << 8) & 0x100f00f00f00f00full;
    x = (x | x << 4) & 0x10c30c30c30c30c3ull;
    return (x | x << 2) & 0x1249249249249249ull;
  };
  return spread(unit.x) | spread(unit.y) << 1 | spread(unit.z) << 2;
}

/// The even permutation of a tetrahedron's vertices that starts with the smallest two it can.
inline std::array<std::uint32_t, 4> canonical(std::array<std::uint32_t, 4> t) {
  bool odd = false;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 3; j > i; --j)
      if (t[j] < t[j - 1]) {
        std::swap(t[j], t[j - 1]);
        odd = !odd;
      }
  if (odd) std::swap(t[2], t[3]);
  return t;
}

/// The rotation of a triangle that starts with its smallest vertex.
inline std::array<std::uint32_t, 3> canonical(std::array<std::uint32_t, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// Numbers the vertices of meshed cells: domain vertices in their order, then the others along a Morton curve.
/// The order is a function of the coordinates alone.
template <class K>
std::vector<typename Mesh_triangulation_3<K>::Vertex_handle> numbered_vertices(const Refined_mesh_3<K>& mesh) {
  using Tr = Mesh_triangulation_3<K>;
  using Vertex_handle = typename Tr::Vertex_handle;
  constexpr std::uint32_t unused = Tr::Vertex::none, used = unused - 1;
  const Tr& tr = mesh.triangulation();
  for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v) Vertex_handle(v)->set_number(unused);
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c)
    if (c->subdomain() != 0)
      for (int i = 0; i < 4; ++i) c->vertex(i)->set_number(used);

  struct Key {
    std::uint64_t code;
    std::array<double, 3> point;
    Vertex_handle vertex;
    bool operator<(const Key& o) const { return std::tie(code, point) < std::tie(o.code, o.point); }
  };
  const Domain_3<K>& domain = mesh.domain();
  std::vector<Vertex_handle> order(domain.vertices.size());
  std::vector<Key> keys;
  for (auto it = tr.finite_vertices_begin(); it != tr.finite_vertices_end(); ++it) {
    const Vertex_handle v = it;
    if (v->number() != used) continue;
    if (v->in_dimension() == 0) {
      order[v->index()] = v;
      continue;
    }
    const Vec_3 p = position(v);
    Vec_3 unit;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double size = domain.upper[k] - domain.lower[k];
      unit[i] = size > 0 ? (p[i] - domain.lower[k]) / size : 0;
    }
    keys.push_back({morton_code(unit), {p.x, p.y, p.z}, v});
  }
  std::erase(order, Vertex_handle());
  std::sort(keys.begin(), keys.end());
  order.reserve(order.size() + keys.size());
  for (const Key& k : keys) order.push_back(k.vertex);
  for (std::size_t i = 0; i < order.size(); ++i) order[i]->set_number(static_cast<std::uint32_t>(i));
  return order;
}

}  // namespace internal

/// The meshed cells as plain arrays in canonical order: the same for the same mesh, however it was made.
///
/// Subfacets are oriented outwards from the meshed side, between two subdomains from the one with the smaller id.
template <class K>
Indexed_mesh_3 indexed_mesh_3(const Refined_mesh_3<K>& mesh) {
  using Tr = Mesh_triangulation_3<K>;
  using Complex = Constraint_complex_3<Tr>;
  const Tr& tr = mesh.triangulation();
  const Complex& complex = mesh.complex();
  const auto& domain = mesh.domain();
  Indexed_mesh_3 out;

  const auto vertices = internal::numbered_vertices(mesh);
  out.points.reserve(vertices.size());
  out.point_references.reserve(vertices.size());
  out.point_dimensions.reserve(vertices.size());
  for (const auto v : vertices) {
    const Vec_3 p = position(v);
    out.points.push_back({p.x, p.y, p.z});
    out.point_references.push_back(v->in_dimension() == 0 ? domain.vertex_markers[v->index()] : 0);
    out.point_dimensions.push_back(static_cast<std::uint8_t>(v->in_dimension()));
  }

  struct Tetrahedron {
    std::array<std::uint32_t, 4> vertices;
    std::int32_t reference;
    bool exempt;
  };
  struct Triangle {
    std::array<std::uint32_t, 3> vertices;
    std::int32_t reference;
  };
  const double bound = mesh.radius_edge_ratio() * mesh.radius_edge_ratio();
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Triangle> triangles;
  std::size_t count = 0;
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) count += c->subdomain() != 0;
  tetrahedra.reserve(count);
  for (auto it = tr.finite_cells_begin(); it != tr.finite_cells_end(); ++it) {
    const typename Tr::Cell_handle c = it;
    if (c->subdomain() == 0) continue;
    const auto b = tetrahedron_ball(
        {position(c->vertex(0)), position(c->vertex(1)), position(c->vertex(2)), position(c->vertex(3))});
    tetrahedra.push_back({internal::canonical(std::array<std::uint32_t, 4>{
                              c->vertex(0)->number(), c->vertex(1)->number(), c->vertex(2)->number(),
                              c->vertex(3)->number()}),
                          mesh.subdomains()[static_cast<std::size_t>(c->subdomain())].id,
                          b.squared_radius > bound * b.squared_shortest});
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t t = c->subfacet(i);
      if (t == Complex::none) continue;
      const auto n = c->neighbor(i);
      const int here = mesh.subdomains()[static_cast<std::size_t>(c->subdomain())].id;
      const int there = mesh.subdomains()[static_cast<std::size_t>(n->subdomain())].id;
      // Written once: by the meshed side, by the smaller id, or by the side that its stored orientation faces.
      const auto& s = complex.subfacet(t);
      std::array<std::uint32_t, 3> v{c->vertex(tr.vertex_triple_index(i, 0))->number(),
                                     c->vertex(tr.vertex_triple_index(i, 1))->number(),
                                     c->vertex(tr.vertex_triple_index(i, 2))->number()};
      v = internal::canonical(v);
      if (n->subdomain() != 0) {
        const bool same_side = internal::canonical(std::array<std::uint32_t, 3>{
                                   s.vertices[0]->number(), s.vertices[1]->number(), s.vertices[2]->number()}) == v;
        if (here != there ? here > there : !same_side) continue;
      }
      triangles.push_back({v, domain.facets[s.facet].marker});
    }
  }
  std::sort(tetrahedra.begin(), tetrahedra.end(),
            [](const Tetrahedron& a, const Tetrahedron& b) { return a.vertices < b.vertices; });
  std::sort(triangles.begin(), triangles.end(),
            [](const Triangle& a, const Triangle& b) { return a.vertices < b.vertices; });
  out.tetrahedra.reserve(tetrahedra.size());
  out.tetrahedron_references.reserve(tetrahedra.size());
  for (const Tetrahedron& t : tetrahedra) {
    if (t.exempt) out.exempt.push_back(static_cast<std::uint32_t>(out.tetrahedra.size()));
    out.tetrahedra.push_back(t.vertices);
    out.tetrahedron_references.push_back(t.reference);
  }
  for (const Triangle& t : triangles) {
    out.triangles.push_back(t.vertices);
    out.triangle_references.push_back(t.reference);
  }

  std::vector<std::pair<std::array<std::uint32_t, 2>, std::int32_t>> edges;
  for (std::uint32_t i = 0; i < complex.subsegment_slots(); ++i) {
    const auto& s = complex.subsegment(i);
    const std::uint32_t a = s.vertices[0]->number(), b = s.vertices[1]->number();
    if (!s.alive || !s.present || a == Tr::Vertex::none || b == Tr::Vertex::none) continue;
    edges.push_back({{std::min(a, b), std::max(a, b)}, domain.segments[s.segment].marker});
  }
  std::sort(edges.begin(), edges.end());
  for (const auto& [e, reference] : edges) {
    out.edges.push_back(e);
    out.edge_references.push_back(reference);
  }
  return out;
}

/// The same, and frees the triangulation before it returns: a large mesh need not be held twice while it is written.
template <class K>
Indexed_mesh_3 indexed_mesh_3(Refined_mesh_3<K>&& mesh) {
  const Refined_mesh_3<K> last = std::move(mesh);
  return indexed_mesh_3(last);
}

}  // namespace pgdr

#endif
