// SPDX-License-Identifier: GPL-3.0-or-later
// A valid mesh with two regions, and its input, made without the library's mesher.
#ifndef PGDR_TEST_QUALITY_LATTICE_MESH_H
#define PGDR_TEST_QUALITY_LATTICE_MESH_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr_test {

/// The unit cube in two halves (regions 10 and 20) on both sides of a facet x = 1/2 with marker 7; the sides
/// of the cube have markers 1 to 6 (x, y, z; lower side first), two edges of the cube are segments with
/// markers 3 and 4.
inline pgdr::Plc two_boxes() {
  using Point = pgdr::Epick::Point_3;
  pgdr::Plc plc;
  for (const double x : {0.0, 0.5, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double z : {0.0, 1.0}) plc.vertices.emplace_back(x, y, z);
  for (int v = 0; v < 12; ++v) plc.vertex_markers.push_back(100 + v);
  const auto add = [&plc](std::vector<pgdr::Index> polygon, int marker) {
    pgdr::Plc_facet<pgdr::Epick> facet;
    facet.polygons = {std::move(polygon)};
    facet.marker = marker;
    plc.facets.push_back(std::move(facet));
  };
  add({0, 1, 3, 2}, 1);
  add({8, 9, 11, 10}, 2);
  add({4, 5, 7, 6}, 7);
  for (const pgdr::Index o : {0u, 4u}) {
    add({o, o + 1, o + 5, o + 4}, 3);
    add({o + 2, o + 3, o + 7, o + 6}, 4);
    add({o, o + 2, o + 6, o + 4}, 5);
    add({o + 1, o + 3, o + 7, o + 5}, 6);
  }
  plc.segments = {{0, 1, 3}, {8, 9, 4}};
  plc.regions = {{Point(0.25, 0.5, 0.5), 10, 0}, {Point(0.75, 0.5, 0.5), 20, 0}};
  return plc;
}

/// The corners of n^3 cubes that make up the unit cube, n even, and the facets of `two_boxes` that they lie
/// in.
class Lattice {
 public:
  explicit Lattice(int n) : n_(n) {
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        for (int k = 0; k <= n; ++k) positions_.push_back({i, j, k});
  }
  std::size_t size() const { return positions_.size(); }
  std::array<int, 3> operator[](std::size_t v) const { return positions_[v]; }
  std::uint32_t at(int i, int j, int k) const { return std::uint32_t((i * (n_ + 1) + j) * (n_ + 1) + k); }

  /// The facets that `v` lies in: bits 0 to 6 for the markers 1 to 7.
  unsigned facets(std::uint32_t v) const {
    unsigned bits = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (positions_[v][axis] == 0) bits |= 1u << (2 * axis);
      if (positions_[v][axis] == n_) bits |= 2u << (2 * axis);
    }
    return 2 * positions_[v][0] == n_ ? bits | 64u : bits;
  }
  /// The facets that all of `vertices` lie in.
  template <class Vertices>
  unsigned common_facets(const Vertices& vertices) const {
    unsigned bits = 127;
    for (const auto v : vertices) bits &= facets(v);
    return bits;
  }
  static int marker(unsigned bits) {
    for (int m = 1; m <= 7; ++m)
      if (bits & (1u << (m - 1))) return m;
    return 0;
  }
  static int count(unsigned bits) {
    int n = 0;
    for (; bits != 0; bits &= bits - 1) ++n;
    return n;
  }

 private:
  int n_;
  std::vector<std::array<int, 3>> positions_;
};

/// A Delaunay mesh of `two_boxes` with the vertices of `Lattice(n)`. Inner ones are shaken by up to `shake`
/// times the spacing h; 0.1 is too little to enter the equatorial balls (radius 0.71 h) on the facets.
/// Vertices inside facets are shifted perpendicular to them by up to `bump`.
inline pgdr::Indexed_mesh_3 lattice_mesh(int n, double shake = 0.1, double bump = 0) {
  using K = pgdr::Epick;
  using Vertex_base = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, K>;
  using Cell_base =
      CGAL::Triangulation_cell_base_with_info_3<int, K, CGAL::Delaunay_triangulation_cell_base_3<K>>;
  using Triangulation =
      CGAL::Delaunay_triangulation_3<K, CGAL::Triangulation_data_structure_3<Vertex_base, Cell_base>>;

  const Lattice lattice(n);
  pgdr::Indexed_mesh_3 mesh;
  std::mt19937_64 random(7);
  const auto uniform = [&random] { return 2 * std::ldexp(double(random() >> 11), -53) - 1; };
  std::vector<std::pair<K::Point_3, std::uint32_t>> points;
  for (std::uint32_t v = 0; v < lattice.size(); ++v) {
    const auto [i, j, k] = lattice[v];
    std::array<double, 3> p{double(i) / n, double(j) / n, double(k) / n};
    const unsigned facets = lattice.facets(v);
    if (facets == 0)
      for (double& x : p) x += shake / n * uniform();
    if (Lattice::count(facets) == 1 && bump > 0)
      p[std::size_t((Lattice::marker(facets) - 1) % 6 / 2)] += bump * uniform();
    mesh.points.push_back(p);
    mesh.point_references.push_back(Lattice::count(facets) == 3 ? 100 + 4 * (2 * i / n) + 2 * (j / n) + k / n
                                                                : 0);
    points.emplace_back(K::Point_3(p[0], p[1], p[2]), v);
  }
  Triangulation dt(points.begin(), points.end());

  // Regions; 0 for flat tetrahedra in a side of the cube. Those in the middle go to the upper half.
  for (auto c = dt.all_cells_begin(); c != dt.all_cells_end(); ++c) {
    c->info() = 0;
    if (dt.is_infinite(c)) continue;
    std::array<std::uint32_t, 4> t;
    for (std::size_t i = 0; i < 4; ++i) t[i] = c->vertex(int(i))->info();
    if ((lattice.common_facets(t) & 63u) != 0) continue;
    c->info() = std::any_of(t.begin(), t.end(), [&](auto v) { return 2 * lattice[v][0] < n; }) ? 10 : 20;
    mesh.tetrahedra.push_back(t);
    mesh.tetrahedron_references.push_back(c->info());
  }
  for (auto f = dt.finite_facets_begin(); f != dt.finite_facets_end(); ++f) {
    if (f->first->info() == f->first->neighbor(f->second)->info()) continue;
    std::array<std::uint32_t, 3> t;
    for (int i = 0; i < 3; ++i) t[std::size_t(i)] = f->first->vertex((f->second + 1 + i) % 4)->info();
    mesh.triangles.push_back(t);
    mesh.triangle_references.push_back(Lattice::marker(lattice.common_facets(t)));
  }
  for (auto e = dt.finite_edges_begin(); e != dt.finite_edges_end(); ++e) {
    const std::array<std::uint32_t, 2> v{e->first->vertex(e->second)->info(),
                                         e->first->vertex(e->third)->info()};
    const unsigned facets = lattice.common_facets(v);
    if (Lattice::count(facets) < 2) continue;
    mesh.edges.push_back(v);
    mesh.edge_references.push_back(facets == 5u ? 3 : facets == 6u ? 4 : 0);  // x = 0 or 1, and y = 0
  }
  return mesh;
}

}  // namespace pgdr_test

#endif
