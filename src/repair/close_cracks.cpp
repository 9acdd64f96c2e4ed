// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <CGAL/box_intersection_d.h>
#include <boost/pending/disjoint_sets.hpp>

#include "steps.h"

namespace pgdr::repair_detail {

namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

Box box(const Vec_3& a, const Vec_3& b, double margin, std::size_t info) {
  return {CGAL::Bbox_3(std::min(a.x, b.x) - margin, std::min(a.y, b.y) - margin, std::min(a.z, b.z) - margin, std::max(a.x, b.x) + margin,
                       std::max(a.y, b.y) + margin, std::max(a.z, b.z) + margin),
          info};
}

/// An edge that belongs to one triangle of its part.
struct Rim_edge {
  Index source, target;  ///< as the triangle runs
  Index triangle;
};

std::vector<Rim_edge> rim_edges(const Soup& soup) {
  std::vector<Rim_edge> result;
  const Triangle_edges all(soup.triangles);
  all.for_each([&](std::size_t i, std::size_t j) {
    for (std::size_t k = i; k < j; ++k) {
      const auto& e = all.edges[k];
      const Index part = soup.triangles[e.triangle].part;
      const bool is_alone = std::none_of(all.edges.begin() + static_cast<std::ptrdiff_t>(i), all.edges.begin() + static_cast<std::ptrdiff_t>(j),
                                         [&](const auto& f) { return f.triangle != e.triangle && soup.triangles[f.triangle].part == part; });
      if (!is_alone) continue;
      result.push_back(e.runs_forward ? Rim_edge{e.ends[0], e.ends[1], e.triangle} : Rim_edge{e.ends[1], e.ends[0], e.triangle});
    }
  });
  return result;
}

/// Those of its part, ascending.
std::vector<std::pair<Index, Index>> rim_vertices(const Soup& soup, const std::vector<Rim_edge>& rim) {
  std::vector<std::pair<Index, Index>> result;  // part, vertex
  for (const Rim_edge& e : rim)
    for (const Index v : {e.source, e.target}) result.emplace_back(soup.triangles[e.triangle].part, v);
  domain_detail::sort_unique(result);
  return result;
}

void merge_vertices(Soup& soup, double tolerance, Repair_report& report) {
  const std::vector<Rim_edge> rim = rim_edges(soup);
  const auto vertices = rim_vertices(soup, rim);
  std::vector<Index_pair> edges;
  for (const Rim_edge& e : rim) edges.push_back(sorted_pair(e.source, e.target));
  domain_detail::sort_unique(edges);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec_3& p = soup.points[vertices[i].second];
    boxes.push_back(box(p, p, tolerance / 2, i));
  }
  std::vector<std::tuple<double, Index, Index>> close;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& x, const Box& y) {
    const auto& [part, a] = vertices[std::min(x.info(), y.info())];
    const auto& [other, b] = vertices[std::max(x.info(), y.info())];
    // The ends of an edge are not on two sides of a crack.
    if (part != other || a == b || domain_detail::contains(edges, sorted_pair(a, b))) return;
    if (const double d = length(soup.points[a] - soup.points[b]); d <= tolerance) close.emplace_back(d, a, b);
  });
  std::ranges::sort(close);
  boost::disjoint_sets_with_storage<> merged(soup.points.size());
  std::vector<Index> representative(soup.points.size());
  std::iota(representative.begin(), representative.end(), Index{0});
  for (const auto& [d, a, b] : close) {
    const Index p = representative[merged.find_set(a)], q = representative[merged.find_set(b)];
    if (p == q || length(soup.points[p] - soup.points[q]) > tolerance) continue;
    merged.union_set(a, b);
    representative[merged.find_set(a)] = std::min(p, q);
    ++report.merged_vertices;
    report.largest_move = std::max(report.largest_move, d);
  }
  for (Triangle& t : soup.triangles)
    for (Index& v : t.corners) v = representative[merged.find_set(v)];
}

/// Divides triangles at vertices that lie on edges at the rim, one edge of each. \return whether there were any
bool divide_rims(Soup& soup, double tolerance, Repair_report& report) {
  const std::vector<Rim_edge> rim = rim_edges(soup);
  const auto vertices = rim_vertices(soup, rim);
  std::vector<Box> edge_boxes, vertex_boxes;
  for (std::size_t i = 0; i < rim.size(); ++i) edge_boxes.push_back(box(soup.points[rim[i].source], soup.points[rim[i].target], tolerance, i));
  for (std::size_t i = 0; i < vertices.size(); ++i) vertex_boxes.push_back(box(soup.points[vertices[i].second], soup.points[vertices[i].second], 0, i));
  std::vector<std::tuple<std::size_t, double, Index>> on;  // edge, where along it, vertex
  double largest = 0;
  CGAL::box_intersection_d(edge_boxes.begin(), edge_boxes.end(), vertex_boxes.begin(), vertex_boxes.end(), [&](const Box& x, const Box& y) {
    const Rim_edge& e = rim[x.info()];
    const auto& [part, v] = vertices[y.info()];
    const Corners& c = soup.triangles[e.triangle].corners;
    if (part != soup.triangles[e.triangle].part || std::ranges::find(c, v) != c.end()) return;
    const Vec_3 a = soup.points[e.source], along = soup.points[e.target] - a, p = soup.points[v];
    const double l = length(along), t = dot(p - a, along) / l;
    if (!(t > tolerance && t < l - tolerance) || squared_distance(p, a + (t / l) * along) > tolerance * tolerance) return;
    on.emplace_back(x.info(), t, v);
    largest = std::max(largest, length(p - (a + (t / l) * along)));
  });
  std::ranges::sort(on);
  std::vector<bool> is_divided(soup.triangles.size(), false);
  for (std::size_t i = 0, j = 0; i < on.size(); i = j) {
    const Rim_edge& e = rim[std::get<0>(on[i])];
    while (j < on.size() && std::get<0>(on[j]) == std::get<0>(on[i])) ++j;
    if (is_divided[e.triangle]) continue;  // next time
    is_divided[e.triangle] = true;
    ++report.closed_cracks;
    const Triangle whole = soup.triangles[e.triangle];
    const Index opposite = *std::ranges::find_if(whole.corners, [&](Index v) { return v != e.source && v != e.target; });
    Index from = e.source;
    for (std::size_t k = i; k <= j; ++k) {
      const Index to = k < j ? std::get<2>(on[k]) : e.target;
      Triangle piece = whole;
      piece.corners = {from, to, opposite};
      if (k == i) soup.triangles[e.triangle] = piece; else soup.triangles.push_back(piece);
      from = to;
    }
  }
  report.largest_move = std::max(report.largest_move, largest);
  return !on.empty();
}

}  // namespace

void close_cracks(Soup& soup, double tolerance, Repair_report& report) {
  if (!(tolerance > 0)) return;
  merge_vertices(soup, tolerance, report);
  remove_degenerate(soup, report);
  constexpr int most_rounds = 8;  // a triangle has three edges; pieces at the tolerance may be divided again
  for (int round = 0; round < most_rounds && divide_rims(soup, tolerance, report); ++round) remove_degenerate(soup, report);
}

}  // namespace pgdr::repair_detail
