// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_MESH_TRIANGULATION_3_H
#define PGDR_MESH_MESH_TRIANGULATION_3_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/tags.h>

#include <pgdr/domain/vec_3.h>
#include <pgdr/mesh/in_ball_filter.h>
#include <pgdr/mesh/mesh_cell_base_3.h>
#include <pgdr/mesh/mesh_vertex_base_3.h>
#include <pgdr/mesh/territory_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>

namespace pgdr {

/// The Delaunay triangulation that is refined: CGAL's, with the mesh's vertices and cells.
///
/// `Concurrency_tag` chooses CGAL's containers; the refinement itself never asks which. The default lets several
/// threads insert at once, each where no other is at work; without oneTBB it is CGAL's sequential tag.
template <class Gt, class Concurrency_tag = CGAL::Parallel_if_available_tag>
class Mesh_triangulation_3
    : public CGAL::Delaunay_triangulation_3<
          Gt, CGAL::Triangulation_data_structure_3<Mesh_vertex_base_3<Gt>, Mesh_cell_base_3<Gt>, Concurrency_tag>> {
  using Base = CGAL::Delaunay_triangulation_3<
      Gt, CGAL::Triangulation_data_structure_3<Mesh_vertex_base_3<Gt>, Mesh_cell_base_3<Gt>, Concurrency_tag>>;

 public:
  using typename Base::Cell_handle;
  using typename Base::Facet;
  using typename Base::Point;
  using typename Base::Vertex_handle;

  /// Whom to tell of a vertex: its position, and the dimension of what it lies on.
  using Listener = std::function<void(const Vec_3&, int)>;

  using Base::Base;

  /// Who is told of new vertices from now on; null for nobody. Called by all threads that insert.
  void set_listener(const Listener* listener) { listener_ = listener; }
  void tell(Vertex_handle v) const {
    if (listener_) (*listener_)(to_vec(v->point()), v->in_dimension());
  }

  /// The first of so many numbers in a row that no vertex has, for `Territory_3`. \pre no other thread works
  std::uint32_t reserve_territories(std::size_t count) {
    this->infinite_vertex()->set_territory(Territory_id::everybody);
    return std::exchange(next_territory_, next_territory_ + static_cast<std::uint32_t>(count));
  }

  /// Whether the open circumball of c holds p, ties broken by CGAL's symbolic perturbation. Exact.
  ///
  /// The same answer as `side_of_sphere(c, p, true) == ON_BOUNDED_SIDE`, with the finite case first.
  bool in_conflict(Cell_handle c, const Point& p) const {
    if (c->ball().is_known()) {
      const int side = c->ball().side(to_vec(p));
      if (side != 0) return side > 0;
    }
    const Vertex_handle inf = this->infinite_vertex();
    const Vertex_handle v0 = c->vertex(0), v1 = c->vertex(1), v2 = c->vertex(2), v3 = c->vertex(3);
    if (v0 != inf && v1 != inf && v2 != inf && v3 != inf)
      return in_ball(v0->point(), v1->point(), v2->point(), v3->point(), p);
    return this->side_of_sphere(c, p, true) == CGAL::ON_BOUNDED_SIDE;
  }

  /// Whether the open circumball of a positive tetrahedron holds p, ties broken the same way. Exact.
  bool in_ball(const Point& p0, const Point& p1, const Point& p2, const Point& p3, const Point& p) const {
    if (const int side = side_of_ball(to_vec(p0), to_vec(p1), to_vec(p2), to_vec(p3), to_vec(p)); side != 0) return side > 0;
    return this->side_of_oriented_sphere(p0, p1, p2, p3, p, true) == CGAL::ON_POSITIVE_SIDE;
  }

  /// Makes the infinite vertex's cell valid again. `Cavity_3` leaves it alone, since it is the one location that
  /// tasks far from each other would both write. `on_hull` is any vertex on the convex hull.
  void restore_infinite_cell(Vertex_handle on_hull) {
    std::vector<Cell_handle> around;
    this->tds().incident_cells(on_hull, std::back_inserter(around));
    for (const Cell_handle c : around)
      if (this->is_infinite(c)) {
        this->infinite_vertex()->set_cell(c);
        return;
      }
  }

 private:
  const Listener* listener_ = nullptr;
  std::uint32_t next_territory_ = 1;
};

/// Coordinates of a vertex, rounded to double.
template <class Vertex_handle>
Vec_3 position(Vertex_handle v) {
  return to_vec(v->point());
}

template <class Cell_handle>
Tetrahedron_points tetrahedron_points(Cell_handle c) {
  return {position(c->vertex(0)), position(c->vertex(1)), position(c->vertex(2)), position(c->vertex(3))};
}

}  // namespace pgdr

#endif
