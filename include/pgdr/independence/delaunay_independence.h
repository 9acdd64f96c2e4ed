// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_INDEPENDENCE_DELAUNAY_INDEPENDENCE_H
#define PGDR_INDEPENDENCE_DELAUNAY_INDEPENDENCE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <vector>

#include <CGAL/enum.h>
#include <CGAL/iterator.h>

namespace pgdr {

namespace internal {

/// Whether a point is in conflict with the tetrahedron that a cell becomes when one of its vertices, `replaced`, is
/// moved to `q`. The circumball is open; that of an infinite cell is the open half-space beyond its finite facet,
/// and in the plane of the facet the open disk.
template <class Tr>
bool conflicts_with_moved(const Tr& t, typename Tr::Cell_handle c, int replaced, const typename Tr::Point& q,
                          const typename Tr::Point& p) {
  using Traits = typename Tr::Geom_traits;
  const Traits& traits = t.geom_traits();
  const bool infinite = t.is_infinite(c);
  std::array<const typename Tr::Point*, 4> corner{};
  std::array<const typename Tr::Point*, 3> finite{};
  std::size_t n = 0;
  for (int i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (infinite && t.is_infinite(c->vertex(i))) {
      corner[k] = &p;
      continue;
    }
    corner[k] = i == replaced ? &q : &c->vertex(i)->point();
    if (infinite) finite[n++] = corner[k];
  }
  if (!infinite)
    return traits.side_of_oriented_sphere_3_object()(*corner[0], *corner[1], *corner[2], *corner[3], p) ==
           CGAL::ON_POSITIVE_SIDE;
  const CGAL::Orientation o = traits.orientation_3_object()(*corner[0], *corner[1], *corner[2], *corner[3]);
  if (o != CGAL::COPLANAR) return o == CGAL::POSITIVE;
  return traits.coplanar_side_of_bounded_circle_3_object()(*finite[0], *finite[1], *finite[2], p) ==
         CGAL::ON_BOUNDED_SIDE;
}

}  // namespace internal

/// **Theorem 1** (A. Chernikov, N. Chrisochoides, *Three-dimensional Delaunay refinement for multi-core processors*,
/// ICS 2008). Two points p and q are *Delaunay-independent* with respect to a Delaunay triangulation, that is, replacing
/// both cavities by the stars of the points yields a Delaunay triangulation, if and only if
///
/// - (2) C(p) and C(q) have no cell in common, and
/// - (3) for every triangle on both boundaries, p is not in the circumball of its tetrahedron with q.
///
/// `t` is any `CGAL::Delaunay_triangulation_3`, of dimension 3, for which the points are exact; nothing is inserted.
/// Cavities are those of `find_conflicts`, which decides ties by symbolic perturbation. Not for several threads at
/// once: CGAL marks cells while it searches. The proof, for points anywhere, is in docs/theory.md, section 2.
/// \pre p and q are different, no vertices of t, and in its convex hull.
template <class Tr>
bool are_delaunay_independent(const Tr& t, const typename Tr::Point& p, const typename Tr::Point& q) {
  using Cell_handle = typename Tr::Cell_handle;
  using Facet = typename Tr::Facet;
  std::vector<Facet> boundary;
  std::vector<Cell_handle> cavity_p, cavity_q;
  t.find_conflicts(q, t.locate(q), CGAL::Emptyset_iterator(), std::back_inserter(cavity_q));
  t.find_conflicts(p, t.locate(p), std::back_inserter(boundary), std::back_inserter(cavity_p));
  std::sort(cavity_q.begin(), cavity_q.end());  // for look-ups only
  const auto in_cavity_q = [&](Cell_handle c) { return std::binary_search(cavity_q.begin(), cavity_q.end(), c); };
  if (std::any_of(cavity_p.begin(), cavity_p.end(), in_cavity_q)) return false;
  return std::none_of(boundary.begin(), boundary.end(), [&](const Facet& f) {
    const Cell_handle beyond = f.first->neighbor(f.second);
    return in_cavity_q(beyond) &&
           internal::conflicts_with_moved(t, beyond, beyond->index(f.first), q, p);
  });
}

}  // namespace pgdr

#endif
