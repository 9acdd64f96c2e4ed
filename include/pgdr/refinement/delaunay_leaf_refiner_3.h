// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_DELAUNAY_LEAF_REFINER_3_H
#define PGDR_REFINEMENT_DELAUNAY_LEAF_REFINER_3_H

#include <algorithm>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/conforming/feature_refiner_3.h>
#include <pgdr/conforming/flat_cell_3.h>
#include <pgdr/conforming/subdomains_3.h>
#include <pgdr/refinement/leaf_refiner.h>
#include <pgdr/refinement/quality_criteria_3.h>
#include <pgdr/refinement/tetrahedron_ball.h>

namespace pgdr {

/// Sequential Delaunay refinement of one leaf: splits poor tetrahedra at their circumcenters until none is left
/// (Shewchuk, *Tetrahedral mesh generation by Delaunay refinement*, 1998). A model of `LeafRefiner`.
///
/// A circumcenter that encroaches a subsegment or subfacet, or that would delete one, is not inserted; the feature
/// is split instead. A tetrahedron is given up only next to a small input angle, when every such split would make
/// an edge too short (`shortest_allowed`).
template <class Tr, class Criteria>
class Delaunay_leaf_refiner_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Point = typename Tr::Point;
  using Features = Feature_refiner_3<Tr>;
  using Cell_id = typename Features::Cell_id;
  using Complex = Constraint_complex_3<Tr>;

  struct Worklist {
    std::deque<Cell_id> poor;
    std::vector<Cell_id> forwarded;
    bool empty() const { return poor.empty(); }
    std::size_t size() const { return poor.size(); }
  };

  /// `should_stop` is asked before every insertion. When it says so, facets that are torn at that moment are mended
  /// first, which may take a few points more.
  Delaunay_leaf_refiner_3(Tr& tr, Features& features, const Criteria& criteria, std::function<bool()> should_stop)
      : tr_(tr), features_(features), criteria_(criteria), should_stop_(std::move(should_stop)) {
    measure_hull();
  }

  /// Puts a tetrahedron on the worklist if it is poor; flat ones on a facet become requests to split that facet.
  void classify(Cell_handle c, Worklist& worklist) {
    if (c->subdomain() == 0) return;
    if (c->has_subfacet() && is_handed_over(c)) return;
    if (criteria_.is_poor(tetrahedron_ball(points(c)), c->subdomain()))
      worklist.poor.push_back({c, c->generation()});
  }

  Drain_result drain(const Leaf_region& region, Worklist& worklist) {
    Drain_result result;
    const std::size_t on_features = features_.inserted();
    while (true) {
      if (should_stop_()) {
        result.stopped = true;
        features_.close(10000);
        mend_subdomains();
        break;
      }
      if (!features_.is_idle()) {
        features_.step();
        continue;
      }
      // Only now, with every facet whole, is it known again on which side of it a new tetrahedron is.
      mend_subdomains();
      if (!features_.fresh_cells().empty()) {
        take_fresh_cells(worklist);
        continue;
      }
      if (worklist.poor.empty()) break;
      prefetch(worklist.poor);
      const Cell_id id = worklist.poor.front();
      worklist.poor.pop_front();
      if (id.is_live() && id.cell->subdomain() != 0) refine(id, region, worklist, result);
    }
    result.inserted += features_.inserted() - on_features;
    return result;
  }

 private:
  /// The queue walks all over the mesh; asking for what comes next hides most of the way to memory.
  static void prefetch(const std::deque<Cell_id>& queue) {
    constexpr std::size_t far = 16, near = 8;
    if (queue.size() <= far) return;
    const char* next = reinterpret_cast<const char*>(&*queue[far].cell);
    __builtin_prefetch(next);
    __builtin_prefetch(next + 64);
    if (!queue[near].is_live()) return;
    for (int i = 0; i < 4; ++i) {
      __builtin_prefetch(&*queue[near].cell->vertex(i));
      __builtin_prefetch(&*queue[near].cell->neighbor(i));
      __builtin_prefetch(reinterpret_cast<const char*>(&*queue[near].cell->neighbor(i)) + 64);
    }
  }

  void refine(const Cell_id& id, const Leaf_region& region, Worklist& worklist, Drain_result& result) {
    const Tetrahedron_points corners = points(id.cell);
    const Tetrahedron_ball ball = tetrahedron_ball(corners);
    const Vec_3 center = into_hull(ball.center, corners);
    if (!region.contains(center)) {
      worklist.forwarded.push_back(id);
      ++result.forwarded;
      return;
    }
    const Point p(center.x, center.y, center.z);
    Cavity_3<Tr>& cavity = features_.cavity();
    if (!cavity.find(p, id.cell) && !find_with_exact_center(id.cell, corners)) {
      ++result.refused;
      return;
    }
    features_.features().gather(features_.complex(), cavity);
    if (collect_obstacles(p)) {
      cavity.abandon();
      if (split_obstacle(id.cell, ball, corners)) {
        if (id.is_live()) worklist.poor.push_back(id);
      } else {
        ++result.refused;
      }
      return;
    }
    const Vertex_handle v = cavity.commit(p);
    v->set_feature(3, Tr::Vertex::none);
    v->set_insertion_radius(std::sqrt(ball.squared_radius));
    ++result.inserted;
    for (const Cell_handle c : cavity.star()) classify(c, worklist);
  }

  static Tetrahedron_points points(Cell_handle c) {
    return {position(c->vertex(0)), position(c->vertex(1)), position(c->vertex(2)), position(c->vertex(3))};
  }

  void measure_hull() {
    bool first = true;
    for (auto v = tr_.finite_vertices_begin(); v != tr_.finite_vertices_end(); ++v) {
      const Vec_3 p = position(Vertex_handle(v));
      for (int i = 0; i < 3; ++i) {
        hull_.lower[i] = first ? p[i] : std::min(hull_.lower[i], p[i]);
        hull_.upper[i] = first ? p[i] : std::max(hull_.upper[i], p[i]);
      }
      first = false;
    }
  }

  /// The Steiner point of a ball whose center is outside the hull: where the way from the tetrahedron to the center
  /// leaves it. Still inside the ball, which is convex.
  Vec_3 into_hull(const Vec_3& center, const Tetrahedron_points& corners) const {
    const Vec_3 from = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    double t = 1;
    for (int i = 0; i < 3; ++i) {
      if (center[i] < hull_.lower[i]) t = std::min(t, (hull_.lower[i] - from[i]) / (center[i] - from[i]));
      if (center[i] > hull_.upper[i]) t = std::min(t, (hull_.upper[i] - from[i]) / (center[i] - from[i]));
    }
    if (t == 1) return center;
    Vec_3 p = from + t * (center - from);
    for (int i = 0; i < 3; ++i) p[i] = std::clamp(p[i], hull_.lower[i], hull_.upper[i]);
    return p;
  }

  /// Rounding can put the center of a flat tetrahedron outside of its own ball.
  bool find_with_exact_center(Cell_handle c, const Tetrahedron_points& corners) {
    const Vec_3 center = into_hull(exact_tetrahedron_ball(corners).center, corners);
    return features_.cavity().find(Point(center.x, center.y, center.z), c);
  }

  /// Notes the features that keep p out; subsegments first, and among subfacets first the one below p.
  bool collect_obstacles(const Point& p) {
    Complex& complex = features_.complex();
    segments_in_the_way_.clear();
    facets_in_the_way_.clear();
    for (const auto& f : features_.features().subsegments())
      if (f.deleted || is_encroached(complex.subsegment(f.slot), p))
        segments_in_the_way_.push_back(complex.subsegment_id(f.slot));
    for (const auto& f : features_.features().subfacets()) {
      const auto& t = complex.subfacet(f.slot);
      if (!f.deleted && !is_encroached(t, p)) continue;
      facets_in_the_way_.push_back(complex.subfacet_id(f.slot));
      if (facets_in_the_way_.size() > 1 && is_below(t, p))
        std::swap(facets_in_the_way_.front(), facets_in_the_way_.back());
    }
    return !segments_in_the_way_.empty() || !facets_in_the_way_.empty();
  }

  /// Whether p's projection onto the facet falls into the subfacet.
  bool is_below(const typename Complex::Subfacet& t, const Point& p) const {
    const Vec_3 q = features_.complex().plane(t.facet).project(to_vec(p));
    const Point foot(q.x, q.y, q.z);
    for (std::size_t i = 0; i < 3; ++i)
      if (features_.complex().orientation(t.facet, t.vertices[i]->point(), t.vertices[(i + 1) % 3]->point(), foot) ==
          CGAL::NEGATIVE)
        return false;
    return true;
  }

  /// The length that a split on behalf of a tetrahedron may not go below next to small angles: half its shortest
  /// edge (all of it would do in theory, and leaves more tetrahedra poor), but between vertices on the shell of one
  /// acute corner the radius of the shell. A tetrahedron that is only too large may also halve its circumradius.
  double shortest_allowed(Cell_handle c, const Tetrahedron_ball& ball, const Tetrahedron_points& corners) const {
    double allowed = 0.5 * std::sqrt(ball.squared_shortest);
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        const double d2 = squared_distance(corners[static_cast<std::size_t>(i)], corners[static_cast<std::size_t>(j)]);
        if (d2 > ball.squared_shortest) continue;
        const double shell = std::min(c->vertex(i)->insertion_radius(), c->vertex(j)->insertion_radius());
        if (shell * shell > d2) allowed = std::max(allowed, shell);
      }
    return criteria_.is_over_ratio(ball) ? allowed : std::min(allowed, 0.5 * std::sqrt(ball.squared_radius));
  }

  bool split_obstacle(Cell_handle c, const Tetrahedron_ball& ball, const Tetrahedron_points& corners) {
    const Split_guard guard{shortest_allowed(c, ball, corners), corners, 4, 4 * std::sqrt(ball.squared_radius)};
    for (const Piece_id& s : segments_in_the_way_)
      if (features_.split_subsegment(s.slot, Split_reason::encroached, guard) == Split_outcome::inserted) return true;
    if (!segments_in_the_way_.empty()) return false;
    for (const Piece_id& t : facets_in_the_way_)
      if (features_.split_subfacet(t.slot, Split_reason::encroached, guard) == Split_outcome::inserted) return true;
    return false;
  }

  void take_fresh_cells(Worklist& worklist) {
    for (const Cell_id& id : features_.fresh_cells())
      if (id.is_live()) classify(id.cell, worklist);
    features_.fresh_cells().clear();
  }

  void mend_subdomains() {
    if (features_.unlabelled_cells().empty()) return;
    Subdomain_labeler_3<Tr>(tr_, features_.complex()).mend(features_.unlabelled_cells());
    features_.note_mended();
  }

  /// Gives a flat tetrahedron to the outside if that is what lies beyond its facet; else a point on the facet has to
  /// remove it.
  bool is_handed_over(Cell_handle c) {
    Complex& complex = features_.complex();
    std::vector<Cell_handle> flat{c};
    while (!flat.empty()) {
      const Cell_handle d = flat.back();
      flat.pop_back();
      const std::uint32_t t = subfacet_of_flat_cell(complex, d);
      if (t == Complex::none) continue;
      if (!hand_to_outside(complex, d)) {
        features_.request_subfacet(t, Split_reason::flat, 0);
        continue;
      }
      for (int i = 0; i < 4; ++i)
        if (d->subfacet(i) != Complex::none && d->neighbor(i)->subdomain() != 0) flat.push_back(d->neighbor(i));
    }
    return c->subdomain() == 0;
  }

  Tr& tr_;
  Features& features_;
  const Criteria& criteria_;
  std::function<bool()> should_stop_;
  Leaf_region hull_;
  std::vector<Piece_id> segments_in_the_way_;
  std::vector<Piece_id> facets_in_the_way_;
};

}  // namespace pgdr

#endif
