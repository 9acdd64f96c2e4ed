// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_DISTANCE_SIZING_FIELD_H
#define PGDR_SIZING_DISTANCE_SIZING_FIELD_H

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include <CGAL/number_utils.h>

namespace pgdr {

/// A sizing field by the distance from triangles, or segments: `near` up to the distance `margin` from them, `far` at the distance `reach` from there and
/// beyond, linear in between.
///
/// Sizes are those of circumcenters: a tetrahedron that touches them has a circumradius of at most near / (1 - slope), with the
/// slope (far - near) / reach, and only where that is below 1 is there a bound at all; of at most near, if the margin is no less.
///
/// Distances are those of double arithmetic (CGAL's AABB tree), the same on every thread. Copies share the tree.
class Distance_sizing_field {
 public:
  using Triangle = std::array<std::array<double, 3>, 3>;
  using Segment = std::array<std::array<double, 3>, 2>;

  /// Throws `std::invalid_argument` unless 0 < near <= far < infinity, far - near < reach < infinity, 0 <= margin < infinity and there is a triangle with an area.
  Distance_sizing_field(const std::vector<Triangle>& triangles, double near, double far, double reach, double margin = 0);

  /// Whether distances are measured from it; a thinner one has those of its neighbors.
  static bool has_area(const Triangle& triangle);

  /// The same from segments. Throws as well unless there is one with a length.
  static Distance_sizing_field from_segments(const std::vector<Segment>& segments, double near, double far, double reach, double margin = 0);

  template <class Point_3>
  double operator()(const Point_3& p) const {
    return size_within(coordinates(p), std::numeric_limits<double>::infinity());
  }

  /// As `LimitedSizingField` says.
  template <class Point_3, class Limit>
  double size_if_below(const Point_3& p, const Limit& limit) const {
    return size_within(coordinates(p), limit());
  }

  /// From the nearest of the triangles or segments, or `most` if that is less.
  double distance(const std::array<double, 3>& p, double most = std::numeric_limits<double>::infinity()) const;

  /// On the triangles or segments.
  double near() const { return near_; }
  double far() const { return far_; }
  double reach() const { return reach_; }
  double margin() const { return margin_; }
  /// Of all triangles together, in squares of this unit of length; 0 of segments.
  double area(double unit = 1) const;

 private:
  template <class Point_3>
  static std::array<double, 3> coordinates(const Point_3& p) {
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
  }

  /// With infinity the size at p, else what `size_if_below` returns.
  double size_within(const std::array<double, 3>& p, double limit) const;

  struct Tree;
  template <class Objects>
  struct Tree_of;

  Distance_sizing_field() = default;
  void set_sizes(double near, double far, double reach, double margin);

  std::shared_ptr<const Tree> tree_;
  double near_ = 0, far_ = 0, reach_ = 0, margin_ = 0;
};

}  // namespace pgdr

#endif
