// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_FEATURE_PLACES_3_H
#define PGDR_SLIVERS_FEATURE_PLACES_3_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <CGAL/Triangulation_utils_3.h>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/split_points_3.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/mesh/territory_3.h>
#include <pgdr/slivers/exempt_tetrahedra_3.h>
#include <pgdr/slivers/sliver_3.h>
#include <pgdr/slivers/tetrahedron_judge.h>

namespace pgdr {

/// Looks for the place on the boundary where a point takes a sliver away:
/// 1. where that makes nothing that is poor, or has as small an angle;
/// 2. else where it makes nothing on the boundary alone that has as small an angle, and few poor tetrahedra;
/// 3. else, if no small angle of the input accounts for the sliver, where that holds and pieces of other features are deleted: of the wall across.
///
/// Changes nothing: several may look at once, each within a territory of its own.
template <class Tr, class Criteria, class Engine>
class Feature_places_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Sliver = Sliver_3<Tr>;

  struct Place {
    Piece_id piece;
    bool is_subsegment = false;
    Vec_3 at;
  };

  /// The best place there is.
  struct Choice {
    std::optional<Place> place;
    bool is_strict = false;   ///< by 1.
    bool is_foreign = false;  ///< not all places are within the territory
    bool may_tear = false;    ///< what is opposite may go missing
  };

  /// `wanted`: the cosine of the angle below which a tetrahedron is a sliver.
  Feature_places_3(const Tr& tr, const Complex& complex, const Tetrahedron_judge<Criteria>& judge, double wanted, Engine& engine,
                   const Territory_id& territory = {})
      : tr_(tr), complex_(complex), judge_(judge), wanted_(wanted), engine_(engine), territory_(territory), split_points_(complex, engine.acute()),
        worker_(engine.make_worker()) {}

  /// \pre the sliver is within the territory
  Choice choose(const Sliver& s) {
    const Choice choice = best_place(s, false);
    const bool is_hopeless = !choice.place && !choice.is_foreign && !is_explained(engine_.acute(), s.cell);
    return is_hopeless ? best_place(s, true) : choice;
  }

  /// Whether a point with this cavity is as good for the sliver as was chosen.
  bool is_good(const Sliver& s, bool is_strict, const Cavity_3<Tr>& cavity, const Vec_3& at) const {
    const Value value = value_of(s, cavity, at, {s.cosine, s.cosine});
    return (is_strict ? value.strict : value.relaxed) < s.cosine;
  }

 private:
  static constexpr double refused = Tetrahedron_judge<Criteria>::refused;
  // Tetrahedra below 5 degrees, and how many there are, of a06, a07 and a20, with at most so many poor ones up to this ratio: none: 94 of
  // 77,633, 70 of 84,702, 31 of 86,924; 4 up to 3: 79 of 77,943, 54 of 85,351, 22 of 87,165; 10 up to 10: 45 of 79,524, 38 of 86,316, 17 of 87,704.
  static constexpr int most_poor = 10;
  static constexpr double most_ratio = 10;

  /// How good a place is: largest cosines of dihedral angles, or `refused`.
  struct Value {
    double strict = refused, relaxed = refused;
  };

  Choice best_place(const Sliver& s, bool may_tear) {
    list_places(s);
    Choice choice{.place = {}, .may_tear = may_tear};
    Value best{s.cosine, s.cosine};
    const Place *strict = nullptr, *relaxed = nullptr;
    for (const Place& place : places_) {
      const auto look = [&](const Cavity_3<Tr>& cavity, const Vec_3& at) {
        const Value value = value_of(s, cavity, at, best);
        if (value.strict < best.strict) best.strict = value.strict, strict = &place;
        if (value.relaxed < best.relaxed) best.relaxed = value.relaxed, relaxed = &place;
      };
      choice.is_foreign |= !engine_.look_at_piece(*worker_, territory_, place.piece, place.is_subsegment, place.at, may_tear, look);
      if (best.strict > wanted_) continue;
      choice.is_foreign = false;  // no other can be better
      break;
    }
    choice.is_strict = strict != nullptr;
    if (strict || relaxed) choice.place = strict ? *strict : *relaxed;
    return choice;
  }

  /// A few on each subsegment and subfacet of a tetrahedron, or else on those subfacets that have an edge of it: cocircular vertices of two
  /// walls of a slot.
  void list_places(const Sliver& s) {
    const Cell_handle c = s.cell;
    places_.clear();
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        if (!(c->subsegment_edges() & edge_bit(i, j))) continue;
        const std::uint32_t at = complex_.find_subsegment(c->vertex(i), c->vertex(j));
        if (at == Complex::none) continue;
        for (const double share : {0.5, 0.4, 0.6, 0.3, 0.7}) places_.push_back({complex_.subsegment_id(at), true, split_points_.on_subsegment(at, share)});
      }
    for (int i = 0; i < 4; ++i)
      if (c->subfacet(i) != Complex::none)
        list_places_on(c->subfacet(i));
    if (!places_.empty() && !s.is_flat()) return;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j)
        if (c->vertex(i)->in_dimension() < 3 && c->vertex(j)->in_dimension() < 3) list_places_at_edge(c, i, j);
  }

  void list_places_at_edge(Cell_handle c, int i, int j) {
    auto d = tr_.tds().incident_cells(c, i, j);
    const auto done = d;
    const Vertex_handle v = c->vertex(i), w = c->vertex(j);
    do {
      // Of the two facets of a cell at the edge, the one that the next cell around does not have.
      const int k = CGAL::Triangulation_utils_3::next_around_edge(d->index(v), d->index(w));
      const std::uint32_t t = d->subfacet(k);
      if (t == Complex::none) continue;
      places_.push_back({complex_.subfacet_id(t), false, complex_.on_plane(complex_.subfacet(t).facet, 0.5 * (position(v) + position(w)))});
      list_places_on(t);
    } while (++d != done);
  }

  void list_places_on(std::uint32_t subfacet) {
    for (const double share : {0.0, 0.5, 1.0}) places_.push_back({complex_.subfacet_id(subfacet), false, split_points_.on_subfacet(subfacet, share)});
  }

  /// Of a point with this cavity; as far as it may be below a limit.
  Value value_of(const Sliver& s, const Cavity_3<Tr>& cavity, const Vec_3& at, const Value& limit) const {
    if (std::ranges::find(cavity.cells(), s.cell) == cavity.cells().end()) return {};
    const double ratio2 = std::max(most_ratio * most_ratio, s.is_flat() ? squared_ratio_of_poor(cavity) : 0);  // of tetrahedra that are refined later
    Value value{-1, -1};
    int poor = 0;
    for (const auto& [c, i] : cavity.boundary()) {
      if (c->subdomain() == 0) continue;
      Tetrahedron_points corners = tetrahedron_points(c);
      corners[static_cast<std::size_t>(i)] = at;
      const Tetrahedron_frame frame(corners);
      const double cosine = frame.largest_dihedral_cosine();
      bool is_on_boundary = true;
      for (int j = 0; j < 4; ++j) is_on_boundary &= j == i || c->vertex(j)->in_dimension() < 3;
      if (is_on_boundary) value.relaxed = std::max(value.relaxed, cosine);
      value.strict = std::max(value.strict, cosine);
      if (const Tetrahedron_ball ball = frame.ball(); judge_.refuses(ball, c->subdomain())) {
        value.strict = refused;
        if (++poor > most_poor || ball.squared_radius > ratio2 * ball.squared_shortest) value.relaxed = refused;
      }
      if (value.strict >= limit.strict && value.relaxed >= limit.relaxed) break;
    }
    return value;
  }

  /// The largest radius-edge ratio of those that were given up and go, squared.
  static double squared_ratio_of_poor(const Cavity_3<Tr>& cavity) {
    double largest = 0;
    for (const Cell_handle d : cavity.cells())
      if (d->state() == Cell_state::exempt) largest = std::max(largest, tetrahedron_ball(tetrahedron_points(d)).squared_ratio());
    return largest;
  }

  const Tr& tr_;
  const Complex& complex_;
  Tetrahedron_judge<Criteria> judge_;
  double wanted_;
  Engine& engine_;
  Territory_id territory_;
  Split_points_3<Tr> split_points_;
  std::unique_ptr<typename Engine::Worker> worker_;
  std::vector<Place> places_;
};

}  // namespace pgdr

#endif
