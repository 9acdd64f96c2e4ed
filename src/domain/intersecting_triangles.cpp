// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/detail/intersecting_triangles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <CGAL/Cartesian_converter.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Object.h>
#include <CGAL/centroid.h>
#include <CGAL/intersections.h>

#include <pgdr/domain/detail/box_pairs.h>

namespace pgdr::domain_detail {

namespace {

/// `t` with what it shares with another one in front, in the order that it has there; and how many that are.
std::pair<std::array<Index, 3>, std::size_t> shared_first(const std::array<Index, 3>& t, const std::array<Index, 3>& other) {
  std::array<Index, 3> result{};
  std::size_t common = 0, last = 3;
  for (const Index v : t)
    if (v == other[0] || v == other[1] || v == other[2]) result[common++] = v;
  for (std::size_t i = 3; i-- > 0;)
    if (const Index v = t[i]; v != other[0] && v != other[1] && v != other[2]) result[--last] = v;
  return {result, common};
}

using Corners = std::array<Work_point, 3>;

/// Whether the line along a side parts two triangles of one plane, but for the first corners, which they have in common. If not, they may still be apart.
bool are_parted(const Corners& p, const Corners& q, std::size_t common) {
  const Vec_3 n = cross(to_vec(p[1]) - to_vec(p[0]), to_vec(p[2]) - to_vec(p[0]));
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(n[k]) > std::abs(n[axis])) axis = k;
  // Seen along it nothing is turned over, and the predicates are as exact.
  const auto seen = [axis](const Work_point& x) { return Work_kernel::Point_2(x[(axis + 1) % 3], x[(axis + 2) % 3]); };
  const std::array of_p{seen(p[0]), seen(p[1]), seen(p[2])}, of_q{seen(q[0]), seen(q[1]), seen(q[2])};
  const auto parts = [common](const auto& x, const auto& y) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const CGAL::Orientation inside = CGAL::orientation(x[i], x[j], x[(i + 2) % 3]);
      if (inside == CGAL::COLLINEAR) return false;
      bool is_apart = true;
      for (std::size_t k = 0; k < 3 && is_apart; ++k) {
        const bool is_on_side = k < common && (k == i || k == j);
        is_apart = is_on_side || CGAL::orientation(x[i], x[j], y[k]) == -inside;
      }
      if (is_apart) return true;
    }
    return false;
  };
  return parts(of_p, of_q) || parts(of_q, of_p);
}

}  // namespace

bool triangles_meet(const std::array<Index, 3>& s, const std::array<Index, 3>& t, const std::vector<Vec_3>& points) {
  const auto [a, common] = shared_first(s, t);
  const auto b = shared_first(t, s).first;
  const auto corners = [&](const std::array<Index, 3>& c) {
    return Corners{to_work_point(points[c[0]]), to_work_point(points[c[1]]), to_work_point(points[c[2]])};
  };
  const Corners p = corners(a), q = corners(b);
  if (common == 3) return true;
  if (common == 2)
    return CGAL::orientation(p[0], p[1], p[2], q[2]) == CGAL::COPLANAR && CGAL::coplanar_orientation(p[0], p[1], p[2], q[2]) == CGAL::POSITIVE;
  // Mostly one of them is on one side of the other's plane, or of a side of the other in that, which is found out sooner than anything else.
  enum class Place { beside, in_plane, other };
  const auto place = [common = common](const Corners& x, const Corners& y) {
    const CGAL::Orientation side = CGAL::orientation(x[0], x[1], x[2], y[2]);
    for (std::size_t i = common; i < 2; ++i)
      if (CGAL::orientation(x[0], x[1], x[2], y[i]) != side) return Place::other;
    return side == CGAL::COPLANAR ? Place::in_plane : Place::beside;
  };
  const Place of_q = place(p, q);
  if (of_q == Place::beside || (of_q == Place::in_plane ? are_parted(p, q, common) : place(q, p) == Place::beside)) return false;
  const Work_kernel::Triangle_3 first(p[0], p[1], p[2]), second(q[0], q[1], q[2]);
  // A triangle without area is no more than its edges, which its neighbors have, too; and no predicate takes one.
  if (first.is_degenerate() || second.is_degenerate()) return false;
  if (common == 0) return CGAL::do_intersect(first, second);
  // What they have in common beyond the vertex would reach an opposite edge.
  return CGAL::do_intersect(Work_kernel::Segment_3(p[1], p[2]), second) || CGAL::do_intersect(Work_kernel::Segment_3(q[1], q[2]), first);
}

Intersection_finder::Intersection_finder(const Triangle_soup& soup) : soup_(soup) {
  triangle_boxes_.reserve(soup.triangles.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    triangle_boxes_.push_back({soup.triangle(t).bbox(), t});
}

std::vector<Id_pair> Intersection_finder::triangles() const {
  std::vector<Id_pair> result = Box_slabs(triangle_boxes_).pairs<Id_pair>([&](const Box& a, const Box& b, std::vector<Id_pair>& list) {
    const std::size_t s = std::min(a.info(), b.info()), t = std::max(a.info(), b.info());
    if (soup_.facet[s] != soup_.facet[t] && triangles_meet(soup_.triangles[s], soup_.triangles[t], soup_.points)) list.push_back({s, t});
  });
  std::sort(result.begin(), result.end());
  return result;
}

Work_point Intersection_finder::common_point(std::size_t s, std::size_t t) const {
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  const CGAL::Cartesian_converter<Work_kernel, Exact> to_exact;
  const CGAL::Object common = CGAL::intersection(to_exact(soup_.triangle(s)), to_exact(soup_.triangle(t)));
  std::vector<Exact::Point_3> points;
  if (const auto* point = CGAL::object_cast<Exact::Point_3>(&common)) points = {*point};
  if (const auto* segment = CGAL::object_cast<Exact::Segment_3>(&common)) points = {segment->source(), segment->target()};
  if (const auto* triangle = CGAL::object_cast<Exact::Triangle_3>(&common))
    points = {triangle->vertex(0), triangle->vertex(1), triangle->vertex(2)};
  if (const auto* polygon = CGAL::object_cast<std::vector<Exact::Point_3>>(&common)) points = *polygon;
  const Exact::Point_3 middle = CGAL::centroid(points.begin(), points.end(), CGAL::Dimension_tag<0>());
  return {CGAL::to_double(middle.x()), CGAL::to_double(middle.y()), CGAL::to_double(middle.z())};
}

std::vector<Id_pair> Intersection_finder::segments_and_triangles(const std::vector<std::array<Index, 2>>& segments) const {
  std::vector<Id_pair> result;
  std::vector<Box> boxes = triangle_boxes_, others = segment_boxes(segments);
  CGAL::box_intersection_d(others.begin(), others.end(), boxes.begin(), boxes.end(),
                           [&](const Box& a, const Box& b) {
                             if (segment_meets(segments[a.info()], b.info()))
                               result.push_back({a.info(), b.info()});
                           });
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Id_pair> Intersection_finder::segments(const std::vector<std::array<Index, 2>>& segments) const {
  std::vector<Id_pair> result;
  std::vector<Box> boxes = segment_boxes(segments);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const std::size_t s = std::min(a.info(), b.info()), t = std::max(a.info(), b.info());
    if (segments_meet(segments[s], segments[t])) result.push_back({s, t});
  });
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Id_pair> Intersection_finder::vertices_and_triangles(const std::vector<Index>& vertices) const {
  std::vector<Id_pair> result;
  std::vector<Box> boxes = triangle_boxes_, others;
  for (Index v : vertices) others.push_back({soup_.point(v).bbox(), v});
  CGAL::box_intersection_d(others.begin(), others.end(), boxes.begin(), boxes.end(),
                           [&](const Box& a, const Box& b) {
                             if (soup_.triangle(b.info()).has_on(soup_.point(static_cast<Index>(a.info()))))
                               result.push_back({a.info(), b.info()});
                           });
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Intersection_finder::Box> Intersection_finder::segment_boxes(const std::vector<std::array<Index, 2>>& segments) const {
  std::vector<Box> boxes;
  for (std::size_t s = 0; s < segments.size(); ++s)
    boxes.push_back({soup_.point(segments[s][0]).bbox() + soup_.point(segments[s][1]).bbox(), s});
  return boxes;
}

Intersection_finder::Segment Intersection_finder::segment(Index a, Index b) const { return {soup_.point(a), soup_.point(b)}; }

bool Intersection_finder::segment_meets(const std::array<Index, 2>& s, std::size_t triangle) const {
  const std::array<Index, 3>& t = soup_.triangles[triangle];
  const auto corner = [&](Index v) {
    return static_cast<std::size_t>(std::find(t.begin(), t.end(), v) - t.begin());
  };
  const std::size_t i = corner(s[0]), j = corner(s[1]);
  if (i == 3 && j == 3) return CGAL::do_intersect(segment(s[0], s[1]), soup_.triangle(triangle));
  if (i < 3 && j < 3) return true;  // along an edge that is no segment of the facet
  const std::size_t k = i < 3 ? i : j;
  const Index other = i < 3 ? s[1] : s[0];
  return soup_.triangle(triangle).has_on(soup_.point(other)) ||
         CGAL::do_intersect(segment(s[0], s[1]), segment(t[(k + 1) % 3], t[(k + 2) % 3]));
}

bool Intersection_finder::segments_meet(const std::array<Index, 2>& s, const std::array<Index, 2>& t) const {
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      if (s[i] != t[j]) continue;
      const Work_point apex = soup_.point(s[i]), p = soup_.point(s[1 - i]), q = soup_.point(t[1 - j]);
      return CGAL::collinear(apex, p, q) && !CGAL::collinear_are_ordered_along_line(p, apex, q);
    }
  return CGAL::do_intersect(segment(s[0], s[1]), segment(t[0], t[1]));
}

}  // namespace pgdr::domain_detail
