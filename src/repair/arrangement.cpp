// SPDX-License-Identifier: GPL-3.0-or-later
// Where triangles meet: computed exactly, then rounded.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Cartesian_converter.h>
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Object.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/intersections.h>
#include <boost/pending/disjoint_sets.hpp>

#include <pgdr/domain/detail/box_pairs.h>
#include <pgdr/domain/detail/intersecting_triangles.h>

#include "steps.h"

namespace pgdr::repair_detail {

namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Point_3 = Exact::Point_3;
using Point_2 = Exact::Point_2;
using Pairs = std::vector<std::pair<Index, Index>>;
using domain_detail::to_work_point;

/// New points are rounded to multiples of 2^-bits of the size of the input, which may make new intersections. Which way a triangle faces that is lower than some
/// steps is what rounding has made of it, so that these go, and higher ones each time that there still are intersections.
constexpr int grid_bits = 40;
constexpr double steps_apart = 256;
constexpr double higher_each_round = 4;
constexpr int most_rounds = 12;
/// Intersections that come back are fewer than that times those there were, or it leads nowhere.
constexpr std::size_t most_growth = 8;

/// Points on the grid, equal ones once.
class Grid {
 public:
  Grid(std::vector<Vec_3>& points, double step) : points_(points), step_(step) {}

  Vec_3 rounded(const Vec_3& p) const { return {rounded(p.x), rounded(p.y), rounded(p.z)}; }

  /// A vertex of the triangles goes to the grid; \return the vertex that is there.
  Index move_vertex(Index v, double& largest_move) {
    const auto [it, is_new] = moved_.try_emplace(v, v);
    if (!is_new) return it->second;
    const Vec_3 to = rounded(points_[v]);
    largest_move = std::max(largest_move, length(to - points_[v]));
    points_[v] = to;
    return it->second = vertex_at(to, v);
  }

  std::size_t moved_vertices() const { return moved_.size(); }

  Index add(const Point_3& p) {
    const auto& e = CGAL::exact(p);  // what it is, not how it was made
    const Vec_3 at = rounded(Vec_3{CGAL::to_double(e.x()), CGAL::to_double(e.y()), CGAL::to_double(e.z())});
    const auto found = at_.find({at.x, at.y, at.z});
    if (found != at_.end()) return found->second;
    points_.push_back(at);
    return vertex_at(at, static_cast<Index>(points_.size() - 1));
  }

 private:
  double rounded(double x) const { return std::nearbyint(x / step_) * step_; }
  Index vertex_at(const Vec_3& p, Index v) { return at_.try_emplace({p.x, p.y, p.z}, v).first->second; }

  std::vector<Vec_3>& points_;
  double step_;
  std::map<std::array<double, 3>, Index> at_;
  std::map<Index, Index> moved_;
};

/// Coplanar triangles that overlap, or a single one, divided by all that meets them.
class Plane_arrangement {
  using Vb = CGAL::Triangulation_vertex_base_with_info_2<std::optional<Point_3>, Exact>;
  using Fb = CGAL::Constrained_triangulation_face_base_2<Exact>;
  using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Exact, CGAL::Triangulation_data_structure_2<Vb, Fb>, CGAL::Exact_intersections_tag>;
  using Vertex_handle = Cdt::Vertex_handle;

 public:
  explicit Plane_arrangement(const std::array<Point_3, 3>& plane) : origin_(plane[0]) {
    normal_ = CGAL::cross_product(plane[1] - plane[0], plane[2] - plane[0]);
    const double n[3] = {std::abs(CGAL::to_double(normal_.x())), std::abs(CGAL::to_double(normal_.y())), std::abs(CGAL::to_double(normal_.z()))};
    dropped_ = n[0] > n[1] && n[0] > n[2] ? 0 : n[1] > n[2] ? 1 : 2;
    // Inexact: the largest of numbers that may all be as good as zero must not be zero.
    for (int i = 0; i < 3 && normal_[dropped_] == 0; ++i) dropped_ = i;
  }

  void add_triangle(const std::array<Point_3, 3>& t) {
    std::array<Point_2, 3> flat_corners;
    for (std::size_t i = 0; i < 3; ++i) flat_corners[i] = flat(t[i]);
    triangles_.push_back(flat_corners);
    runs_forward_.push_back(CGAL::left_turn(flat_corners[0], flat_corners[1], flat_corners[2]));
    for (std::size_t i = 0; i < 3; ++i) add_segment(t[i], t[(i + 1) % 3]);
  }
  void add_segment(const Point_3& a, const Point_3& b) { cdt_.insert_constraint(vertex(a), vertex(b)); }
  void add_point(const Point_3& p) { vertex(p); }

  /// Whether a triangle's corners run as those of faces.
  bool runs_forward(std::size_t triangle) const { return runs_forward_[triangle]; }

  /// f(corners, positions of the triangles that cover it).
  template <class F>
  void for_each_face(F f) {
    std::vector<std::size_t> covering;
    for (auto face = cdt_.finite_faces_begin(); face != cdt_.finite_faces_end(); ++face) {
      covering.clear();
      if (triangles_.size() == 1) {
        covering.push_back(0);
      } else {
        const Point_2 middle = CGAL::centroid(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point());
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
          const auto& t = triangles_[i];
          const auto side = [&](std::size_t k) { return CGAL::orientation(t[k], t[(k + 1) % 3], middle); };
          if (side(0) == side(1) && side(1) == side(2)) covering.push_back(i);
        }
      }
      if (!covering.empty()) f(std::array<Point_3, 3>{lifted(face->vertex(0)), lifted(face->vertex(1)), lifted(face->vertex(2))}, covering);
    }
  }

 private:
  Point_2 flat(const Point_3& p) const { return {p[dropped_ == 0 ? 1 : 0], p[dropped_ == 2 ? 1 : 2]}; }

  Vertex_handle vertex(const Point_3& p) {
    const Vertex_handle v = cdt_.insert(flat(p));
    v->info() = p;
    return v;
  }

  /// Where constraints cross, the point of the plane.
  Point_3 lifted(Vertex_handle v) const {
    if (v->info()) return *v->info();
    const int i = dropped_ == 0 ? 1 : 0, j = dropped_ == 2 ? 1 : 2;
    const Exact::FT x = v->point().x(), y = v->point().y();
    const Exact::FT z = origin_[dropped_] - (normal_[i] * (x - origin_[i]) + normal_[j] * (y - origin_[j])) / normal_[dropped_];
    switch (dropped_) {
      case 0: return {z, x, y};
      case 1: return {x, z, y};
      default: return {x, y, z};
    }
  }

  Point_3 origin_;
  Exact::Vector_3 normal_;
  int dropped_ = 0;
  std::vector<std::array<Point_2, 3>> triangles_;
  std::vector<bool> runs_forward_;
  Cdt cdt_;
};

/// Moves the vertices of all that meets to the grid: what is computed is rounded to points of it. That may make others meet, which have to be known before
/// anything is divided: an edge that is divided in one of its triangles only is a crack as wide as rounding is. \return all that meets then
Pairs onto_grid(Soup& soup, Pairs pairs, Grid& grid, double& largest_move) {
  for (;;) {
    const std::size_t on_grid = grid.moved_vertices();
    std::map<Index, Index> moved;
    for (const auto& [s, t] : pairs)
      for (const Index u : {s, t})
        for (const Index v : soup.triangles[u].corners) moved[v] = grid.move_vertex(v, largest_move);
    if (grid.moved_vertices() == on_grid) return pairs;
    for (Triangle& t : soup.triangles)
      for (Index& v : t.corners)
        if (const auto it = moved.find(v); it != moved.end()) v = it->second;
    close_flat_triangles(soup, largest_move);
    pairs = meeting_pairs(soup);
  }
}

/// Divides triangles where they meet. \pre `pairs` are all that meet, on the grid, and no triangle is degenerate \return the position of the first piece
std::size_t divide(Soup& soup, const Pairs& pairs, Grid& grid) {
  std::vector<bool> is_met(soup.triangles.size(), false);
  for (const auto& [s, t] : pairs) is_met[s] = is_met[t] = true;

  const auto point = [&](Index v) { return Point_3(soup.points[v].x, soup.points[v].y, soup.points[v].z); };
  const auto corners = [&](Index t) {
    const Corners& c = soup.triangles[t].corners;
    return std::array<Point_3, 3>{point(c[0]), point(c[1]), point(c[2])};
  };
  std::vector<std::vector<Point_3>> points(soup.triangles.size());
  std::vector<std::vector<std::pair<Point_3, Point_3>>> segments(soup.triangles.size());
  boost::disjoint_sets_with_storage<> coplanar(soup.triangles.size());
  for (const auto& [s, t] : pairs) {
    const auto a = corners(s), b = corners(t);
    const CGAL::Object common = CGAL::intersection(Exact::Triangle_3(a[0], a[1], a[2]), Exact::Triangle_3(b[0], b[1], b[2]));
    if (const auto* p = CGAL::object_cast<Point_3>(&common)) {
      points[s].push_back(*p);
      points[t].push_back(*p);
    } else if (const auto* segment = CGAL::object_cast<Exact::Segment_3>(&common)) {
      segments[s].emplace_back(segment->source(), segment->target());
      segments[t].emplace_back(segment->source(), segment->target());
    } else if (!common.is_empty()) {
      coplanar.union_set(s, t);  // their edges divide each other
    }
  }
  std::map<std::size_t, std::vector<Index>> planes;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    if (is_met[t]) planes[coplanar.find_set(t)].push_back(t);

  std::vector<Triangle> result;
  for (Index t = 0; t < soup.triangles.size(); ++t)
    if (!is_met[t]) result.push_back(soup.triangles[t]);
  const std::size_t first = result.size();
  std::vector<const std::vector<Index>*> in_order;
  for (const auto& [root, members] : planes) in_order.push_back(&members);
  std::ranges::sort(in_order, {}, [](const std::vector<Index>* m) { return m->front(); });
  for (const std::vector<Index>* members : in_order) {
    Plane_arrangement plane(corners(members->front()));
    // The last part has what several parts have.
    std::vector<Index> list(members->rbegin(), members->rend());
    std::ranges::stable_sort(list, std::greater{}, [&](Index t) { return soup.triangles[t].part; });
    for (const Index t : list) plane.add_triangle(corners(t));
    for (const Index t : list) {
      for (const Point_3& p : points[t]) plane.add_point(p);
      for (const auto& [a, b] : segments[t]) plane.add_segment(a, b);
    }
    plane.for_each_face([&](const std::array<Point_3, 3>& c, const std::vector<std::size_t>& covering) {
      std::size_t which = covering.front();
      int times = 1;
      if (soup.is_cycle) {
        times = 0;
        for (const std::size_t i : covering) times += plane.runs_forward(i) ? soup.triangles[list[i]].times : -soup.triangles[list[i]].times;
        if (times == 0) return;
        which = *std::ranges::find_if(covering, [&](std::size_t i) { return plane.runs_forward(i) == (times > 0); });
      }
      Triangle piece = soup.triangles[list[which]];
      piece.corners = {grid.add(c[0]), grid.add(c[1]), grid.add(c[2])};
      if (!plane.runs_forward(which)) std::swap(piece.corners[1], piece.corners[2]);
      piece.times = std::abs(times);
      result.push_back(piece);
    });
  }
  soup.triangles = std::move(result);
  return first;
}

/// Not for several parts, whose triangles may be in one place.
bool is_cycle(const Soup& soup) {
  const Triangle_edges all(soup.triangles);
  bool is_closed = std::ranges::all_of(soup.triangles, [&](const Triangle& t) { return t.part == soup.triangles[0].part; });
  all.for_each([&](std::size_t i, std::size_t j) {
    int forward = 0;
    for (std::size_t k = i; k < j; ++k) forward += all.edges[k].runs_forward ? 1 : -1;
    is_closed &= forward == 0;
  });
  return is_closed;
}

}  // namespace

Pairs meeting_pairs(const Soup& soup) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;
  std::vector<Box> boxes;
  for (Index t = 0; t < soup.triangles.size(); ++t) {
    const Corners& c = soup.triangles[t].corners;
    boxes.push_back({to_work_point(soup.points[c[0]]).bbox() + to_work_point(soup.points[c[1]]).bbox() + to_work_point(soup.points[c[2]]).bbox(), t});
  }
  Pairs pairs = domain_detail::Box_slabs(std::move(boxes)).pairs<Pairs::value_type>([&](const Box& a, const Box& b, Pairs& list) {
    const Index s = std::min(a.info(), b.info()), t = std::max(a.info(), b.info());
    if (domain_detail::triangles_meet(soup.triangles[s].corners, soup.triangles[t].corners, soup.points)) list.emplace_back(s, t);
  });
  std::ranges::sort(pairs);
  return pairs;
}

Soup arrangement(const Soup& soup, Pairs pairs, double tolerance, Repair_report& report) {
  Soup result = soup;
  result.is_cycle = is_cycle(soup);
  const std::size_t most_pairs = most_growth * pairs.size();
  double extent = 0;
  for (const Triangle& t : result.triangles)
    for (const Index v : t.corners)
      for (const double x : {result.points[v].x, result.points[v].y, result.points[v].z}) extent = std::max(extent, std::abs(x));
  const int exponent = std::ilogb(extent) + 1;
  const double step = std::ldexp(1.0, exponent - grid_bits);
  const double highest = std::max(tolerance, step);
  double low = std::min(steps_apart * step, highest);
  for (int round = 0; round < most_rounds && !pairs.empty() && pairs.size() <= most_pairs; ++round) {
    Grid grid(result.points, step);
    pairs = onto_grid(result, std::move(pairs), grid, report.largest_move);
    const std::size_t first = divide(result, pairs, grid);
    close_flat_triangles(result, report.largest_move, first, low);
    pairs = meeting_pairs(result);
    low = std::min(higher_each_round * low, highest);
  }
  if (!pairs.empty()) {
    const auto [s, t] = pairs.front();
    const Index f = result.triangles[s].facet, g = result.triangles[t].facet;
    throw Input_error({{Input_problem::Kind::self_intersection,
                        "facets " + std::to_string(f) + " and " + std::to_string(g) + " intersect, and " + std::to_string(pairs.size()) +
                            " intersections come back when they are rounded: a larger tolerance may help",
                        {f, g}}});
  }
  return result;
}

}  // namespace pgdr::repair_detail
