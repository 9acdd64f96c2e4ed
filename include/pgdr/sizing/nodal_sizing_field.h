// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_NODAL_SIZING_FIELD_H
#define PGDR_SIZING_NODAL_SIZING_FIELD_H

#include <array>
#include <memory>
#include <vector>

#include <CGAL/number_utils.h>

namespace pgdr {

/// A sizing field from values at any points, such as the nodes of a mesh on which an error was estimated: linear in the tetrahedra of the points'
/// Delaunay triangulation; outside of their convex hull, and where all points lie in a plane, the value at the nearest of them.
///
/// The tetrahedra are found by exact predicates, values by double arithmetic, the same on every thread. Copies share the triangulation.
class Nodal_sizing_field {
 public:
  using Point = std::array<double, 3>;

  /// Of points that are there several times the first one counts. Throws `std::invalid_argument` unless there is a value for each point, all of
  /// them positive and finite, and a point.
  Nodal_sizing_field(const std::vector<Point>& points, const std::vector<double>& values);

  template <class Point_3>
  double operator()(const Point_3& p) const {
    return size_at({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
  }

  double size_at(const Point& p) const;

 private:
  struct Nodes;
  std::shared_ptr<const Nodes> nodes_;
};

}  // namespace pgdr

#endif
