// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CGAL_MESH_COMPLEX_3_H
#define PGDR_CGAL_MESH_COMPLEX_3_H

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <pgdr/domain/scale.h>
#include <pgdr/mesh/copy_triangulation_3.h>
#include <pgdr/parallel/parallel_sort.h>
#include <pgdr/refinement/canonical_order.h>
#include <pgdr/refinement/refined_mesh_3.h>

namespace pgdr {

/// A `CGAL::Mesh_complex_3_in_triangulation_3`, whose vertices and cells model CGAL's `MeshVertexBase_3` and `MeshCellBase_3`.
///
/// Its triangulation has no weights and coordinates in floating point, its indices can be made of an `int`; others are refused when they are used, with a sentence.
template <class C3t3>
concept MeshComplex = requires(C3t3 c3t3) {
  typename C3t3::Triangulation;
  typename C3t3::Triangulation::Cell_handle;
  typename C3t3::Subdomain_index;
  typename C3t3::Surface_patch_index;
  typename C3t3::Curve_index;
  typename C3t3::Corner_index;
  typename C3t3::Index;
  c3t3.triangulation();
};

namespace internal {

template <class C3t3>
constexpr void require_delaunay_complex() {
  using Tr = typename C3t3::Triangulation;
  static_assert(std::is_same_v<typename Tr::Point, typename Tr::Geom_traits::Point_3>,
                "pgdr's meshes are Delaunay: take a complex over CGAL::Delaunay_triangulation_3, not over a weighted (regular) triangulation");
  static_assert(std::is_floating_point_v<typename Tr::Geom_traits::FT>, "pgdr needs a triangulation with coordinates in floating point");
  static_assert(std::constructible_from<typename C3t3::Subdomain_index, int> && std::constructible_from<typename C3t3::Surface_patch_index, int> &&
                    std::constructible_from<typename C3t3::Curve_index, int> && std::constructible_from<typename C3t3::Corner_index, int> &&
                    std::constructible_from<typename C3t3::Index, int>,
                "pgdr's regions and markers are numbers: take a complex whose indices can be made of an int");
}

/// References as CGAL's indices, of which 0 means "not in the complex": what has none gets the first number above all others.
class Index_of_reference {
 public:
  void add(int reference) { largest_ = std::max(largest_, reference); }
  /// `position`: for what is not to be one with all else that has no reference. Throws `std::length_error` where no number is left.
  int operator()(int reference, Index position = 0) const {
    if (reference != 0) return reference;
    const std::int64_t number = std::int64_t{largest_} + 1 + position;
    if (number > std::numeric_limits<int>::max()) throw std::length_error("markers are so large that no numbers are left for what has none");
    return static_cast<int>(number);
  }

 private:
  int largest_ = 0;
};

template <MeshComplex C3t3, class K>
class Mesh_complex_builder_3 {
  using Mesh = Refined_mesh_3<K>;
  using From = typename Mesh::Triangulation;
  using Complex = typename Mesh::Complex;
  using To = typename C3t3::Triangulation;
  using Cell = typename From::Cell_handle;

 public:
  explicit Mesh_complex_builder_3(const Mesh& mesh) : mesh_(mesh) {
    for (const auto& f : mesh.domain().facets) patch_.add(f.marker);
    for (const auto& s : mesh.domain().segments) curve_.add(s.marker);
    for (const int m : mesh.domain().vertex_markers) corner_.add(m);
    for (const Subdomain& s : mesh.subdomains()) subdomain_.add(s.id);
  }

  C3t3 run() {
    C3t3 c3t3;
    from_ = in_order();
    const double unit = unit_of(mesh_.domain());
    to_ = copy_triangulation_3(from_, c3t3.triangulation(), [unit](auto v) {
      const Vec_3 p = unit * position(v);
      return typename To::Point(p.x, p.y, p.z);
    });
    features_.resize(from_.vertices.size());
    for (std::size_t i = 0; i < from_.cells.size(); ++i)
      if (is_meshed(from_.cells[i].cell)) add(i, c3t3);
    for (std::size_t v = 0; v + 1 < from_.vertices.size(); ++v) set_index(v, c3t3);
    return c3t3;
  }

 private:
  /// What a vertex lies on, as far as the mesh has it.
  struct Features {
    int subdomain = 0, patch = 0, curve = 0;  ///< one of those at it
    int edges = 0;                            ///< of the complex
    bool same_curve = true;                   ///< of all of them, as the user named it
  };

  /// Vertices of the domain as they are numbered there, then the others along a curve.
  Ordered_triangulation_3<From> in_order() const {
    const From& tr = mesh_.triangulation();
    Ordered_triangulation_3<From> result;
    std::vector<typename From::Vertex_handle> vertices;
    std::vector<std::array<double, 3>> points;
    std::vector<std::uint32_t> corners(mesh_.domain().vertices.size(), Complex::none), order;
    for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v) {
      const auto i = static_cast<std::uint32_t>(vertices.size());
      const Vec_3 p = position(v);
      vertices.push_back(v);
      points.push_back({p.x, p.y, p.z});
      if (v->in_dimension() == 0)
        corners[v->index()] = i;
      else
        order.push_back(i);
    }
    sort_along_curve(order, points, mesh_.domain().lower, mesh_.domain().upper);
    std::erase(corners, Complex::none);
    order.insert(order.begin(), corners.begin(), corners.end());
    for (const std::uint32_t i : order) result.vertices.push_back(vertices[i]);
    result.vertices.push_back(tr.infinite_vertex());
    for (std::size_t i = 0; i < result.vertices.size(); ++i) result.vertices[i]->set_number(static_cast<std::uint32_t>(i));
    result.cells.reserve(tr.tds().number_of_cells());
    for (auto c = tr.all_cells_begin(); c != tr.all_cells_end(); ++c)
      result.cells.push_back({canonical(std::array{c->vertex(0)->number(), c->vertex(1)->number(), c->vertex(2)->number(), c->vertex(3)->number()}), c});
    parallel_sort(result.cells.begin(), result.cells.end());
    return result;
  }

  bool is_meshed(Cell c) const { return c->subdomain() != 0 && !mesh_.triangulation().is_infinite(c); }

  /// The cell at a position, and what of the complex is on it.
  void add(std::size_t i, C3t3& c3t3) {
    const Cell old = from_.cells[i].cell;
    const auto cell = to_.cells[i].cell;
    const int subdomain = subdomain_(mesh_.subdomains()[static_cast<std::size_t>(old->subdomain())].id);
    c3t3.add_to_complex(cell, typename C3t3::Subdomain_index(subdomain));
    for (int k = 0; k < 4; ++k) {
      const auto v = old->vertex(k);
      features_[v->number()].subdomain = subdomain;
      if (const std::uint32_t t = old->subfacet(k); t != Complex::none) add_facet(old, k, c3t3, cell->index(to_.vertices[v->number()]), cell);
      for (int j = 0; j < k; ++j)
        if (old->subsegment_edges() & edge_bit(j, k)) add_edge(old->vertex(j), v, c3t3);
    }
  }

  void add_facet(Cell old, int k, C3t3& c3t3, int position, typename To::Cell_handle cell) {
    const int patch = patch_(mesh_.domain().facets[mesh_.complex().subfacet(old->subfacet(k)).facet].marker);
    c3t3.add_to_complex(cell, position, typename C3t3::Surface_patch_index(patch));
    for (int j = 0; j < 4; ++j)
      if (j != k) features_[old->vertex(j)->number()].patch = patch;
  }

  void add_edge(typename From::Vertex_handle a, typename From::Vertex_handle b, C3t3& c3t3) {
    const std::uint32_t s = mesh_.complex().find_subsegment(a, b);
    const auto p = to_.vertices[a->number()], q = to_.vertices[b->number()];
    if (s == Complex::none || c3t3.is_in_complex(p, q)) return;
    const Index segment = mesh_.complex().subsegment(s).segment;
    const int marker = mesh_.domain().segments[segment].marker, curve = curve_(marker, segment);
    c3t3.add_to_complex(p, q, typename C3t3::Curve_index(curve));
    for (const auto v : {a, b}) {
      Features& f = features_[v->number()];
      f.same_curve = f.same_curve && marker != 0 && (f.edges == 0 || f.curve == curve);
      f.curve = curve;
      ++f.edges;
    }
  }

  /// A vertex of the domain is a corner where segments end, but not where one curve of the user's goes on.
  void set_index(std::size_t v, C3t3& c3t3) {
    const auto old = from_.vertices[v];
    const auto vertex = to_.vertices[v];
    const Features& f = features_[v];
    const auto set = [&](int dimension, auto index) {
      c3t3.set_dimension(vertex, dimension);
      c3t3.set_index(vertex, typename C3t3::Index(index));
    };
    if (f.subdomain == 0) {
      // CGAL has -1 for such vertices, but its remeshing asserts that there are none.
      set(3, typename C3t3::Subdomain_index(0));
    } else if (old->in_dimension() == 0 && f.edges > 0 && !(f.edges == 2 && f.same_curve)) {
      const typename C3t3::Corner_index corner(corner_(mesh_.domain().vertex_markers[old->index()], old->index()));
      c3t3.add_to_complex(vertex, corner);
      set(0, corner);
    } else if (f.edges > 0) {
      set(1, typename C3t3::Curve_index(f.curve));
    } else if (f.patch != 0) {
      set(2, typename C3t3::Surface_patch_index(f.patch));
    } else {
      set(3, typename C3t3::Subdomain_index(f.subdomain));
    }
  }

  const Mesh& mesh_;
  Index_of_reference subdomain_, patch_, curve_, corner_;
  Ordered_triangulation_3<From> from_;
  Ordered_triangulation_3<To> to_;
  std::vector<Features> features_;  ///< by vertex
};

}  // namespace internal

/// A refined mesh as CGAL's complex, in the user's unit: the whole Delaunay triangulation, in which the meshed cells, the subfacets and subsegments on them and the corners
/// are in the complex. What lies outside has subdomain 0, and its vertices (those of the box around the domain among them) are inside of that.
///
/// Indices: of a cell the id of its region, of a facet and an edge the marker of the input facet and segment; as CGAL's 0 means "not in the complex", facets without a
/// marker get the first number above all markers, edges without one a number for each segment of the domain. A vertex of the domain is a corner if edges of the
/// complex end there, but for two with the same marker.
/// The order of vertices and cells depends on nothing but the mesh. Cells are default-constructed but for that: an `info()` of the user's is as its constructor leaves it.
/// \tparam C3t3 `CGAL::Mesh_complex_3_in_triangulation_3<Tr>` over a `CGAL::Delaunay_triangulation_3` whose vertices and cells have the indices of a mesh, for instance a
///   `Complex_triangulation_3`.
/// Takes 24 bytes a tetrahedron besides the result, and those of a hash table.
template <MeshComplex C3t3, class K>
C3t3 mesh_complex_3(const Refined_mesh_3<K>& mesh) {
  internal::require_delaunay_complex<C3t3>();
  return internal::Mesh_complex_builder_3<C3t3, K>(mesh).run();
}

}  // namespace pgdr

#endif
