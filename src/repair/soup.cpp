// SPDX-License-Identifier: GPL-3.0-or-later
// A PLC as triangles, and what is wrong with them one by one.
#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <string>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <pgdr/domain/make_domain_3.h>

#include "steps.h"

namespace pgdr::repair_detail {

namespace {

using domain_detail::to_work_point;

/// By which triangles with the same corners are found.
struct Key {
  Index part;
  Corners corners;
  bool is_odd;
  Index triangle;
  friend auto operator<=>(const Key&, const Key&) = default;
  bool is_same_as(const Key& other) const { return part == other.part && corners == other.corners; }
};

/// Up to how many corners all triangulations of a polygon are compared (20 ms; 5 s with 600). CGAL's search among the edges of a Delaunay triangulation is fast, but
/// of two that are as good it takes the one that it finds first, and which that is depends on the addresses of cells: of 48 holes of one file, one was filled with other
/// triangles in one run of three.
constexpr std::size_t most_to_compare = 100;
/// Of the width of a larger polygon: how far off a plane it may be to be triangulated in that plane.
constexpr double most_off_plane = 0.1;

/// Triangles in the order of the polygon's corners; none if there is no triangulation.
std::vector<Corners> cgal_triangulation(const std::vector<Vec_3>& points, const std::vector<Index>& polygon) {
  std::vector<domain_detail::Work_point> rim;
  for (const Index v : polygon) rim.push_back(to_work_point(points[v]));
  std::vector<CGAL::Triple<int, int, int>> patch;
  const auto by = CGAL::parameters::use_delaunay_triangulation(false);
  if (polygon.size() <= most_to_compare)
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(rim, std::back_inserter(patch), by);
  else
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
        rim, std::back_inserter(patch),
        by.use_2d_constrained_delaunay_triangulation(true).threshold_distance(most_off_plane * diameter(points, polygon)).do_not_use_cubic_algorithm(true));
  std::vector<Corners> result;
  for (const auto& t : patch) {
    std::array<int, 3> i{t.first, t.second, t.third};
    std::ranges::sort(i);  // along the polygon
    Corners& c = result.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) c[k] = polygon[static_cast<std::size_t>(i[k])];
  }
  return result;
}

/// Where to cut a polygon in two, neither with less than a third of its corners: the ends of the shortest diagonal.
std::pair<std::size_t, std::size_t> shortest_cut(const std::vector<Vec_3>& points, const std::vector<Index>& polygon) {
  const std::size_t n = polygon.size(), least = n / 3;
  std::pair<std::size_t, std::size_t> best{0, least};
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + least; j < n && j - i <= n - least; ++j)
      if (const double d = squared_distance(points[polygon[i]], points[polygon[j]]); d < shortest) {
        shortest = d;
        best = {i, j};
      }
  return best;
}

}  // namespace

bool has_area(const Soup& soup, const Corners& c) {
  if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) return false;
  return !CGAL::collinear(to_work_point(soup.points[c[0]]), to_work_point(soup.points[c[1]]), to_work_point(soup.points[c[2]]));
}

std::pair<Corners, bool> sorted_corners(Corners c) {
  std::rotate(c.begin(), std::ranges::min_element(c), c.end());
  const bool is_odd = c[1] > c[2];
  if (is_odd) std::swap(c[1], c[2]);
  return {c, is_odd};
}

double diameter(const std::vector<Vec_3>& points, const std::vector<Index>& vertices) {
  CGAL::Bbox_3 box;
  for (const Index v : vertices) box += to_work_point(points[v]).bbox();
  return length(Vec_3{box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()});
}

std::vector<Corners> triangulated(const std::vector<Vec_3>& points, const std::vector<Index>& polygon) {
  if (polygon.size() == 3) return {{polygon[0], polygon[1], polygon[2]}};
  std::vector<Corners> result = cgal_triangulation(points, polygon);
  if (!result.empty() || polygon.size() <= most_to_compare) return result;
  const auto [i, j] = shortest_cut(points, polygon);
  const auto begin = polygon.begin() + static_cast<std::ptrdiff_t>(i), end = polygon.begin() + static_cast<std::ptrdiff_t>(j);
  std::vector<Index> rest(polygon.begin(), begin + 1);
  rest.insert(rest.end(), end, polygon.end());
  for (const std::vector<Index>& part : {std::vector<Index>(begin, end + 1), rest}) {
    const std::vector<Corners> of_part = triangulated(points, part);
    if (of_part.empty()) return {};
    result.insert(result.end(), of_part.begin(), of_part.end());
  }
  return result;
}

Triangle_edges::Triangle_edges(const std::vector<Triangle>& triangles) {
  edges.reserve(3 * triangles.size());
  for (Index t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = triangles[t].corners[i], b = triangles[t].corners[(i + 1) % 3];
      edges.push_back({sorted_pair(a, b), t, a < b});
    }
  std::ranges::sort(edges);
}

void add_to_soup(Soup& soup, const Plc& plc, Index part, Repair_report& report) {
  if (std::vector<Input_problem> problems = domain_detail::unusable_input(plc); !problems.empty()) throw Input_error(std::move(problems));
  if (!plc.segments.empty())
    throw Input_error(Input_problem::Kind::unreadable, "only facets can be repaired, and the input has segments of its own");
  std::vector<Vec_3> points;
  for (const auto& p : plc.vertices) points.push_back(to_vec(p));
  const std::vector<Index> first = domain_detail::first_equal_vertex(points, std::vector<char>(points.size(), 0));
  for (Index v = 0; v < first.size(); ++v) report.merged_vertices += first[v] != v;
  const Index offset = static_cast<Index>(soup.points.size());
  soup.points.insert(soup.points.end(), points.begin(), points.end());
  for (Index f = 0; f < plc.facets.size(); ++f) {
    const auto& facet = plc.facets[f];
    if (facet.polygons.empty()) continue;
    if (facet.polygons.size() != 1 || !facet.holes.empty())
      throw Input_error({{Input_problem::Kind::unreadable,
                          "facet " + std::to_string(f + plc.first_index) + " has holes or several polygons: it cannot be repaired", {f}}});
    std::vector<Index> polygon;
    for (const Index v : facet.polygons[0])
      if (polygon.empty() || polygon.back() != offset + first[v]) polygon.push_back(offset + first[v]);
    while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
    if (polygon.size() < 3) {
      ++report.degenerate_triangles;
      continue;
    }
    for (const Corners& c : triangulated(soup.points, polygon)) soup.triangles.push_back({c, part, f, facet.marker});
  }
}

void remove_degenerate(Soup& soup, Repair_report& report) {
  report.degenerate_triangles += std::erase_if(soup.triangles, [&](const Triangle& t) { return !has_area(soup, t.corners); });

  std::vector<Key> keys;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    const auto [corners, is_odd] = sorted_corners(soup.triangles[t].corners);
    keys.push_back({soup.triangles[t].part, corners, is_odd, t});
  }
  std::ranges::sort(keys);
  std::vector<bool> goes(soup.triangles.size(), false);
  for (std::size_t i = 0, j = 0; i < keys.size(); i = j) {
    while (j < keys.size() && keys[j].is_same_as(keys[i])) ++j;
    // Two with opposite sides may be where two solids touch; else what is left has the side that most of them have.
    const auto odd = static_cast<std::size_t>(std::count_if(keys.begin() + static_cast<std::ptrdiff_t>(i), keys.begin() + static_cast<std::ptrdiff_t>(j),
                                                            [](const Key& k) { return k.is_odd; }));
    const std::size_t even = j - i - odd;
    bool keep_even = even >= odd, keep_odd = odd >= even;
    for (std::size_t k = i; k < j; ++k) {
      bool& keep = keys[k].is_odd ? keep_odd : keep_even;
      goes[keys[k].triangle] = !keep;
      keep = false;
    }
  }
  std::size_t left = 0;
  for (std::size_t t = 0; t < goes.size(); ++t)
    if (!goes[t]) soup.triangles[left++] = soup.triangles[t];
  report.duplicate_triangles += goes.size() - left;
  soup.triangles.resize(left);
}

}  // namespace pgdr::repair_detail
