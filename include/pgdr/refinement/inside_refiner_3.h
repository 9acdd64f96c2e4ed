// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_INSIDE_REFINER_3_H
#define PGDR_REFINEMENT_INSIDE_REFINER_3_H

#include <cstdint>
#include <optional>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/acute/split_guard_3.h>
#include <pgdr/acute/split_spacing_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/refinement/cell_classifier_3.h>
#include <pgdr/refinement/features_in_the_way_3.h>
#include <pgdr/refinement/insert_steiner_point_3.h>
#include <pgdr/refinement/leaf_session_3.h>
#include <pgdr/refinement/point_placement.h>
#include <pgdr/refinement/room_maker_3.h>
#include <pgdr/refinement/separating_subfacet_3.h>
#include <pgdr/refinement/steiner_point_3.h>

namespace pgdr {

/// Refines tetrahedra of the domain: a Steiner point that encroaches a subsegment or subfacet, or that would delete one, is not inserted, and
/// the feature is split instead.
template <class Tr, class Criteria, class Placement>
class Inside_refiner_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Point = typename Tr::Point;
  using Complex = Constraint_complex_3<Tr>;
  using Session = Leaf_session_3<Tr>;
  using Attempt = Steiner_attempt_3<Tr>;

  Inside_refiner_3(const Tr& tr, Complex& complex, const Acute_neighborhood_3& acute, const Criteria& criteria,
                   const Steiner_points_3<Tr, Criteria, Placement>& points, const Room_maker_3<Tr, Criteria>& room,
                   Cell_classifier_3<Tr, Criteria>& classifier)
      : tr_(tr), complex_(complex), acute_(acute), criteria_(criteria), points_(points), room_(room), classifier_(classifier) {}

  /// Inserts the Steiner point of a tetrahedron, or splits what is in the way.
  void refine(Session& s, Attempt& t) const {
    const bool is_too_large = criteria_.is_over_size(t.ball, t.id.cell->subdomain());
    if (!is_too_large && is_hopeless(t.id.cell, t.ball, t.corners, criteria_.radius_edge_ratio(), acute_.narrow()))
      return room_.give_up(s, t);
    Trial trial = try_point(s, t);
    if (trial == Trial::no_room && criteria_.is_over_ratio(t.ball)) {
      // What may not be split can be far away, where large tetrahedra next to an angle have to stay. No vertex is closer to this
      // point than the shortest edge is long, either, and less is in its way.
      t.at = points_.hull().pull_in(Type_1_placement()(points_.poor_tetrahedron(t.ball, t.corners)), t.corners);
      trial = s.task().region.contains(t.at) ? try_point(s, t) : Trial::no_room;
    } else if (trial == Trial::clear) {
      if constexpr (ChoosingPlacement<Placement>) choose_point(s, t);
    }
    if (trial == Trial::clear && !keeps_minimum(s, t)) {
      // No point of the ball is farther from all vertices than its center.
      t.at = points_.hull().pull_in(t.ball.center, t.corners);
      trial = s.task().region.contains(t.at) ? try_point(s, t) : Trial::no_room;
      if (trial == Trial::clear && !keeps_minimum(s, t)) trial = Trial::no_room;
    }
    if (trial == Trial::clear) tr_.tell(insert_steiner_point(s, t, classifier_));
    if (trial == Trial::no_room) room_.give_up(s, t);
  }

 private:
  static constexpr std::size_t most_looks = 64;  ///< for a subsegment in the way, while a cavity is searched

  enum class Trial : std::uint8_t {
    clear,   ///< the Steiner point's cavity is found, and may be filled
    done,    ///< nothing is left to do for now
    no_room  ///< none of what is in the way may be split
  };

  /// Looks for the cavity of a Steiner point in the domain, and makes room if something is in the way.
  Trial try_point(Session& s, Attempt& t) const {
    Cavity_3<Tr>& cavity = s.cavity();
    s.star().clear();
    const Cell_handle c = t.id.cell;
    const auto hand_on_or_give_up = [&] {
      cavity.is_foreign() ? room_.hand_on(s, t) : room_.give_up(s, t);
      return Trial::done;
    };
    // What lies behind a facet need not be searched at all. The way to the point is within its cavity, so that where nothing of a
    // feature is there it need not be walked.
    std::optional<Separation> between;
    const auto is_behind = [&] {
      if (!between) between = first_subfacet_towards(tr_, cavity.territory(), c, t.point());
      return between->is_foreign || between->subfacet != Complex::none;
    };
    // Cavities can be large, and what is in the way is close, mostly, so that most of the search can be spared.
    std::size_t looks = 0;
    std::uint32_t in_the_way = Complex::none;
    const auto is_clear = [&](Cell_handle d) {
      ++looks;
      if (!d->has_subfacet() && d->subsegment_edges() == 0) return true;
      if (is_behind()) return false;
      in_the_way = subsegment_in_the_way(tr_, complex_, d, t.point(), looks <= most_looks);
      return in_the_way == Complex::none;
    };
    bool is_found = cavity.find(t.point(), c, is_clear);
    if (!is_found && is_behind()) {
      if (between->is_foreign) {
        room_.hand_on(s, t);
        return Trial::done;
      }
      s.obstacles().set_subfacet(complex_, between->subfacet);
      return room_.make_room(s, t) ? Trial::done : Trial::no_room;
    }
    if (!is_found && in_the_way != Complex::none) {
      s.obstacles().set_subsegment(complex_, in_the_way);
      if (room_.make_room(s, t)) return Trial::done;
      if (is_steep(t.ball)) return Trial::no_room;
      is_found = cavity.find(t.point(), c);
    }
    if (!is_found) {
      if (cavity.is_foreign()) return hand_on_or_give_up();
      // Rounding can put the center of a flat tetrahedron outside of its own ball.
      t.at = points_.hull().pull_in(exact_tetrahedron_ball(t.corners).center, t.corners);
      if (!s.task().region.contains(t.at) || !cavity.find(t.point(), c)) return hand_on_or_give_up();
    }
    if (!s.collect_obstacles(complex_, t.point()) || clears_flat_cells(s, t)) return Trial::clear;
    cavity.abandon();
    return room_.make_room(s, t) ? Trial::done : Trial::no_room;
  }

  /// Whether all that the point would delete are subfacets before flat cells, so that their sheets pass behind these from now on.
  bool clears_flat_cells(Session& s, const Attempt& t) const {
    if (!s.obstacles().are_deleted_only()) return false;
    if (!s.sheets().shift(complex_, tr_, s.cavity(), t.point())) return false;
    if (s.collect_obstacles(complex_, t.point())) {
      s.sheets().take_back(complex_);
      s.collect_obstacles(complex_, t.point());  // their versions are others now
      return false;
    }
    for (const auto& m : s.sheets().moved()) {
      // What was asked for these subfacets before is void.
      for (int i = 0; i < 4; ++i)
        if (m.cell->subfacet(i) != Complex::none) s.features().request_if_encroached(m.cell, i);
      // If another point is inserted after all, the cell may stay.
      s.features().fresh_cells().push_back({m.cell, m.cell->generation(), 0});
    }
    return true;
  }

  /// Where the first choice leaves an angle that is too small: takes the first other point that leaves none, if there is one. Its cavity
  /// is the one that is found then.
  /// \pre that of the first choice is found, and nothing is in its way
  void choose_point(Session& s, Attempt& t) const {
    const Poor_tetrahedron poor = points_.poor_tetrahedron(t.ball, t.corners);
    const double enough = points_.placement().enough(poor);
    if (enough >= 1) return;
    Cavity_3<Tr>& cavity = s.cavity();
    if (s.star().measure(cavity, t.at, criteria_, enough)) return;
    cavity.abandon();
    Point_choice choice;
    points_.placement().alternatives(poor, choice);
    for (const Vec_3& q : choice) {
      if (!s.task().region.contains(q) || !points_.hull().box().contains_closed(q) || s.star().is_as_bad(q, criteria_, enough)) continue;
      const Point at(q.x, q.y, q.z);
      if (!cavity.find(at, t.id.cell)) continue;
      if (!s.collect_obstacles(complex_, at) && s.star().measure(cavity, q, criteria_, enough)) {
        t.at = q;
        return;
      }
      cavity.abandon();
    }
    cavity.find(t.point(), t.id.cell);
    s.features().features().gather(complex_, cavity);
    s.star().clear();
  }

  /// Whether the Steiner point, whose cavity is found, comes no closer to a vertex than the minimum edge length; abandons the cavity if not.
  bool keeps_minimum(Session& s, const Attempt& t) const {
    const Split_spacing_3<Tr>& spacing = s.features().spacing();
    Cavity_3<Tr>& cavity = s.cavity();
    const double distance = t.least_distance();
    if (!spacing.is_below_minimum(distance * distance) || !spacing.is_below_minimum(cavity.squared_insertion_radius(t.at))) return true;
    cavity.abandon();
    return false;
  }

  const Tr& tr_;
  Complex& complex_;
  const Acute_neighborhood_3& acute_;
  const Criteria& criteria_;
  const Steiner_points_3<Tr, Criteria, Placement>& points_;
  const Room_maker_3<Tr, Criteria>& room_;
  Cell_classifier_3<Tr, Criteria>& classifier_;
};

}  // namespace pgdr

#endif
