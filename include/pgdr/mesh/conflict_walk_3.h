// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_CONFLICT_WALK_3_H
#define PGDR_MESH_CONFLICT_WALK_3_H

#include <CGAL/enum.h>

namespace pgdr {

/// Whether p is where a vertex of c is; such a point is in conflict with nothing.
template <class Tr>
bool has_vertex_at(const Tr& tr, typename Tr::Cell_handle c, const typename Tr::Point& p) {
  for (int i = 0; i < 4; ++i)
    if (c->vertex(i) != tr.infinite_vertex() && c->vertex(i)->point() == p) return true;
  return false;
}

/// The first of the triangles of a finite tetrahedron, but for the one to `before`, that p lies beyond; -1 if there is none, and p lies inside.
template <class Tr>
int way_towards(const Tr& tr, typename Tr::Cell_handle c, typename Tr::Cell_handle before, const typename Tr::Point& p) {
  const auto orientation = tr.geom_traits().orientation_3_object();
  for (int i = 0; i < 4; ++i) {
    if (c->neighbor(i) == before) continue;
    const typename Tr::Point* corners[4];
    for (int j = 0; j < 4; ++j) corners[j] = j == i ? &p : &c->vertex(j)->point();
    if (orientation(*corners[0], *corners[1], *corners[2], *corners[3]) == CGAL::NEGATIVE) return i;
  }
  return -1;
}

/// Walks from a vertex within reach towards p to a tetrahedron in conflict with p, or with a vertex there; none if the way leads out
/// of reach, a `Territory_3` or `Zone_reach_3`.
///
/// A visibility walk, which ends in every Delaunay triangulation. \pre p is not outside the convex hull.
template <class Tr, class Reach>
typename Tr::Cell_handle walk_to_conflict(const Tr& tr, const Reach& reach, typename Tr::Vertex_handle from,
                                          const typename Tr::Point& p) {
  using Cell_handle = typename Tr::Cell_handle;
  Cell_handle c = from->cell(), before = {};
  if (tr.is_infinite(c)) c = c->neighbor(c->index(tr.infinite_vertex()));
  while (true) {
    if (has_vertex_at(tr, c, p) || tr.in_conflict(c, p)) return c;
    if (tr.is_infinite(c)) return {};
    const int way = way_towards(tr, c, before, p);
    if (way < 0 || !reach.leads_on(c, way)) return {};
    before = c;
    c = c->neighbor(way);
  }
}

}  // namespace pgdr

#endif
