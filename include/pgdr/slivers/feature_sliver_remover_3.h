// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_FEATURE_SLIVER_REMOVER_3_H
#define PGDR_SLIVERS_FEATURE_SLIVER_REMOVER_3_H

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/domain/feature_id.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/slivers/sliver_3.h>
#include <pgdr/slivers/sliver_cause.h>
#include <pgdr/slivers/tetrahedron_judge.h>

namespace pgdr {

/// Removes slivers whose corners lie on the boundary, which nothing inside can cure: most fill the fold between two facets that are nearly
/// one. Puts a point on one of their segments or facets:
/// 1. where that makes nothing that is poor, or has as small an angle;
/// 2. else where it makes nothing on the boundary alone that has as small an angle, and few poor tetrahedra, which are refined;
/// 3. else where the refinement would.
/// Next to tetrahedra that were given up, 2. and 3. only as long as there is a budget: where input angles are small, one point asks for more, up to
/// hundreds.
///
/// In the wedge between facets that meet at a small dihedral angle tetrahedra are as flat as it is, and stay.
/// \pre no other thread works
template <class Tr, class Criteria, class Engine>
class Feature_sliver_remover_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;
  using Sliver = Sliver_3<Tr>;

  /// `wanted`: the cosine of the angle below which a tetrahedron is a sliver. With `most_vertices` in the triangulation nothing is begun.
  Feature_sliver_remover_3(const Tr& tr, const Complex& complex, const Tetrahedron_judge<Criteria>& judge, double wanted, Engine& engine,
                           std::size_t most_vertices, const std::atomic<bool>* cancel)
      : tr_(tr), complex_(complex), judge_(judge), wanted_(wanted), engine_(engine), worker_(engine.make_worker()),
        budget_(static_cast<std::size_t>(budget_share * static_cast<double>(tr.number_of_vertices()))), most_vertices_(most_vertices), cancel_(cancel) {}

  /// Tries to remove slivers; returns how many points were inserted. All by 1. and 2. first, which cost less.
  std::size_t remove(const std::vector<Sliver>& slivers) {
    std::size_t inserted = 0;
    for (const bool is_split : {false, true})
      for (const Sliver& s : slivers)
        if (s.is_live() && !is_in_wedge(s.cell) && !must_stop()) inserted += is_split ? split(s.cell) : put_point(s);
    return inserted;
  }

 private:
  static constexpr double refused = Tetrahedron_judge<Criteria>::refused;
  // Tetrahedra below 5 degrees, and how many there are, of a06, a07 and a20, with at most so many poor ones up to this ratio: none: 94 of
  // 77,633, 70 of 84,702, 31 of 86,924; 4 up to 3: 79 of 77,943, 54 of 85,351, 22 of 87,165; 10 up to 10: 45 of 79,524, 38 of 86,316, 17 of 87,704.
  static constexpr int most_poor = 10;
  static constexpr double most_ratio = 10;
  // Of the vertices. With 1, 1.5, 2 and 3 %, the median of 18 models has 1.7, 2.0, 3.1 and 3.5 % more tetrahedra than without removal; below 5
  // degrees are then, of a04 152, 180, 180, 197, of a07 37, 25, 12, 0, of a11 4, 0, 0, 0, of a12 62, 56, 48, 49.
  static constexpr double budget_share = 0.015;

  struct Place {
    Piece_id piece;
    bool is_subsegment = false;
    double share = 0;
  };

  /// How good a place is: largest cosines of dihedral angles, or `refused`.
  struct Value {
    double strict = refused, relaxed = refused;
  };

  bool must_stop() const {
    return tr_.number_of_vertices() >= most_vertices_ || (cancel_ && cancel_->load(std::memory_order_relaxed));
  }

  std::size_t put_point(const Sliver& s) {
    list_places(s.cell);
    Value best{s.cosine, s.cosine};
    const Place *strict = nullptr, *relaxed = nullptr;
    for (const Place& place : places_) {
      engine_.put_on_piece(*worker_, place.piece, place.is_subsegment, place.share, [&](const Cavity_3<Tr>& cavity, const Vec_3& at) {
        const Value value = value_of(cavity, at, best);
        if (value.strict < best.strict) best.strict = value.strict, strict = &place;
        if (value.relaxed < best.relaxed) best.relaxed = value.relaxed, relaxed = &place;
        return false;
      });
      if (best.strict <= wanted_) break;
    }
    const Place* const at = strict ? strict : relaxed;
    if (!at) return 0;
    return within_budget(!strict && is_next_to_poor(s.cell), [&] {
      const auto always = [](const Cavity_3<Tr>&, const Vec_3&) { return true; };
      return engine_.put_on_piece(*worker_, at->piece, at->is_subsegment, at->share, always);
    });
  }

  /// A few on each subsegment and subfacet of a tetrahedron.
  void list_places(Cell_handle c) {
    places_.clear();
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        if (!(c->subsegment_edges() & edge_bit(i, j))) continue;
        const std::uint32_t s = complex_.find_subsegment(c->vertex(i), c->vertex(j));
        if (s == Complex::none) continue;
        for (const double share : {0.5, 0.4, 0.6, 0.3, 0.7}) places_.push_back({complex_.subsegment_id(s), true, share});
      }
    for (int i = 0; i < 4; ++i)
      if (c->subfacet(i) != Complex::none)
        for (const double share : {0.0, 0.5, 1.0}) places_.push_back({complex_.subfacet_id(c->subfacet(i)), false, share});
  }

  /// Of a point with this cavity; as far as it may be below a limit.
  Value value_of(const Cavity_3<Tr>& cavity, const Vec_3& at, const Value& limit) const {
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
        if (++poor > most_poor || ball.squared_radius > most_ratio * most_ratio * ball.squared_shortest) value.relaxed = refused;
      }
      if (value.strict >= limit.strict && value.relaxed >= limit.relaxed) break;
    }
    return value;
  }

  std::size_t split(Cell_handle c) {
    return within_budget(is_next_to_poor(c), [&] {
      const auto cause = sliver_cause(complex_, c);
      return cause ? engine_.split_piece(*worker_, cause->piece, cause->is_subsegment, cause->guard, cancel_).inserted : 0;
    });
  }

  /// What `insert` inserts, if there is a budget left or it does not count.
  std::size_t within_budget(bool counts, const auto& insert) {
    if (counts && spent_ >= budget_) return 0;
    const std::size_t inserted = insert();
    if (counts) spent_ += inserted;
    return inserted;
  }

  /// Whether one of its edges is as short as a small dihedral angle makes it.
  bool is_in_wedge(Cell_handle c) const {
    const Acute_neighborhood_3& acute = engine_.acute();
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        const Vec_3 p = position(c->vertex(i)), q = position(c->vertex(j));
        const double radius = std::min(c->vertex(i)->insertion_radius(), c->vertex(j)->insertion_radius());
        if (squared_distance(p, q) >= radius * radius) continue;
        const Feature_id a = feature_of(c->vertex(i)), b = feature_of(c->vertex(j));
        if (acute.explains(a, p, b, q) && !acute.meet_at_vertices_only(a, b)) return true;
      }
    return false;
  }

  bool is_next_to_poor(Cell_handle c) {
    return std::ranges::any_of(std::array{0, 1, 2, 3}, [&](int i) {
      around_.clear();
      tr_.tds().incident_cells(c->vertex(i), std::back_inserter(around_));
      return std::ranges::any_of(around_, [](Cell_handle d) { return d->is_poor(); });
    });
  }

  const Tr& tr_;
  const Complex& complex_;
  Tetrahedron_judge<Criteria> judge_;
  double wanted_;
  Engine& engine_;
  std::unique_ptr<typename Engine::Worker> worker_;
  std::size_t budget_, spent_ = 0;
  std::size_t most_vertices_;
  const std::atomic<bool>* cancel_;
  std::vector<Place> places_;
  std::vector<Cell_handle> around_;
};

}  // namespace pgdr

#endif
