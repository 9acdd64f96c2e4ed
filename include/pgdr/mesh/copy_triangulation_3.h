// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_COPY_TRIANGULATION_3_H
#define PGDR_MESH_COPY_TRIANGULATION_3_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <CGAL/Unique_hash_map.h>

namespace pgdr {

/// The vertices and cells of a triangulation in an order of their own: a container's is by which thread filled which part of it.
template <class Tr>
struct Ordered_triangulation_3 {
  struct Cell {
    std::array<std::uint32_t, 4> vertices;  ///< positions in the other list; an even permutation of those of `cell`
    typename Tr::Cell_handle cell;
    friend bool operator<(const Cell& a, const Cell& b) { return a.vertices < b.vertices; }
  };
  std::vector<typename Tr::Vertex_handle> vertices;  ///< all, the infinite one last
  std::vector<Cell> cells;                           ///< all, infinite ones too
};

/// Makes `to` the same triangulation, with vertices and cells of its own types, made in the order of the lists.
///
/// \param point gives the point of a vertex in `to`
/// \return the vertices and cells of `to`, at the same positions
template <class From, class To, class Point>
Ordered_triangulation_3<To> copy_triangulation_3(const Ordered_triangulation_3<From>& from, To& to, const Point& point) {
  auto& tds = to.tds();
  tds.clear();
  tds.set_dimension(3);
  Ordered_triangulation_3<To> copy;
  copy.vertices.reserve(from.vertices.size());
  for (const auto v : from.vertices) {
    copy.vertices.push_back(tds.create_vertex());
    if (v != from.vertices.back()) copy.vertices.back()->set_point(point(v));
  }
  to.set_infinite_vertex(copy.vertices.back());

  CGAL::Unique_hash_map<typename From::Cell_handle, std::uint32_t> position(0, from.cells.size());
  copy.cells.reserve(from.cells.size());
  for (const auto& c : from.cells) {
    position[c.cell] = static_cast<std::uint32_t>(copy.cells.size());
    const auto vertex = [&](std::size_t k) { return copy.vertices[c.vertices[k]]; };
    copy.cells.push_back({c.vertices, tds.create_cell(vertex(0), vertex(1), vertex(2), vertex(3))});
    for (std::size_t k = 0; k < 4; ++k) vertex(k)->set_cell(copy.cells.back().cell);
  }
  for (std::size_t i = 0; i < from.cells.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto old = from.cells[i].cell;
      const auto opposite = old->neighbor(old->index(from.vertices[from.cells[i].vertices[k]]));
      copy.cells[i].cell->set_neighbor(static_cast<int>(k), copy.cells[position[opposite]].cell);
    }
  return copy;
}

}  // namespace pgdr

#endif
