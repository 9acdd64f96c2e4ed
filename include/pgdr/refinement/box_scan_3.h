// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_BOX_SCAN_3_H
#define PGDR_REFINEMENT_BOX_SCAN_3_H

#include <cmath>
#include <limits>

#include <pgdr/refinement/cell_scan_3.h>
#include <pgdr/refinement/enclosing_ball.h>
#include <pgdr/refinement/leaf_refiner.h>
#include <pgdr/refinement/tetrahedron_ball.h>

namespace pgdr {

template <class Cell_handle>
Tetrahedron_points tetrahedron_points(Cell_handle c) {
  return {position(c->vertex(0)), position(c->vertex(1)), position(c->vertex(2)), position(c->vertex(3))};
}

/// Whether every finite tetrahedron that meets the box, but is not inside the hole, has m < bound (the zone
/// condition), and how coarse the mesh is meant to stay there. `start` is a point of the box, `near` a vertex not far
/// from it. Reads only.
template <class Tr, class Criteria>
Scan_result scan_box(const Tr& tr, const Criteria& criteria, const Region_3& box, const Region_3& hole, double bound,
                     const Vec_3& start, typename Tr::Vertex_handle near) {
  using Cell_handle = typename Tr::Cell_handle;
  Scan_result result;
  Cell_scan_3<Tr> cells(tr);
  result.finer = cells.visit(
      start, near, [&](Cell_handle c) { return boxes_meet(tetrahedron_points(c), box); },
      [&](Cell_handle c) {
        // Most tetrahedra are small enough by what is known of their balls.
        const double known = c->ball().is_known() ? static_cast<double>(c->ball().squared_outside)
                                                  : std::numeric_limits<double>::infinity();
        if (known < bound * bound && known <= result.coarsest * result.coarsest) return true;
        const Tetrahedron_points p = tetrahedron_points(c);
        const Tetrahedron_ball b = tetrahedron_ball(p);
        // What is poor, or outside, is on some worklist, or was refused.
        if (c->subdomain() != 0 && b.squared_radius > result.coarsest * result.coarsest &&
            !criteria.is_poor(b, c->subdomain()))
          result.coarsest = (1 + 1e-6) * std::sqrt(b.squared_radius);
        return b.squared_radius < bound * bound * (1 - 1e-8) || !boxes_meet(p, box) || is_inside(p, hole) ||
               enclosing_radius(p) < bound;
      });
  return result;
}

/// Whether every finite tetrahedron whose circumball meets the box has a circumradius < bound (condition (18) of
/// Chernikov and Chrisochoides). The arguments are those of `scan_box`. Reads only.
template <class Tr>
bool scan_circumballs(const Tr& tr, const Region_3& box, double bound, const Vec_3& start,
                      typename Tr::Vertex_handle near) {
  using Cell_handle = typename Tr::Cell_handle;
  Cell_scan_3<Tr> cells(tr);
  const auto meets = [&](Cell_handle c) {
    const Tetrahedron_ball b = tetrahedron_ball(tetrahedron_points(c));
    const double d = distance_to_box(b.center, box);
    return d * d < b.squared_radius;
  };
  return cells.visit(start, near, meets, [&](Cell_handle c) {
    return !meets(c) || tetrahedron_ball(tetrahedron_points(c)).squared_radius < bound * bound * (1 - 1e-8);
  });
}

}  // namespace pgdr

#endif
