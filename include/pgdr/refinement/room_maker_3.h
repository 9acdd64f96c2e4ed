// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_ROOM_MAKER_3_H
#define PGDR_REFINEMENT_ROOM_MAKER_3_H

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <pgdr/acute/split_guard_3.h>
#include <pgdr/conforming/feature_refiner_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/refinement/cell_classifier_3.h>
#include <pgdr/refinement/leaf_session_3.h>
#include <pgdr/refinement/steiner_point_3.h>

namespace pgdr {

/// Splits the features that are in the way of a Steiner point, or tells that none of them may be.
template <class Tr, class Criteria>
class Room_maker_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Session = Leaf_session_3<Tr>;
  using Attempt = Steiner_attempt_3<Tr>;

  Room_maker_3(const Complex& complex, const Acute_neighborhood_3& acute, const Criteria& criteria, double min_edge_length)
      : complex_(complex), acute_(acute), criteria_(criteria), min_edge_length_(min_edge_length) {}

  /// Splits an obstacle (`Session::obstacles`) for a tetrahedron's sake: with the floor of its guard everywhere if one lets itself be split like that, else,
  /// away from small angles, without. False if no obstacle is left.
  bool make_room(Session& s, Attempt& t) const {
    Split_guard guard = split_guard(t.id.cell, t.ball, t.corners, size_over(t), acute_);
    if (t.is_outside()) guard.size = 0;
    guard.is_strict = t.tried.is_strict;
    if (splits_obstacle(s, t, guard)) return true;
    if (!t.tried.is_strict || guard.is_near(acute_)) return false;
    t.tried.is_strict = guard.is_strict = false;
    t.tried.refused.clear();
    return splits_obstacle(s, t, guard);
  }

  /// Leaves a tetrahedron as it is.
  void give_up(Session& s, const Attempt& t) const {
    const float m = radius_above(enclosing_radius(t.corners));
    s.list().note_refused(t.at, {t.id.cell, t.id.generation, m});
    ++s.result.refused;
    const bool met_minimum = s.features().has_met_minimum();
    if (t.is_outside()) return;
    const bool limited = is_limited(t, met_minimum);
    t.id.cell->set_state(limited ? Cell_state::limited : Cell_state::exempt);
    s.result.limited += limited;
  }

  /// To whom the Steiner point belongs.
  static void hand_on(Session& s, const Attempt& t) { s.send(t.at, Session::Kind::poor, t.id); }

 private:
  using Features = typename Session::Features;
  using Errand = typename Session::Worklist::Errand;

  /// The bound of size that a tetrahedron is over, if it is; outside, where the octree wants it smaller, its radius, unless the ratio does as well.
  std::optional<double> size_over(const Attempt& t) const {
    if (t.is_outside()) return criteria_.is_over_ratio(t.ball) ? std::nullopt : std::optional(std::sqrt(t.ball.squared_radius));
    const std::int32_t subdomain = t.id.cell->subdomain();
    return criteria_.is_over_size(t.ball, subdomain) ? std::optional(criteria_.size_bound(t.ball, subdomain)) : std::nullopt;
  }

  /// Splits the first obstacle that lets itself be split, but for those that are known not to; the tetrahedron has another try
  /// if it is still there. An obstacle whose split point lies elsewhere takes the tetrahedron along. Some are
  /// given up at the first refusal (`Split_guard::gives_up_at_once`): there is no room then, whatever becomes of the others. Trying
  /// the others all the same pays where an edge is so short that hardly anything may be split for its sake. False if no obstacle is left.
  bool splits_obstacle(Session& s, Attempt& t, const Split_guard& guard) const {
    Features& features = s.features();
    const bool segments = s.obstacles().are_subsegments();
    for (const Piece_id& piece : s.obstacles().to_split()) {
      const Obstacle_id obstacle{piece, segments};
      const bool is_known = std::ranges::find(t.tried.refused, obstacle) != t.tried.refused.end();
      const Split_guard of_piece = guard.for_piece(segments ? complex_.subsegment_radius(piece.slot) : complex_.subfacet_radius(piece.slot));
      const Split_outcome outcome = is_known   ? Split_outcome::refused
                                    : segments ? features.split_subsegment(piece.slot, Split_reason::encroached, of_piece)
                                               : features.split_subfacet(piece.slot, Split_reason::encroached, of_piece);
      if (outcome == Split_outcome::inserted) {
        if (t.id.is_live()) s.list().try_again(t.id, t.is_outside());
        return true;
      }
      if (outcome == Split_outcome::elsewhere) {
        features.outgoing().emplace_back(features.elsewhere().at, errand_for(t, of_piece, obstacle, features.elsewhere()));
        return true;
      }
      if (guard.gives_up_at_once()) {
        give_up(s, t);
        return true;
      }
      if (!is_known) t.tried.refused.push_back(obstacle);
      if (is_steep(t.ball)) break;
    }
    return false;
  }

  /// To split what is elsewhere, for the sake of a tetrahedron that `obstacle` is in the way of.
  static std::unique_ptr<Errand> errand_for(Attempt& t, const Split_guard& guard, const Obstacle_id& obstacle, const Split_elsewhere& split) {
    auto errand = std::make_unique<Errand>();
    errand->piece = split.piece;
    errand->is_subsegment = split.is_subsegment;
    errand->guard = guard;
    errand->client = Errand::Client::tetrahedron;
    errand->cell = t.id;
    errand->home = t.at;
    errand->obstacle = obstacle;
    errand->refused = std::move(t.tried.refused);
    return errand;
  }

  /// Whether it is the minimum edge length that a tetrahedron is given up for, and no small angle: because that was noticed, or, since of
  /// an errand only the refusal comes back, because it is as small as one next to such pieces (docs/theory.md, section 11).
  bool is_limited(const Attempt& t, bool met_minimum) const {
    if (!met_minimum && t.ball.squared_radius >= 4 * min_edge_length_ * min_edge_length_) return false;
    return !acute_.contains(t.at, 4 * std::sqrt(t.ball.squared_radius));
  }

  const Complex& complex_;
  const Acute_neighborhood_3& acute_;
  const Criteria& criteria_;
  double min_edge_length_;
};

}  // namespace pgdr

#endif
