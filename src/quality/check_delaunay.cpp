// SPDX-License-Identifier: GPL-3.0-or-later
// The Delaunay property, against CGAL's own triangulation of the same vertices.
#include <algorithm>
#include <utility>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include "check_parts.h"

namespace pgdr::quality_detail {

namespace {

using Vertex_base = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Epick>;
using Cell_base = CGAL::Delaunay_triangulation_cell_base_3<Epick>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Epick, CGAL::Triangulation_data_structure_3<Vertex_base, Cell_base>>;

/// The tetrahedra of a mesh by their ascending vertices.
class Tetrahedron_table {
 public:
  explicit Tetrahedron_table(const Indexed_mesh_3& mesh) : begin_(mesh.points.size() + 1, 0) {
    for (const auto& t : mesh.tetrahedra) ++begin_[*std::min_element(t.begin(), t.end()) + 1];
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    items_.resize(mesh.tetrahedra.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t i = 0; i < mesh.tetrahedra.size(); ++i) {
      auto t = mesh.tetrahedra[i];
      std::sort(t.begin(), t.end());
      items_[next[t[0]]++] = {t[1], t[2], t[3], i};
    }
  }
  /// Calls f(index) for each tetrahedron with the four vertices.
  template <class F>
  void find(std::array<std::uint32_t, 4> t, F f) const {
    std::sort(t.begin(), t.end());
    for (std::size_t i = begin_[t[0]]; i < begin_[t[0] + 1]; ++i)
      if (items_[i][0] == t[1] && items_[i][1] == t[2] && items_[i][2] == t[3]) f(items_[i][3]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::array<std::uint32_t, 4>> items_;
};

/// Whether the circumsphere of the mesh's tetrahedron `t` is that of a cell of `dt`, ties decided exactly.
///
/// In a Delaunay triangulation that is equivalent to an empty open ball: if the ball of `t` is empty, the
/// vertices on its sphere span a cell of the Delaunay subdivision; `dt` divides that cell, and one of its
/// pieces has t[0].
bool on_empty_sphere(const Triangulation& dt, const std::vector<Triangulation::Vertex_handle>& vertices,
                     const std::array<std::uint32_t, 4>& t, std::vector<Triangulation::Cell_handle>& cells) {
  cells.clear();
  dt.finite_incident_cells(vertices[t[0]], std::back_inserter(cells));
  return std::any_of(cells.begin(), cells.end(), [&](Triangulation::Cell_handle c) {
    return std::all_of(t.begin() + 1, t.end(), [&](std::uint32_t v) {
      return c->has_vertex(vertices[v]) || dt.side_of_sphere(c, vertices[v]->point()) == CGAL::ON_BOUNDARY;
    });
  });
}

/// Some vertex strictly inside the circumball of the positive tetrahedron `t`, by exact tests; `none` if
/// there is none.
std::uint32_t vertex_inside(const Indexed_mesh_3& mesh, const std::array<std::uint32_t, 4>& t) {
  const auto a = point(mesh, t[0]), b = point(mesh, t[1]), c = point(mesh, t[2]), d = point(mesh, t[3]);
  if (CGAL::orientation(a, b, c, d) == CGAL::COPLANAR) return none;
  const CGAL::Bounded_side inside = CGAL::ON_BOUNDED_SIDE;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v)
    if (CGAL::side_of_bounded_sphere(a, b, c, d, point(mesh, v)) == inside) return v;
  return none;
}

}  // namespace

Check_line check_delaunay(const Indexed_mesh_3& mesh) {
  Failures failures;
  std::size_t cells_of_reference = 0, ties = 0, poor = 0;
  std::vector<bool> is_cell(mesh.tetrahedra.size());
  {
    std::vector<std::pair<Epick::Point_3, std::uint32_t>> points;
    points.reserve(mesh.points.size());
    for (std::uint32_t v = 0; v < mesh.points.size(); ++v) points.emplace_back(point(mesh, v), v);
    Triangulation dt(points.begin(), points.end());
    std::vector<decltype(points)::value_type>().swap(points);
    if (dt.dimension() != 3) {
      failures.add("the vertices lie in a plane");
      return failures.line("delaunay", "no triangulation");
    }
    if (!dt.is_valid()) failures.add("the reference triangulation of the vertices is not valid");
    std::vector<Triangulation::Vertex_handle> vertices(mesh.points.size());
    for (auto v = dt.finite_vertices_begin(); v != dt.finite_vertices_end(); ++v) vertices[v->info()] = v;

    {
      const Tetrahedron_table table(mesh);
      for (auto c = dt.finite_cells_begin(); c != dt.finite_cells_end(); ++c)
        table.find({c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()},
                   [&](std::uint32_t i) { is_cell[i] = true; });
    }
    std::vector<Triangulation::Cell_handle> cells;
    for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
      if (is_cell[i]) {
        ++cells_of_reference;
        continue;
      }
      const auto& t = mesh.tetrahedra[i];
      const bool known = std::all_of(
          t.begin(), t.end(), [&](std::uint32_t v) { return vertices[v] != Triangulation::Vertex_handle(); });
      if (!known) {
        failures.add("tetrahedron ", i, " has a vertex at the place of another");
        continue;
      }
      if (on_empty_sphere(dt, vertices, t, cells)) {
        ++ties;
      } else if (poor++ == 0) {
        const std::uint32_t v = vertex_inside(mesh, t);
        if (v == none)
          failures.add("tetrahedron ", i, " is flat");
        else
          failures.add("the circumball of tetrahedron ", i, " contains vertex ", v);
      } else {
        failures.add("");
      }
    }
  }
  return failures.line("delaunay", text(cells_of_reference, " cells of the reference, ", ties,
                                        " other tetrahedra on empty spheres, ", poor, " not Delaunay"));
}

}  // namespace pgdr::quality_detail
