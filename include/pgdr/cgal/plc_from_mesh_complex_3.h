// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CGAL_PLC_FROM_MESH_COMPLEX_3_H
#define PGDR_CGAL_PLC_FROM_MESH_COMPLEX_3_H

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <CGAL/Unique_hash_map.h>

#include <pgdr/cgal/mesh_complex_3.h>
#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>

namespace pgdr {

namespace internal {

template <MeshComplex C3t3>
class Plc_of_mesh_complex_3 {
  using Tr = typename C3t3::Triangulation;
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;

 public:
  explicit Plc_of_mesh_complex_3(const C3t3& c3t3) : c3t3_(c3t3), tr_(c3t3.triangulation()) {}

  Plc run() {
    check();
    // What is void but has no cells, in a complex that was read from a file, say, is told from the rest by its depth.
    plc_.nesting = Nesting::alternate;
    add_seeds();
    add_vertices();
    for (auto f = c3t3_.facets_in_complex_begin(); f != c3t3_.facets_in_complex_end(); ++f) {
      std::vector<Index> triangle;
      for (int k = 0; k < 3; ++k) triangle.push_back(number_[f->first->vertex(Tr::vertex_triple_index(f->second, k))]);
      plc_.facets.push_back({{std::move(triangle)}, {}, static_cast<int>(c3t3_.surface_patch_index(*f))});
    }
    for (auto e = c3t3_.edges_in_complex_begin(); e != c3t3_.edges_in_complex_end(); ++e)
      plc_.segments.push_back({number_[e->first->vertex(e->second)], number_[e->first->vertex(e->third)], static_cast<int>(c3t3_.curve_index(*e))});
    return std::move(plc_);
  }

 private:
  /// Every facet between two tetrahedra is locally Delaunay, so that all of them are.
  void check() const {
    const auto side = tr_.geom_traits().side_of_bounded_sphere_3_object();
    for (auto f = tr_.finite_facets_begin(); f != tr_.finite_facets_end(); ++f) {
      const Cell_handle c = f->first, d = c->neighbor(f->second);
      if (tr_.is_infinite(c) || tr_.is_infinite(d)) continue;
      const auto point = [](Cell_handle t, int i) -> const auto& { return t->vertex(i)->point(); };
      if (side(point(c, 0), point(c, 1), point(c, 2), point(c, 3), point(d, d->index(c))) == CGAL::ON_BOUNDED_SIDE)
        throw std::invalid_argument("the mesh is not Delaunay, which is what can be refined further: mesh its boundary instead");
    }
  }

  static Vec_3 center(Cell_handle c) {
    const Tetrahedron_points p = tetrahedron_points(c);
    return 0.25 * ((p[0] + p[1]) + (p[2] + p[3]));
  }

  static double sixfold_volume(Cell_handle c) {
    const Tetrahedron_points p = tetrahedron_points(c);
    return std::abs(dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0])));
  }

  /// A seed in the largest tetrahedron of each part, of a region or of a hole.
  void add_seeds() {
    CGAL::Unique_hash_map<Cell_handle, bool> is_reached(false, tr_.number_of_cells());
    std::vector<Cell_handle> part;
    for (auto start = tr_.all_cells_begin(); start != tr_.all_cells_end(); ++start) {
      if (is_reached[start]) continue;
      is_reached[start] = true;
      part.assign(1, start);
      bool is_outside = false;
      Cell_handle largest = start;
      double volume = -1;
      for (std::size_t next = 0; next < part.size(); ++next) {
        const Cell_handle c = part[next];
        if (tr_.is_infinite(c)) {
          is_outside = true;
        } else if (const double v = sixfold_volume(c); v > volume) {
          volume = v;
          largest = c;
        }
        for (int i = 0; i < 4; ++i) {
          const Cell_handle n = c->neighbor(i);
          if (c3t3_.is_in_complex(c, i)) continue;
          if (!(c3t3_.subdomain_index(n) == c3t3_.subdomain_index(c)))
            throw std::invalid_argument("two subdomains of the complex meet where none of its facets is");
          if (is_reached[n]) continue;
          is_reached[n] = true;
          part.push_back(n);
        }
      }
      if (is_outside) continue;
      const Vec_3 p = center(largest);
      if (c3t3_.is_in_complex(largest))
        plc_.regions.push_back({{p.x, p.y, p.z}, static_cast<int>(c3t3_.subdomain_index(largest)), 0, 0});
      else
        plc_.holes.emplace_back(p.x, p.y, p.z);
    }
  }

  /// Those of the complex.
  void add_vertices() {
    CGAL::Unique_hash_map<Vertex_handle, bool> is_used(false, tr_.number_of_vertices());
    for (auto c = tr_.finite_cells_begin(); c != tr_.finite_cells_end(); ++c)
      if (c3t3_.is_in_complex(c))
        for (int i = 0; i < 4; ++i) is_used[c->vertex(i)] = true;
    for (auto f = c3t3_.facets_in_complex_begin(); f != c3t3_.facets_in_complex_end(); ++f)
      for (int i = 0; i < 4; ++i)
        if (i != f->second) is_used[f->first->vertex(i)] = true;
    for (auto v = tr_.finite_vertices_begin(); v != tr_.finite_vertices_end(); ++v) {
      if (!is_used[v]) continue;
      number_[v] = static_cast<Index>(plc_.vertices.size());
      plc_.vertices.emplace_back(v->point().x(), v->point().y(), v->point().z());
    }
  }

  const C3t3& c3t3_;
  const Tr& tr_;
  Plc plc_;
  CGAL::Unique_hash_map<Vertex_handle, Index> number_;
};

}  // namespace internal

/// The PLC of a mesh that is to be refined further: the facets, edges and corners of the complex, all vertices of its cells, those inside too, and a seed for each part.
/// Meshed again, it has every vertex that it had, and the same parts with the same indices.
///
/// Facets of the complex that lie in one plane and have the same patch index are fused when the PLC is understood, so that nothing but the plane is kept of them; their
/// vertices stay.
/// All vertices count as given then, to be refined around at will. Where no angle of the input is small, a mesh within all bounds is left as it is; next to
/// small ones it gets more tetrahedra, up to twice as many in all.
/// Throws `std::invalid_argument` where a tetrahedron's circumball holds the vertex of a neighbor (exact), as after CGAL's remeshing, and where two subdomains meet without
/// a facet of the complex between them.
template <MeshComplex C3t3>
Plc plc_from_mesh_complex_3(const C3t3& c3t3) {
  internal::require_delaunay_complex<C3t3>();
  return internal::Plc_of_mesh_complex_3<C3t3>(c3t3).run();
}

}  // namespace pgdr

#endif
