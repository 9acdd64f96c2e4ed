// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_BOX_SCAN_3_H
#define PGDR_REFINEMENT_BOX_SCAN_3_H

#include <algorithm>
#include <cmath>

#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/refinement/cell_scan_3.h>
#include <pgdr/refinement/enclosing_ball.h>
#include <pgdr/refinement/leaf_refiner.h>

namespace pgdr {

/// Whether the bounding box of a tetrahedron meets a box; told by its ball where that is small.
template <class Cell_handle>
bool may_meet(Cell_handle c, const Region_3& box) {
  const Certified_ball& b = c->ball();
  if (b.has_center()) {
    const double r2 = static_cast<double>(b.squared_outside);
    bool center_in = true;
    for (int k = 0; k < 3; ++k) {
      const double x = static_cast<double>(b.center[k]);
      const double d = std::max({box.lower[k] - x, 0.0, x - box.upper[k]});
      if (d * d > r2) return false;
      center_in = center_in && d == 0;
    }
    if (center_in) return true;
  }
  return boxes_meet(tetrahedron_points(c), box);
}

/// Whether every finite tetrahedron that meets the box, but is not inside the hole, has m < bound (the zone
/// condition), and how coarse the mesh is meant to stay there. `start` is a point of the box, `near` a vertex not far
/// from it. Reads only, and of most tetrahedra only what is known of their balls.
template <class Tr>
Scan_result scan_box(const Tr& tr, const Region_3& box, const Region_3& hole, double bound, const Vec_3& start,
                     typename Tr::Vertex_handle near) {
  using Cell_handle = typename Tr::Cell_handle;
  Scan_result result;
  Cell_scan_3<Tr> cells(tr);
  double coarsest = 0;
  const auto is_small = [&](Cell_handle c) {
    double known = static_cast<double>(c->ball().squared_outside);
    if (!c->ball().has_center() || known >= bound * bound) {
      const Tetrahedron_points p = tetrahedron_points(c);
      const Tetrahedron_ball b = tetrahedron_ball(p);
      if (b.squared_radius >= bound * bound * (1 - 1e-8) && boxes_meet(p, box) && !is_inside(p, hole) &&
          enclosing_radius(p) >= bound)
        return false;
      known = b.squared_radius * (1 + 1e-6);
    }
    // What is poor, or outside, is on some worklist, or was refused.
    if (c->subdomain() != 0 && !c->is_poor()) coarsest = std::max(coarsest, known);
    return true;
  };
  result.finer = cells.visit(start, near, [&](Cell_handle c) { return may_meet(c, box); }, is_small);
  result.coarsest = std::sqrt(coarsest);
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
