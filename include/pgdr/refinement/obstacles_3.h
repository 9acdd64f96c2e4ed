// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_OBSTACLES_3_H
#define PGDR_REFINEMENT_OBSTACLES_3_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <pgdr/conforming/acute_neighborhood_3.h>
#include <pgdr/conforming/cavity_features_3.h>
#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/conforming/feature_request.h>
#include <pgdr/conforming/sheet_walk_3.h>
#include <pgdr/refinement/tetrahedron_ball.h>

namespace pgdr {

/// The features that keep a point out of the volume: those that it encroaches, and those that it would delete.
template <class Tr>
class Obstacles_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Point = typename Tr::Point;

  /// Looks through the features on the cavity of p. True if there is an obstacle.
  bool collect(const Complex& complex, const Cavity_features_3<Tr>& features, const Point& p) {
    subsegments_.clear();
    subfacets_.clear();
    for (const auto& f : features.subsegments())
      if (f.deleted || is_encroached(complex.subsegment(f.slot), p))
        subsegments_.push_back(complex.subsegment_id(f.slot));
    for (const auto& f : features.subfacets()) {
      const auto& t = complex.subfacet(f.slot);
      if (!f.deleted && !is_encroached(t, p)) continue;
      subfacets_.push_back(complex.subfacet_id(f.slot));
      if (subfacets_.size() > 1 && is_below(complex, t, p)) std::swap(subfacets_.front(), subfacets_.back());
    }
    return !subsegments_.empty() || !subfacets_.empty();
  }

  /// Takes one subsegment or subfacet for the only obstacle.
  void set_subsegment(const Complex& complex, std::uint32_t slot) {
    subfacets_.clear();
    subsegments_.assign(1, complex.subsegment_id(slot));
  }
  void set_subfacet(const Complex& complex, std::uint32_t slot) {
    subsegments_.clear();
    subfacets_.assign(1, complex.subfacet_id(slot));
  }

  /// Leaves out the subsegments, by slot, that do not satisfy a predicate. False if none is left.
  template <class Predicate>
  bool keep_subsegments(const Predicate& predicate) {
    std::erase_if(subsegments_, [&](const Piece_id& s) { return !predicate(s.slot); });
    return !subsegments_.empty();
  }

  /// What to split in the point's stead, in this order: only where there is no subsegment a subfacet, and among these
  /// first the one below the point (the guarantee's factor sqrt(2) needs it).
  bool are_subsegments() const { return !subsegments_.empty(); }
  const std::vector<Piece_id>& to_split() const { return are_subsegments() ? subsegments_ : subfacets_; }

 private:
  /// Whether p's projection onto the facet falls into the subfacet.
  static bool is_below(const Complex& complex, const typename Complex::Subfacet& t, const Point& p) {
    const Vec_3 q = complex.plane(t.facet).project(to_vec(p));
    return is_in_subfacet(complex, t, Point(q.x, q.y, q.z));
  }

  std::vector<Piece_id> subsegments_;
  std::vector<Piece_id> subfacets_;
};

/// What keeps a tetrahedron's splits from going on for ever next to small angles: a split on its behalf may not make
/// edges shorter than this there.
///
/// Half its shortest edge (all of it would do in theory, and leaves more tetrahedra poor), but between vertices on features
/// that meet at a small angle the smaller of their insertion radii: the edge is as short as the angle makes it, and splits
/// may go on towards the place where they meet. Where that is a vertex, pieces that do not touch it may be split down to half
/// of the edge after all: away from the vertex its length is bounded from below. That costs as many points as insertion radii
/// fit the edge more than once, so it is done up to a ratio of `most_points` only. A tetrahedron that is only too large may
/// also halve its circumradius.
template <class Cell_handle>
Split_guard split_guard(Cell_handle c, const Tetrahedron_ball& ball, const Tetrahedron_points& corners, bool is_over_ratio,
                        const Acute_neighborhood_3& acute) {
  constexpr double most_points = 8;
  Split_guard guard{.floor = 0.5 * std::sqrt(ball.squared_shortest), .where = corners, .count = 4,
                    .reach = 4 * std::sqrt(ball.squared_radius)};
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      const Vec_3 &p = corners[static_cast<std::size_t>(i)], &q = corners[static_cast<std::size_t>(j)];
      const double d2 = squared_distance(p, q);
      if (d2 > ball.squared_shortest) continue;
      const auto v = c->vertex(i), w = c->vertex(j);
      const double radius = std::min(v->insertion_radius(), w->insertion_radius());
      if (radius * radius <= d2) continue;
      guard.floor = std::max(guard.floor, radius);
      if (!acute.explains(v->in_dimension(), v->index(), p, w->in_dimension(), w->index(), q)) continue;
      guard.reach = std::numeric_limits<double>::infinity();  // it is next to the angle, however large
      const Feature_id a{v->in_dimension(), v->index()}, b{w->in_dimension(), w->index()};
      if (radius * radius > most_points * most_points * d2 || !acute.meet_at_vertices_only(a, b)) continue;
      guard.meeting = {a, b};
      guard.floor_apart = 0.5 * std::sqrt(d2);
    }
  if (!is_over_ratio) guard.floor = std::min(guard.floor, 0.5 * std::sqrt(ball.squared_radius));
  guard.floor_apart = std::min(guard.floor_apart, guard.floor);
  return guard;
}

}  // namespace pgdr

#endif
