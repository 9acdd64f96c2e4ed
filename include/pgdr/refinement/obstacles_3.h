// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_OBSTACLES_3_H
#define PGDR_REFINEMENT_OBSTACLES_3_H

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <pgdr/conforming/cavity_features_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/conforming/sheet_walk_3.h>
#include <pgdr/domain/vec_3.h>

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
    is_encroaching_ = false;
    for (const auto& f : features.subsegments())
      if (f.deleted || is_encroached(complex.subsegment(f.slot), p))
        subsegments_.push_back(complex.subsegment_id(f.slot));
    for (const auto& f : features.subfacets()) {
      const auto& t = complex.subfacet(f.slot);
      const bool encroached = is_encroached(t, p);
      if (!f.deleted && !encroached) continue;
      is_encroaching_ |= encroached;
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

  /// Whether all of them are subfacets that the point would delete without encroaching one. \pre they were collected, not set
  bool are_deleted_only() const { return subsegments_.empty() && !is_encroaching_; }

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
  bool is_encroaching_ = false;
};

}  // namespace pgdr

#endif
