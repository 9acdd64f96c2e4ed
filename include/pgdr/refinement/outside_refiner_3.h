// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_OUTSIDE_REFINER_3_H
#define PGDR_REFINEMENT_OUTSIDE_REFINER_3_H

#include <cstdint>
#include <optional>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/mesh/triangle_ball.h>
#include <pgdr/refinement/cell_classifier_3.h>
#include <pgdr/refinement/features_in_the_way_3.h>
#include <pgdr/refinement/insert_steiner_point_3.h>
#include <pgdr/refinement/leaf_session_3.h>
#include <pgdr/refinement/room_maker_3.h>
#include <pgdr/refinement/steiner_point_3.h>

namespace pgdr {

/// Refines tetrahedra outside the domain, as far as the zone condition of the leaves needs it, and never at the expense of a feature.
template <class Tr, class Criteria>
class Outside_refiner_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Point = typename Tr::Point;
  using Complex = Constraint_complex_3<Tr>;
  using Session = Leaf_session_3<Tr>;
  using Attempt = Steiner_attempt_3<Tr>;

  Outside_refiner_3(const Tr& tr, Complex& complex, const Criteria& criteria, const Room_maker_3<Tr, Criteria>& room,
                    Cell_classifier_3<Tr, Criteria>& classifier)
      : tr_(tr), complex_(complex), criteria_(criteria), room_(room), classifier_(classifier) {}

  /// Inserts the Steiner point of a tetrahedron, unless a feature is in the way that need not be split anyway.
  void refine(Session& s, Attempt& t) const {
    switch (find(s, t)) {
      case Obstruction::none: insert_steiner_point(s, t, classifier_); break;
      case Obstruction::splits_anyway:
        if (!room_.make_room(s, t)) room_.give_up(s, t);
        break;
      case Obstruction::stays: room_.give_up(s, t); break;
      case Obstruction::foreign: room_.hand_on(s, t); break;
    }
  }

 private:
  enum class Obstruction : std::uint8_t { none, splits_anyway, stays, foreign };

  /// Looks for the cavity of a point outside the domain, and leaves it marked if there is no obstruction.
  Obstruction find(Session& s, const Attempt& t) const {
    Cavity_3<Tr>& cavity = s.cavity();
    const Point p = t.point();
    // A point outside has a large cavity, more often than not with a feature in the way: better to know at the first of its cells.
    std::optional<typename Tr::Facet> subfacet;
    std::uint32_t subsegment = Complex::none;
    const auto is_clear = [&](Cell_handle d) {
      subfacet = encroached_subfacet_of(complex_, d, p);
      if (!subfacet) subsegment = subsegment_in_the_way(tr_, complex_, d, p);
      return !subfacet && subsegment == Complex::none;
    };
    if (!cavity.find(p, t.id.cell, is_clear)) {
      if (cavity.is_foreign()) return Obstruction::foreign;
      if (subfacet && is_split_anyway(*subfacet))
        s.obstacles().set_subfacet(complex_, subfacet->first->subfacet(subfacet->second));
      else if (subsegment != Complex::none && is_split_anyway(subsegment))
        s.obstacles().set_subsegment(complex_, subsegment);
      else
        return Obstruction::stays;
      return Obstruction::splits_anyway;
    }
    const bool blocked = s.collect_obstacles(complex_, p);
    if (!blocked && !is_crowded(s, t.at)) return Obstruction::none;
    cavity.abandon();
    return blocked && s.obstacles().keep_subsegments([this](std::uint32_t slot) { return is_split_anyway(slot); })
               ? Obstruction::splits_anyway
               : Obstruction::stays;
  }

  /// Whether the sizing field asks for smaller subfacets than this one, seen from outside: then a point outside may
  /// split it, which the points inside have yet to do.
  bool is_split_anyway(const typename Tr::Facet& f) const {
    const Cell_handle inside = f.first->neighbor(f.second);
    if (inside->subdomain() == 0 ||
        !criteria_.is_over_size(tetrahedron_ball(tetrahedron_points(inside)), inside->subdomain()))
      return false;
    const auto& t = complex_.subfacet(f.first->subfacet(f.second));
    const Vec_3 a = position(t.vertices[0]), b = position(t.vertices[1]), c = position(t.vertices[2]);
    const Vec_3 center = triangle_circumcenter(a, b, c);
    return length(center - a) > criteria_.size_at(center);
  }

  /// The same of a subsegment.
  bool is_split_anyway(std::uint32_t subsegment) const {
    const auto& s = complex_.subsegment(subsegment);
    return complex_.subsegment_radius(subsegment) > criteria_.size_at(0.5 * (position(s.vertices[0]) + position(s.vertices[1])));
  }

  /// Whether a point outside the domain would come closer to a vertex than the refinement out there needs.
  static bool is_crowded(Session& s, const Vec_3& p) {
    const double least = 0.3 * s.task().outside_target;
    return s.cavity().squared_insertion_radius(p) < least * least;
  }

  const Tr& tr_;
  Complex& complex_;
  const Criteria& criteria_;
  const Room_maker_3<Tr, Criteria>& room_;
  Cell_classifier_3<Tr, Criteria>& classifier_;
};

}  // namespace pgdr

#endif
