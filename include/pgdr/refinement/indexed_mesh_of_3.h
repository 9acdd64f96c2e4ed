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

namespace internal {

/// Gathers a refined mesh into plain arrays. Two steps, so that the triangulation can go in between: a large mesh
/// need not be held twice.
template <class K>
class Indexed_mesh_builder_3 {
  using Mesh = Refined_mesh_3<K>;
  using Tr = typename Mesh::Triangulation;
  using Complex = typename Mesh::Complex;
  using Cell_handle = typename Tr::Cell_handle;

 public:
  /// All that needs the triangulation.
  void gather(const Mesh& mesh) {
    gather_points(mesh);
    const Tr& tr = mesh.triangulation();
    std::size_t count = 0;
    for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) count += c->subdomain() != 0;
    tetrahedra_.reserve(count);
    for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c)
      if (c->subdomain() != 0) gather_cell(mesh, c);
    gather_edges(mesh);
  }

  /// Sorts what was gathered into canonical order.
  Indexed_mesh_3 finish() {
    const auto by_vertices = [](const auto& a, const auto& b) { return a.vertices < b.vertices; };
    std::sort(tetrahedra_.begin(), tetrahedra_.end(), by_vertices);
    std::sort(triangles_.begin(), triangles_.end(), by_vertices);
    std::sort(edges_.begin(), edges_.end(), by_vertices);
    for (const Element<4>& t : exempt_)
      out_.exempt.push_back(static_cast<std::uint32_t>(
          std::lower_bound(tetrahedra_.begin(), tetrahedra_.end(), t, by_vertices) - tetrahedra_.begin()));
    std::sort(out_.exempt.begin(), out_.exempt.end());
    split(tetrahedra_, out_.tetrahedra, out_.tetrahedron_references);
    split(triangles_, out_.triangles, out_.triangle_references);
    split(edges_, out_.edges, out_.edge_references);
    return std::move(out_);
  }

 private:
  template <std::size_t N>
  struct Element {
    std::array<std::uint32_t, N> vertices;
    std::int32_t reference;
  };

  template <class From, std::size_t N>
  static void split(std::vector<From>& from, std::vector<std::array<std::uint32_t, N>>& vertices,
                    std::vector<std::int32_t>& references) {
    vertices.reserve(from.size());
    references.reserve(from.size());
    for (const auto& e : from) {
      vertices.push_back(e.vertices);
      references.push_back(e.reference);
    }
    from = {};
  }

  void gather_points(const Mesh& mesh) {
    const auto vertices = numbered_vertices(mesh);
    out_.points.reserve(vertices.size());
    out_.point_references.reserve(vertices.size());
    out_.point_dimensions.reserve(vertices.size());
    for (const auto v : vertices) {
      const Vec_3 p = position(v);
      out_.points.push_back({p.x, p.y, p.z});
      out_.point_references.push_back(v->in_dimension() == 0 ? mesh.domain().vertex_markers[v->index()] : 0);
      out_.point_dimensions.push_back(static_cast<std::uint8_t>(v->in_dimension()));
    }
  }

  void gather_cell(const Mesh& mesh, Cell_handle c) {
    const double bound = mesh.radius_edge_ratio() * mesh.radius_edge_ratio();
    const auto b = tetrahedron_ball(
        {position(c->vertex(0)), position(c->vertex(1)), position(c->vertex(2)), position(c->vertex(3))});
    tetrahedra_.push_back({canonical(std::array<std::uint32_t, 4>{c->vertex(0)->number(), c->vertex(1)->number(),
                                                                  c->vertex(2)->number(), c->vertex(3)->number()}),
                           id_of(mesh, c)});
    if (b.squared_radius > bound * b.squared_shortest) exempt_.push_back(tetrahedra_.back());
    if (!c->has_subfacet()) return;
    for (int i = 0; i < 4; ++i)
      if (c->subfacet(i) != Complex::none) gather_subfacet(mesh, c, i);
  }

  static int id_of(const Mesh& mesh, Cell_handle c) {
    return mesh.subdomains()[static_cast<std::size_t>(c->subdomain())].id;
  }

  /// Each subfacet is seen from both sides and written once: by the meshed side, between two subdomains by that with
  /// the smaller id, inside one by the side behind the facet, counterclockwise about its normal.
  void gather_subfacet(const Mesh& mesh, Cell_handle c, int i) {
    const auto& t = mesh.complex().subfacet(c->subfacet(i));
    std::array<std::uint32_t, 3> seen, stored;
    for (int k = 0; k < 3; ++k) {
      // CGAL's triple is counterclockwise from inside the cell.
      seen[static_cast<std::size_t>(k)] = c->vertex(Tr::vertex_triple_index(i, 2 - k))->number();
      stored[static_cast<std::size_t>(k)] = t.vertices[static_cast<std::size_t>(k)]->number();
    }
    seen = canonical(seen);
    const Cell_handle n = c->neighbor(i);
    if (n->subdomain() != 0) {
      const int here = id_of(mesh, c), there = id_of(mesh, n);
      if (here != there ? here > there : canonical(stored) != seen) return;
    }
    triangles_.push_back({seen, mesh.domain().facets[t.facet].marker});
  }

  void gather_edges(const Mesh& mesh) {
    for (std::uint32_t i = 0; i < mesh.complex().subsegment_slots(); ++i) {
      const auto& s = mesh.complex().subsegment(i);
      if (!s.alive() || !s.present) continue;
      const std::uint32_t a = s.vertices[0]->number(), b = s.vertices[1]->number();
      if (a == Tr::Vertex::none || b == Tr::Vertex::none) continue;
      edges_.push_back({{std::min(a, b), std::max(a, b)}, mesh.domain().segments[s.segment].marker});
    }
  }

  Indexed_mesh_3 out_;
  std::vector<Element<4>> tetrahedra_;
  std::vector<Element<4>> exempt_;
  std::vector<Element<3>> triangles_;
  std::vector<Element<2>> edges_;
};

}  // namespace internal

/// The meshed cells as plain arrays in canonical order: the same for the same mesh, however it was made.
///
/// Subfacets are oriented outwards from the meshed side, between two subdomains from the one with the smaller id.
template <class K>
Indexed_mesh_3 indexed_mesh_3(const Refined_mesh_3<K>& mesh) {
  internal::Indexed_mesh_builder_3<K> builder;
  builder.gather(mesh);
  return builder.finish();
}

/// The same, but frees the triangulation as soon as it can.
template <class K>
Indexed_mesh_3 indexed_mesh_3(Refined_mesh_3<K>&& mesh) {
  internal::Indexed_mesh_builder_3<K> builder;
  {
    const Refined_mesh_3<K> last = std::move(mesh);
    builder.gather(last);
  }
  return builder.finish();
}

}  // namespace pgdr

#endif
