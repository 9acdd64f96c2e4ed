// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_INTERSECTING_TRIANGLES_H
#define PGDR_DOMAIN_DETAIL_INTERSECTING_TRIANGLES_H

#include <array>
#include <cstddef>
#include <vector>

#include <CGAL/box_intersection_d.h>

#include <pgdr/domain/detail/triangle_soup.h>

namespace pgdr::domain_detail {

using Id_pair = std::array<std::size_t, 2>;

/// Whether two triangles meet other than in common vertices and edges. Exact.
bool triangles_meet(const std::array<Index, 3>& s, const std::array<Index, 3>& t, const std::vector<Vec_3>& points);

/// Finds what meets other than in common vertices and edges, by exact predicates.
class Intersection_finder {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  using Segment = Work_kernel::Segment_3;

 public:
  explicit Intersection_finder(const Triangle_soup& soup);

  /// Pairs of triangles of different facets, ascending.
  std::vector<Id_pair> triangles() const;

  /// A point in the middle of what two triangles have in common, rounded. \pre they meet
  Work_point common_point(std::size_t s, std::size_t t) const;

  /// Pairs of a segment that belongs to no facet (its position) and a triangle, ascending.
  std::vector<Id_pair> segments_and_triangles(const std::vector<std::array<Index, 2>>& segments) const;

  /// Pairs of segments, by position, ascending.
  std::vector<Id_pair> segments(const std::vector<std::array<Index, 2>>& segments) const;

  /// Pairs of a vertex and a triangle that it lies on without being its corner, ascending.
  std::vector<Id_pair> vertices_and_triangles(const std::vector<Index>& vertices) const;

 private:
  std::vector<Box> segment_boxes(const std::vector<std::array<Index, 2>>& segments) const;

  Segment segment(Index a, Index b) const;

  bool segment_meets(const std::array<Index, 2>& s, std::size_t triangle) const;

  bool segments_meet(const std::array<Index, 2>& s, const std::array<Index, 2>& t) const;

  const Triangle_soup& soup_;
  std::vector<Box> triangle_boxes_;
};

}  // namespace pgdr::domain_detail

#endif
