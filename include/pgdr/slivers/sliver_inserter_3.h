// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_SLIVER_INSERTER_3_H
#define PGDR_SLIVERS_SLIVER_INSERTER_3_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <pgdr/conforming/cavity_features_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/torn_features_3.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/slivers/directions.h>
#include <pgdr/slivers/exempt_tetrahedra_3.h>
#include <pgdr/slivers/tetrahedron_judge.h>

namespace pgdr {

/// Adds a vertex in the ball of a sliver where that makes no tetrahedron with as small an angle.
///
/// The vertex may encroach what it likes outside of protected balls, as long as no piece of the input is deleted: quality is not driven by it any
/// more.
template <class Tr, class Criteria>
class Sliver_inserter_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Point = typename Tr::Point;

  Sliver_inserter_3(Tr& tr, Complex& complex, const Tetrahedron_judge<Criteria>& judge, const Territory_3<Tr>& territory)
      : tr_(tr), complex_(complex), judge_(judge), cavity_(tr), gone_(judge.acute()) {
    cavity_.set_territory(territory);
  }

  /// True if a vertex was added. `now`: the largest cosine of a dihedral angle of the tetrahedron.
  bool insert(Cell_handle c, double now, double wanted) {
    const Tetrahedron_ball ball = tetrahedron_ball(tetrahedron_points(c));
    const double radius = std::sqrt(ball.squared_radius);
    double best = now;
    Vec_3 place;
    const auto attempt = [&](const Vec_3& at) {
      const double cosine = worst_at(c, at, best, wanted);
      if (cosine >= best) return false;
      best = cosine;
      place = at;
      return cosine <= wanted;
    };
    bool is_found = attempt(ball.center);
    constexpr double steps[] = {0.3, 0.5, 0.7, 0.15, 0.85};
    for (const double step : steps)
      for (const Vec_3& d : directions)
        if (!is_found) is_found = attempt(ball.center + (step * radius / length(d)) * d);
    if (best >= now) return false;
    const Point p(place.x, place.y, place.z);
    if (!cavity_.find(p, c)) return false;
    const double nearest = std::sqrt(cavity_.squared_insertion_radius(place));
    const bool replaces_exempt = std::ranges::any_of(cavity_.cells(), [](Cell_handle d) { return d->state() == Cell_state::exempt; });
    const Vertex_handle v = cavity_.commit(p);
    v->set_feature(3, Tr::Vertex::none);
    v->set_insertion_radius(nearest);
    tr_.tell(v);
    if (replaces_exempt)
      for (const Cell_handle d : cavity_.star()) judge_.mark_exempt(d);
    return true;
  }

  /// The tetrahedra made by the last insertion.
  const std::vector<Cell_handle>& star() const { return cavity_.star(); }

 private:
  /// As `Vertex_mover_3::worst_at`; besides, no new edge may be shorter than half of the shortest one here,
  /// and where exempt tetrahedra go, only a cure will do.
  double worst_at(Cell_handle c, const Vec_3& at, double limit, double wanted) {
    constexpr double refused = Tetrahedron_judge<Criteria>::refused;
    const std::int32_t subdomain = c->subdomain();
    const Point p(at.x, at.y, at.z);
    double worst = -1;
    gone_.clear();
    made_.clear();
    double largest_ratio = 0;
    const auto cell = [&](Cell_handle d) {
      if (d->state() == Cell_state::exempt) {
        gone_.add(d);
        limit = std::min(limit, wanted);
      }
      return d->subdomain() == subdomain;
    };
    // Mostly the sliver's own faces are in the way: then the rest of the cavity is not looked for.
    const auto face = [&](Cell_handle d, int i) {
      Tetrahedron_points corners = tetrahedron_points(d);
      corners[static_cast<std::size_t>(i)] = at;
      if (gone_.count() == 0) {
        worst = std::max(worst, judge_(corners, subdomain, limit));
      } else {
        double squared_ratio;
        worst = std::max(worst, judge_.instead_of_exempt(corners, subdomain, limit, squared_ratio));
        if (squared_ratio > 0) made_.push_back(corners);
        largest_ratio = std::max(largest_ratio, squared_ratio);
      }
      return worst < limit;
    };
    if (!cavity_.find(p, c, cell, face)) return refused;
    if (is_spaced(at) && made_.size() <= gone_.count() && largest_ratio <= gone_.squared_ratio()) {
      features_.gather(complex_, cavity_);
      const auto is_explained = [this](const Tetrahedron_points& t) { return gone_.explain(t); };
      if (features_.deletes_any() || encroaches_protected(complex_, features_, judge_.acute(), p) || !std::ranges::all_of(made_, is_explained))
        worst = refused;
    } else {
      worst = refused;
    }
    cavity_.abandon();
    return worst;
  }

  bool is_spaced(const Vec_3& at) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Cell_handle d : cavity_.cells()) shortest = std::min(shortest, squared_shortest_edge(tetrahedron_points(d)));
    return 4 * cavity_.squared_insertion_radius(at) >= shortest;
  }

  const Tr& tr_;
  Complex& complex_;
  Tetrahedron_judge<Criteria> judge_;
  Cavity_3<Tr> cavity_;
  Cavity_features_3<Tr> features_;
  Exempt_tetrahedra_3<Tr> gone_;          ///< at the last place
  std::vector<Tetrahedron_points> made_;  ///< those over the ratio in their place
};

}  // namespace pgdr

#endif
