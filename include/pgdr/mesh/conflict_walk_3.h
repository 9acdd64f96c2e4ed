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

/// Whether p lies beyond the i-th triangle of a finite tetrahedron.
template <class Tr>
bool lies_beyond(const Tr& tr, typename Tr::Cell_handle c, int i, const typename Tr::Point& p) {
  const auto at = [&](int j) -> const typename Tr::Point& { return j == i ? p : c->vertex(j)->point(); };
  return tr.geom_traits().orientation_3_object()(at(0), at(1), at(2), at(3)) == CGAL::NEGATIVE;
}

/// The first of the triangles of a finite tetrahedron, but for the one to `before`, that p lies beyond; -1 if there is none, and p lies inside.
template <class Tr>
int way_towards(const Tr& tr, typename Tr::Cell_handle c, typename Tr::Cell_handle before, const typename Tr::Point& p) {
  for (int i = 0; i < 4; ++i)
    if (c->neighbor(i) != before && lies_beyond(tr, c, i, p)) return i;
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
