// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_HULL_BOX_3_H
#define PGDR_REFINEMENT_HULL_BOX_3_H

#include <algorithm>
#include <cmath>

#include <pgdr/domain/region_3.h>
#include <pgdr/mesh/mesh_triangulation_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>

namespace pgdr {

/// The convex hull of the triangulation, which is always an axis-aligned box, and the points that are moved into it.
template <class Tr>
class Hull_box_3 {
 public:
  using Vertex_handle = typename Tr::Vertex_handle;

  explicit Hull_box_3(const Tr& tr) {
    bool first = true;
    for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v) {
      const Vec_3 p = position(Vertex_handle(v));
      bool lowest = true;
      for (int i = 0; i < 3; ++i) {
        lowest = lowest && (first || p[i] <= box_.lower[i]);
        box_.lower[i] = first ? p[i] : std::min(box_.lower[i], p[i]);
        box_.upper[i] = first ? p[i] : std::max(box_.upper[i], p[i]);
      }
      if (lowest) corner_ = v;
      first = false;
    }
  }

  /// Closed.
  const Region_3& box() const { return box_; }
  /// The vertex at the lowest corner.
  Vertex_handle corner() const { return corner_; }

  /// The nearest point of the hull.
  Vec_3 clamp(Vec_3 p) const {
    for (int i = 0; i < 3; ++i) p[i] = std::clamp(p[i], box_.lower[i], box_.upper[i]);
    return p;
  }

  /// A point of the box in the hull, or the point of the hull that is nearest to it.
  Vec_3 nearest(const Region_3& box) const {
    Vec_3 p;
    for (int i = 0; i < 3; ++i)
      p[i] = 0.5 * (std::max(box.lower[i], box_.lower[i]) + std::min(box.upper[i], box_.upper[i]));
    return clamp(p);
  }

  /// The Steiner point of a tetrahedron outside the domain: its circumcenter, or where that is beyond the hull or close
  /// to it, a point of the hull's faces, edges or corners. So no vertex comes so close to the hull that a flat
  /// tetrahedron in between could not be split. What the circumball has in common with the hull fits into a ball of
  /// radius rho around the nearest point of the hull; the point is no farther from there than 0.58 rho.
  Vec_3 attract(const Tetrahedron_ball& ball) const {
    Vec_3 p = clamp(ball.center);
    const double rho = std::sqrt(std::max(0.0, ball.squared_radius - squared_distance(p, ball.center)));
    for (int i = 0; i < 3; ++i) {
      if (p[i] - box_.lower[i] < rho / 3)
        p[i] = box_.lower[i];
      else if (box_.upper[i] - p[i] < rho / 3)
        p[i] = box_.upper[i];
    }
    return p;
  }

  /// The Steiner point of a ball whose center is outside the hull: where the way from the tetrahedron to the center
  /// leaves it. Still inside the ball, which is convex.
  Vec_3 pull_in(const Vec_3& center, const Tetrahedron_points& corners) const {
    const Vec_3 from = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    double t = 1;
    for (int i = 0; i < 3; ++i) {
      if (center[i] < box_.lower[i]) t = std::min(t, (box_.lower[i] - from[i]) / (center[i] - from[i]));
      if (center[i] > box_.upper[i]) t = std::min(t, (box_.upper[i] - from[i]) / (center[i] - from[i]));
    }
    return t == 1 ? center : clamp(from + t * (center - from));
  }

 private:
  Region_3 box_;
  Vertex_handle corner_;
};

}  // namespace pgdr

#endif
