// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_TERRITORY_3_H
#define PGDR_MESH_TERRITORY_3_H

#include <algorithm>
#include <cstdint>

namespace pgdr {

/// What a task may change: the *own* vertices, those that carry the territory's number, and the tetrahedra, subfacets and
/// subsegments that have no others.
///
/// Several tasks may be at work at once, each in a territory of its own, wherever these are and whatever the mesh is like
/// (territory theorem, docs/theory.md), if each
/// - deletes only own tetrahedra, and gives its number to the vertices that it inserts,
/// - reads only what has an own vertex, and goes from one tetrahedron to the next only across a triangle with an own vertex.
/// Then nobody else changes what it reads. The infinite vertex is everybody's.
template <class Tr>
struct Territory_3 {
  using Vertex_handle = typename Tr::Vertex_handle;
  using Cell_handle = typename Tr::Cell_handle;

  static constexpr std::uint16_t everybody = 0xffff;  ///< number of the infinite vertex
  std::uint16_t number = 0;                           ///< 0: nobody else is at work, and everything is own

  bool is_everything() const { return number == 0; }

  bool owns(Vertex_handle v) const {
    return number == 0 || v->territory() == number || v->territory() == everybody;
  }
  /// The same of a subsegment or subfacet with these vertices.
  template <class Vertices>
  bool owns(const Vertices& vertices) const
    requires requires { vertices.size(); }
  {
    return number == 0 || std::ranges::all_of(vertices, [this](Vertex_handle v) { return owns(v); });
  }
  bool owns(Cell_handle c) const {
    return number == 0 || (owns(c->vertex(0)) && owns(c->vertex(1)) && owns(c->vertex(2)) && owns(c->vertex(3)));
  }

  /// Whether v may be gone by: it is own, and finite.
  bool leads_on(Vertex_handle v) const { return number == 0 || v->territory() == number; }
  /// Whether one may go from c to its neighbor i.
  bool leads_on(Cell_handle c, int i) const {
    for (int j = 0; j < 4; ++j)
      if (j != i && leads_on(c->vertex(j))) return true;
    return false;
  }
};

}  // namespace pgdr

#endif
