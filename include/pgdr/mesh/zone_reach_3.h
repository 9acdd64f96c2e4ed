// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_ZONE_REACH_3_H
#define PGDR_MESH_ZONE_REACH_3_H

#include <pgdr/domain/region_3.h>

namespace pgdr {

/// What the task of a leaf may read and write while others are at work: the tetrahedra with a finite vertex within ell*/4 of the
/// leaf. These are in its zone (zone theorem, docs/theory.md, section 5), which no other task touches.
template <class Tr>
struct Zone_reach_3 {
  using Vertex_handle = typename Tr::Vertex_handle;
  using Cell_handle = typename Tr::Cell_handle;

  Region_3 near;  ///< the leaf grown by ell*/4; all of space where nobody else is at work
  Vertex_handle infinite;

  bool is_everything() const { return near == Region_3{}; }

  bool is_near(Vertex_handle v) const { return v != infinite && near.contains_closed(position(v)); }

  /// Whether one may go from c to its neighbor i: they have a near vertex in common.
  bool leads_on(Cell_handle c, int i) const {
    for (int j = 0; j < 4; ++j)
      if (j != i && is_near(c->vertex(j))) return true;
    return false;
  }

  /// Whether one may go to all neighbors of c.
  bool leads_on(Cell_handle c) const {
    int n = 0;
    for (int j = 0; j < 4; ++j) n += is_near(c->vertex(j));
    return n > 1;
  }
};

}  // namespace pgdr

#endif
