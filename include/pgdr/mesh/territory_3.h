// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_TERRITORY_3_H
#define PGDR_MESH_TERRITORY_3_H

#include <algorithm>
#include <cstdint>

#include <pgdr/domain/region_3.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// Names a territory of a division of space, and its vertices: those that carry its number, and of those that carry none of this
/// division the ones in its region.
struct Territory_id {
  static constexpr std::uint32_t everybody = 0xffffffff;  ///< number of the infinite vertex

  std::uint32_t number = 0;  ///< 0: nobody else is at work, and everything is own
  std::uint32_t first = 0;   ///< lower numbers are of earlier divisions; this one is nobody's
  Region_3 region{};

  bool is_everything() const { return number == 0; }
};

/// What a task may change: the *own* vertices, those of the territory, and the tetrahedra, subfacets and subsegments that have no others.
///
/// Several tasks may be at work at once, each in a territory of its own, wherever these are and whatever the mesh is like
/// (territory theorem, docs/theory.md), if each
/// - deletes only own tetrahedra, and gives its number to the vertices that it inserts,
/// - reads only what has an own vertex, and goes from one tetrahedron to the next only across a triangle with an own vertex.
/// Then nobody else changes what it reads. The infinite vertex is everybody's.
///
/// A vertex gets the number when its owner first looks at it: to number all of them takes longer than a round of the refinement of a large mesh.
template <class Tr>
struct Territory_3 : Territory_id {
  using Vertex_handle = typename Tr::Vertex_handle;
  using Cell_handle = typename Tr::Cell_handle;

  bool owns(Vertex_handle v) const { return number == 0 || v->territory() == everybody || is_in(v); }
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
  bool leads_on(Vertex_handle v) const { return number == 0 || is_in(v); }
  /// Whether one may go from c to its neighbor i.
  bool leads_on(Cell_handle c, int i) const {
    for (int j = 0; j < 4; ++j)
      if (j != i && leads_on(c->vertex(j))) return true;
    return false;
  }

 private:
  bool is_in(Vertex_handle v) const {
    const std::uint32_t t = v->territory();
    if (t >= first) return t == number;
    if (!region.contains(to_vec(v->point()))) return false;
    v->set_territory(number);
    return true;
  }
};

}  // namespace pgdr

#endif
