// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/simplify/simplify.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include <CGAL/Bbox_3.h>

#include <pgdr/domain/make_domain_3.h>

#include "remove_vertices.h"
#include "triangle_complex.h"

namespace pgdr {

namespace simplify_detail {

/// Collapses short edges and removes low triangles.
///
/// How far the boundary is from the input is known by a map of the input onto it, piecewise linear, which no step leaves without a bound:
/// at a point with barycentric coordinates l_i it has moved by at most sum l_i D_i + F, with D_i of the corners (`change_`) and F of the
/// triangle (`Triangle::change`). A collapse of b into a moves points by l_b |ab| more, so that D_a = max(D_a, D_b + |ab|) will do; removing
/// a needle abv moves a point x of ab to some y, by h, and all else by less. F + h will do if the sum is no less at y than it was at x, since
/// it is linear in between: D_v becomes what it is at x, if that is more, and F takes the rest.
class Simplifier {
 public:
  using Triangle = Triangle_complex::Triangle;

  /// What has to stay: vertices, edges (sorted pairs, ascending), and what some steps would take away (as a `Candidate`), or
  /// all that touches some vertices.
  struct Fixed {
    std::vector<bool> vertices;
    std::vector<domain_detail::Index_pair> edges;
    std::set<Corners> steps;
    std::vector<bool> neighborhoods;
  };

  Simplifier(Triangle_complex& complex, const Fixed& fixed, double tolerance)
      : complex_(complex), fixed_(fixed), tolerance_(tolerance), change_(fixed.vertices.size(), 0), is_changed_(fixed.vertices.size(), true) {}

  /// The steps that were done, as `Fixed::steps`; `Triangle::step` counts them from 1.
  const std::vector<Corners>& steps() const { return steps_; }

  Simplification run() {
    Simplification done;
    // What was refused may be possible once its neighbors have changed. Every step takes a vertex away, or raises the lowest of the
    // triangles that it changes, so that there is a last one.
    for (std::size_t before = 0;; before = steps_.size()) {
      enqueue_near_changes();
      while (!queue_.empty()) {
        const Candidate c = queue_.top();
        queue_.pop();
        if (fixed_.steps.contains(c.corners)) continue;
        step_ = c.corners;
        if (c.is_edge())
          done.collapsed_edges += collapse(c.corners[0], c.corners[1]);
        else
          done.removed_needles += remove_needle(c.corners);
      }
      if (steps_.size() == before) break;
    }
    for (const Triangle& t : complex_.triangles())
      if (t.alive) done.largest_change = std::max(done.largest_change, change_of(t));
    return done;
  }

 private:
  static constexpr Index none = std::numeric_limits<Index>::max();

  /// An edge (third corner `none`) or a triangle, corners ascending, and how small it is.
  struct Candidate {
    double size;
    Corners corners;
    bool is_edge() const { return corners[2] == none; }
    friend auto operator<=>(const Candidate&, const Candidate&) = default;
  };

  void enqueue(Corners c) {
    std::ranges::sort(c);
    for (const auto& [a, b] : {std::pair{c[0], c[1]}, {c[0], c[2]}, {c[1], c[2]}})
      if (const double l = complex_.edge_length(a, b); l <= tolerance_) queue_.push({l, {a, b, none}});
    if (const double h = complex_.height(c); h <= tolerance_) queue_.push({h, c});
  }

  /// What a step depends on has common triangles with its corners, or meets its triangles in space; the latter alone is not looked for.
  void enqueue_near_changes() {
    const auto is_at = [](const std::vector<bool>& vertices, const Triangle& t) {
      return t.alive && std::ranges::any_of(t.corners, [&](Index v) { return vertices[v]; });
    };
    std::vector<bool> is_near(is_changed_.size(), false);
    for (const Triangle& t : complex_.triangles())
      if (is_at(is_changed_, t))
        for (const Index v : t.corners) is_near[v] = true;
    for (const Triangle& t : complex_.triangles())
      if (is_at(is_near, t)) enqueue(t.corners);
    is_changed_.assign(is_changed_.size(), false);
  }

  bool collapse(Index a, Index b) {
    if (fixed_.neighborhoods[a] || fixed_.neighborhoods[b] || !complex_.has_edge(a, b)) return false;
    // Where it matters which one stays, one of the two is refused; else the one at more triangles has more to say about the shape.
    if (complex_.at(a).size() < complex_.at(b).size()) std::swap(a, b);
    return collapse_into(a, b) || collapse_into(b, a);
  }

  /// Replaces vertex `gone` by `kept`.
  bool collapse_into(Index kept, Index gone) {
    if (fixed_.vertices[gone] || !keeps_topology(kept, gone)) return false;
    removed_.assign(complex_.at(gone).begin(), complex_.at(gone).end());
    made_.clear();
    double added = 0;
    for (const Index t : removed_) added = std::max(added, complex_.triangles()[t].change);
    for (const Index t : removed_) {
      Triangle m = complex_.triangles()[t];
      if (std::ranges::find(m.corners, kept) != m.corners.end()) continue;
      std::ranges::replace(m.corners, gone, kept);
      m.change = added;
      made_.push_back(m);
    }
    const double before = change_[kept];
    change_[kept] = std::max(before, change_[gone] + complex_.edge_length(kept, gone));
    if (is_within_tolerance(kept) && replace(true)) return true;
    change_[kept] = before;
    return false;
  }

  /// Whether the complex stays what it is if an edge is contracted: the link condition (Dey, Edelsbrunner, Guha, Nekhayev 1999) where
  /// every edge at `gone` has two triangles, or the edge is one of just two at `gone` that have another number of them.
  bool keeps_topology(Index kept, Index gone) const {
    const std::vector<Index> around = complex_.neighbors(gone);
    std::vector<std::size_t> odd;  // numbers of triangles
    for (const Index v : around)
      if (const std::size_t n = complex_.at_edge(gone, v).size(); n != 2) odd.push_back(n);
    const std::size_t at_edge = complex_.at_edge(kept, gone).size();
    if (!odd.empty() && (odd.size() != 2 || odd[0] != odd[1] || at_edge != odd[0])) return false;
    if (!is_connected(gone)) return false;
    std::size_t common = 0;
    for (const Index v : around) common += v != kept && complex_.has_edge(kept, v);
    if (common != at_edge) return false;
    for (const Index t : complex_.at(gone)) {
      Corners c = complex_.triangles()[t].corners;
      if (std::ranges::find(c, kept) != c.end()) continue;
      std::ranges::replace(c, gone, kept);
      if (complex_.has_triangle(c)) return false;
    }
    return true;
  }

  /// Whether one gets from each triangle at v to all others across edges at v.
  bool is_connected(Index v) const {
    const auto star = complex_.at(v);
    std::vector<Index> reached{star[0]};
    for (std::size_t next = 0; next < reached.size(); ++next)
      for (const Index w : complex_.triangles()[reached[next]].corners)
        if (w != v)
          for (const Index t : complex_.at_edge(v, w))
            if (std::ranges::find(reached, t) == reached.end()) reached.push_back(t);
    return reached.size() == star.size();
  }

  /// Takes a low triangle away: the others at its longest edge are divided at its third corner.
  bool remove_needle(const Corners& corners) {
    if (std::ranges::any_of(corners, [&](Index v) { return fixed_.neighborhoods[v]; })) return false;
    Index needle = none;
    for (const Index t : complex_.at(corners[0]))
      if (std::ranges::is_permutation(complex_.triangles()[t].corners, corners)) needle = t;
    if (needle == none) return false;
    const std::size_t i = complex_.apex(corners);
    const Index v = corners[i], a = corners[(i + 1) % 3], b = corners[(i + 2) % 3];
    if (std::ranges::binary_search(fixed_.edges, domain_detail::sorted_pair(a, b))) return false;
    removed_ = complex_.at_edge(a, b);
    made_.clear();
    double added = 0;
    for (const Index t : removed_) {
      const Triangle& old = complex_.triangles()[t];
      added = std::max(added, old.change);
      if (t == needle) continue;
      const Index w = third_corner(old.corners, a, b);
      if (complex_.has_edge(v, w)) return false;
      for (const Index end : {a, b}) {
        Triangle m = old;
        std::ranges::replace(m.corners, end, v);
        made_.push_back(m);
      }
    }
    // At the end of a sheet nothing takes its place.
    if (made_.empty() && (complex_.at_edge(a, v).size() < 2 || complex_.at_edge(b, v).size() < 2)) return false;
    const Index w = removed_.size() == 2 ? third_corner(made_[0].corners, b, v) : v;
    const Move move = w != v ? flip(a, b, v, w) : onto_vertex(a, b, v);
    const double before = change_[v], at_source = (1 - move.source) * change_[a] + move.source * change_[b];
    change_[v] = std::max(before, at_source);
    const double at_target = (1 - move.target) * change_[v] + move.target * change_[w];
    for (Triangle& m : made_) m.change = added + move.distance + std::max(0.0, at_source - at_target);
    if (is_within_tolerance(v) && replace(false)) return true;
    change_[v] = before;
    return false;
  }

  static Index third_corner(const Corners& c, Index a, Index b) {
    return *std::ranges::find_if(c, [&](Index w) { return w != a && w != b; });
  }

  /// Of a point of an edge ab to one of an edge vw; both as parts of their edges, from a and from v.
  struct Move {
    double distance, source, target;
  };

  /// From triangles abv, abw to vwa, vwb. Where the lines of the edges are closest within both, these points move onto each other, and all else less;
  /// else ab moves to v.
  Move flip(Index a, Index b, Index v, Index w) const {
    const Vec_3 &p = complex_.point(a), &q = complex_.point(v);
    const Vec_3 d = complex_.point(b) - p, e = complex_.point(w) - q, n = cross(d, e), between = q - p;
    const double nn = squared_length(n);
    if (nn > 0) {
      const double s = dot(cross(between, e), n) / nn, t = dot(cross(between, d), n) / nn;
      if (s >= 0 && s <= 1 && t >= 0 && t <= 1) return {std::abs(dot(between, n)) / std::sqrt(nn), s, t};
    }
    return onto_vertex(a, b, v);
  }

  /// What of ab is next to v, onto that.
  Move onto_vertex(Index a, Index b, Index v) const {
    const Vec_3 &p = complex_.point(a), d = complex_.point(b) - p;
    return {complex_.height({a, b, v}), std::clamp(dot(complex_.point(v) - p, d) / squared_length(d), 0.0, 1.0), 0};
  }

  double change_of(const Triangle& t) const {
    return t.change + std::max({change_[t.corners[0]], change_[t.corners[1]], change_[t.corners[2]]});
  }

  /// Whether that holds for what is made, and for all else at a vertex.
  bool is_within_tolerance(Index v) const {
    return std::ranges::all_of(made_, [&](const Triangle& t) { return change_of(t) <= tolerance_; }) &&
           std::ranges::all_of(complex_.at(v), [&](Index t) { return change_of(complex_.triangles()[t]) <= tolerance_; });
  }

  /// Does the step that `removed_` and `made_` describe, if it may be done.
  bool replace(bool takes_vertex) {
    const auto lowest = [&](const auto& list, const auto& corners) {
      double low = std::numeric_limits<double>::infinity();
      for (const auto& x : list) low = std::min(low, complex_.height(corners(x)));
      return low;
    };
    const double before = lowest(removed_, [&](Index t) { return complex_.triangles()[t].corners; });
    const double after = lowest(made_, [](const Triangle& t) { return t.corners; });
    if (takes_vertex ? after < before : !(after > before)) return false;
    if (complex_.would_meet(made_, removed_) || sharpens()) return false;
    steps_.push_back(step_);
    for (Triangle& t : made_) t.step = static_cast<Index>(steps_.size());
    for (const Index t : removed_)
      for (const Index v : complex_.triangles()[t].corners) is_changed_[v] = true;
    complex_.replace(removed_, made_);
    for (const Triangle& t : made_) enqueue(t.corners);
    return true;
  }

  /// Whether that step makes a dihedral angle that is small, and smaller than what was there.
  bool sharpens() const {
    constexpr double limit = 0.5;  // of 60 degrees: above, refinement has no trouble
    const double after = complex_.sharpest_cosine(made_, removed_);
    if (after <= limit) return false;
    std::vector<Triangle> before;
    for (const Index t : removed_) before.push_back(complex_.triangles()[t]);
    return !(after <= complex_.sharpest_cosine(before, removed_));
  }

  Triangle_complex& complex_;
  const Fixed& fixed_;
  double tolerance_;
  std::vector<double> change_;  ///< of each vertex
  std::vector<bool> is_changed_;  ///< vertices whose triangles are others than when all was enqueued last
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
  Corners step_{};  ///< that is being tried
  std::vector<Corners> steps_;
  std::vector<Index> removed_;
  std::vector<Triangle> made_;
};

}  // namespace simplify_detail

double bounding_diagonal(const Plc& plc) {
  if (plc.vertices.empty()) return 0;
  const CGAL::Bbox_3 box = CGAL::bbox_3(plc.vertices.begin(), plc.vertices.end());
  return unit_of(plc) * length(Vec_3{box.xmax(), box.ymax(), box.zmax()} - Vec_3{box.xmin(), box.ymin(), box.zmin()});
}

Plc simplify(const Plc& plc, double tolerance, Simplification* done, std::optional<int> most_rounds) {
  using namespace simplify_detail;
  Simplification ignored;
  Simplification& report = done ? *done : ignored;
  report = {};
  if (!(tolerance > 0) || !domain_detail::unusable_input(plc).empty()) return plc;
  if (exponent_for(plc) != 0) return simplify(normalized(plc), tolerance, done, most_rounds);
  tolerance /= unit_of(plc);

  std::vector<Vec_3> points;
  points.reserve(plc.vertices.size());
  for (const auto& p : plc.vertices) points.push_back(to_vec(p));
  const std::vector<Index> first = domain_detail::first_equal_vertex(points, std::vector<char>(points.size(), 0));

  Simplifier::Fixed fixed{std::vector<bool>(points.size(), false), {}, {}, std::vector<bool>(points.size(), false)};
  std::vector<bool> is_used(points.size(), false);
  const auto fix_edge = [&](Index a, Index b) {
    fixed.edges.push_back(domain_detail::sorted_pair(first[a], first[b]));
    fixed.vertices[first[a]] = fixed.vertices[first[b]] = true;
  };
  for (const Plc_segment& s : plc.segments) fix_edge(s.source, s.target);
  std::vector<Triangle_complex::Triangle> triangles;
  std::vector<bool> is_triangle(plc.facets.size(), false);
  for (Index f = 0; f < plc.facets.size(); ++f) {
    const auto& polygons = plc.facets[f].polygons;
    if (polygons.size() == 1 && polygons[0].size() == 3) {
      const Corners c{first[polygons[0][0]], first[polygons[0][1]], first[polygons[0][2]]};
      if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) {
        is_triangle[f] = true;
        for (const Index v : c) is_used[v] = true;
        triangles.push_back({.corners = c, .facet = f});
        continue;
      }
    }
    for (const auto& polygon : polygons)
      for (std::size_t i = 0; i < polygon.size(); ++i) fix_edge(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  domain_detail::sort_unique(fixed.edges);

  // A strip that is closed at one of its ends only is worse than one that is open, so what leaves a triangle low is undone: done again
  // without that step, and after a while without all that touches the triangle.
  // After 16, spheres full of needles would keep nearly all of them; 41 is the most that 30 of these take.
  constexpr int patient_rounds = 64;
  // Of the tolerance: how low. With 1, bundles of needles stay since a step in them leaves something a little too low, and have no end
  // (table in docs/robustness.md).
  constexpr double undone_below = 0.25;
  const Triangle_complex input(std::move(points), std::move(triangles));
  Triangle_complex complex = input;
  for (int round = 0;; ++round) {
    Simplifier simplifier(complex, fixed, tolerance);
    report = simplifier.run();
    bool is_complete = true;
    for (const auto& t : complex.triangles()) {
      if (!t.alive || t.step == 0 || complex.height(t.corners) > undone_below * tolerance) continue;
      is_complete = false;
      fixed.steps.insert(simplifier.steps()[t.step - 1]);
      if (round > patient_rounds)
        for (const Index v : t.corners) fixed.neighborhoods[v] = true;
    }
    if (is_complete) break;
    if (most_rounds && round >= *most_rounds) {
      report = {};
      return plc;
    }
    complex = input;
  }
  report.largest_change *= unit_of(plc);
  if (report.is_none()) return plc;

  Plc result = plc;
  std::vector<bool> is_left(plc.vertices.size(), false);
  for (const auto& t : complex.triangles())
    if (t.alive)
      for (const Index v : t.corners) is_left[v] = true;
  std::vector<bool> goes(plc.vertices.size());
  for (Index v = 0; v < plc.vertices.size(); ++v) goes[v] = first[v] != v || (is_used[v] && !is_left[v] && !fixed.vertices[v]);
  result.facets.clear();
  std::vector<std::vector<Corners>> of_facet(plc.facets.size());
  for (const auto& t : complex.triangles())
    if (t.alive) of_facet[t.facet].push_back(t.corners);
  for (Index f = 0; f < plc.facets.size(); ++f) {
    if (!is_triangle[f]) {
      result.facets.push_back(plc.facets[f]);
      for (auto& polygon : result.facets.back().polygons)
        for (Index& v : polygon) v = first[v];
    }
    for (const Corners& c : of_facet[f]) {
      Plc_facet<Default_kernel> facet;
      facet.polygons = {{c[0], c[1], c[2]}};
      facet.marker = plc.facets[f].marker;
      facet.group = plc.facets[f].group;
      result.facets.push_back(std::move(facet));
    }
  }
  for (Plc_segment& s : result.segments) {
    s.source = first[s.source];
    s.target = first[s.target];
  }
  remove_vertices(result, goes);
  report.facets = result.facets.size();
  return result;
}

}  // namespace pgdr
