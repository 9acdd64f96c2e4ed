// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_TRIANGLE_COMPLEX_H
#define PGDR_SIMPLIFY_TRIANGLE_COMPLEX_H

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <pgdr/domain/detail/planar_triangulation.h>
#include <pgdr/domain/plc.h>

namespace pgdr::simplify_detail {

using Corners = std::array<Index, 3>;

/// Triangles over fixed points, any number at an edge, that come and go; with what is near in space, for tests of intersection.
class Triangle_complex {
 public:
  struct Triangle {
    Corners corners;
    Index facet;     ///< of the input, whose marker it has
    Index step = 0;  ///< that made it, counted from 1; 0: it is of the input
    double change = 0;  ///< what needles that were taken away added here to the changes of the corners
    bool alive = true;
  };

  Triangle_complex(std::vector<Vec_3> points, std::vector<Triangle> triangles);

  const Vec_3& point(Index v) const { return points_[v]; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// The triangles at a vertex, in no particular order.
  std::span<const Index> at(Index v) const { return at_[v]; }
  std::vector<Index> at_edge(Index a, Index b) const;
  /// The vertices that share a triangle with v, ascending.
  std::vector<Index> neighbors(Index v) const;
  bool has_triangle(Corners c) const;
  bool has_edge(Index a, Index b) const;

  double edge_length(Index a, Index b) const { return length(points_[a] - points_[b]); }
  /// Above its longest edge.
  double height(const Corners& c) const;
  /// Which corner is opposite of the longest edge.
  std::size_t apex(const Corners& c) const;

  /// The cosine of the smallest dihedral angle that these triangles have among each other and with all but the `removed` ones.
  double sharpest_cosine(std::span<const Triangle> list, std::span<const Index> removed) const;

  /// Whether one of these has no area, or would meet another one or a triangle that is not `removed`, other than in common corners.
  bool would_meet(std::span<const Triangle> made, std::span<const Index> removed) const;

  void replace(std::span<const Index> removed, std::span<const Triangle> made);

 private:
  using Point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Point>;
  using Entry = std::pair<Box, Index>;
  using Tree = boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>>;

  Box box(const Corners& c) const;

  std::vector<Vec_3> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::vector<Index>> at_;
  Tree tree_;
};

}  // namespace pgdr::simplify_detail

#endif
