// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_FEATURE_SLIVER_REMOVER_3_H
#define PGDR_SLIVERS_FEATURE_SLIVER_REMOVER_3_H

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/domain/feature_id.h>
#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/slivers/divide_slivers_3.h>
#include <pgdr/slivers/exempt_tetrahedra_3.h>
#include <pgdr/slivers/feature_places_3.h>
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
/// hundreds. When that is spent, slivers below a quarter of the wanted angle have another one, since most are found later, those below a quarter of that a
/// third one, and so on.
///
/// In the wedge between facets that meet at a small dihedral angle tetrahedra are as flat as it is, and stay. Those that are much flatter than any
/// wedge do not. Those that are as flat as rounding is have a budget of their own: there are few, and no solver can use a mesh with one.
/// \pre no other thread works
template <class Tr, class Criteria, class Engine>
class Feature_sliver_remover_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Sliver = Sliver_3<Tr>;
  using Places = Feature_places_3<Tr, Criteria, Engine>;
  using Choice = typename Places::Choice;

  /// `wanted`: the cosine of the angle below which a tetrahedron is a sliver. With `most_vertices` in the triangulation nothing is begun.
  Feature_sliver_remover_3(Tr& tr, const Complex& complex, const Tetrahedron_judge<Criteria>& judge, double wanted, Engine& engine,
                           std::size_t most_vertices, const std::atomic<bool>* cancel)
      : tr_(tr), complex_(complex), judge_(judge), wanted_(wanted), engine_(engine), places_(tr, complex, judge, wanted, engine), worker_(engine.make_worker()),
        as_wedge_(cosine_of_degrees(engine.acute().smallest_dihedral_deg() / 4)), most_vertices_(most_vertices), cancel_(cancel) {
    const auto budget = static_cast<std::size_t>(budget_share * static_cast<double>(tr.number_of_vertices()));
    double cosine = wanted;
    for (Budget& b : budgets_) {
      b = {cosine, budget};
      cosine = cosine_of_half(cosine_of_half(cosine));
    }
    budget_for_flat_ = budget + more_for_flat;
  }

  /// Tries to remove slivers; returns how many points were inserted. All by 1. and 2. first, which cost less. Places for these are looked for in the mesh
  /// as it is in the beginning.
  std::size_t remove(const std::vector<Sliver>& slivers) {
    const std::vector<std::uint8_t> stays = all_that_stay(slivers);
    const std::vector<Choice> choices = choose_all(slivers, stays);
    std::size_t inserted = 0;
    for (const bool is_split : {false, true})
      for (std::size_t k = 0; k < slivers.size(); ++k)
        if (slivers[k].is_live() && !stays[k] && !must_stop()) inserted += is_split ? split(slivers[k]) : put_point(slivers[k], choices[k]);
    return inserted;
  }

  /// Whether there would be too many vertices with another one and those that it asks for.
  bool is_limited() const { return tr_.number_of_vertices() + most_at_once >= most_vertices_; }

 private:
  // Of the vertices. With 1, 1.5, 2 and 3 %, the median of 18 models has 1.7, 2.0, 3.1 and 3.5 % more tetrahedra than without removal; below 5
  // degrees are then, of a04 152, 180, 180, 197, of a07 37, 25, 12, 0, of a11 4, 0, 0, 0, of a12 62, 56, 48, 49.
  static constexpr double budget_share = 0.015;
  static constexpr std::size_t more_for_flat = 64;  ///< small meshes have flat tetrahedra, too
  static constexpr std::size_t most_at_once = 32;  ///< that one point asks for mostly; it can be thousands next to small angles
  /// Where something beside a severe sliver is so many times as poor, a split would ask for that to be refined, too.
  static constexpr double much_poorer = 2;

  /// For slivers below the angle with this cosine.
  struct Budget {
    double cosine = 0;
    std::size_t left = 0;
  };
  /// Of budgets, each for slivers below a quarter of the angle of the one before.
  static constexpr std::size_t levels = 4;

  static double cosine_of_half(double cosine) { return std::sqrt((1 + cosine) / 2); }

  /// Which are those between facets that meet at a small angle: as long as they live, their corners are what they are.
  std::vector<std::uint8_t> all_that_stay(const std::vector<Sliver>& slivers) const {
    std::vector<std::uint8_t> stays(slivers.size());
    parallel_for_chunks(slivers.size(), default_grain, [&](std::size_t k, std::size_t end) {
      for (; k < end; ++k) stays[k] = !slivers[k].is_flat() && slivers[k].cosine < as_wedge_ && is_in_wedge(slivers[k].cell);
    });
    return stays;
  }

  bool must_stop() const {
    return is_limited() || (cancel_ && cancel_->load(std::memory_order_relaxed));
  }

  /// Looks for places, with all threads of the caller's arena; of slivers on borders for none.
  std::vector<Choice> choose_all(const std::vector<Sliver>& slivers, const std::vector<std::uint8_t>& stays) {
    std::vector<Choice> choices(slivers.size(), Choice{.place = {}, .is_foreign = true});
    const std::size_t n = territory_count(slivers.size(), 0);
    if (n == 0) return choices;
    const Divided_slivers_3<Tr> divided = divide_slivers(tr_, complex_, slivers, n, 0.5);
    parallel_for(0, n, [&](std::size_t part) {
      Places places(tr_, complex_, judge_, wanted_, engine_, divided.territories[part]);
      for (const std::size_t k : divided.parts[part])
        if (!must_stop() && !stays[k]) choices[k] = places.choose(slivers[k]);
    });
    return choices;
  }

  std::size_t put_point(const Sliver& s, const Choice& known) {
    if (!known.is_foreign) {
      if (!known.place) return 0;
      if (const auto inserted = put_point_at(s, known); inserted != std::size_t{0}) return inserted.value_or(0);
    }
    const Choice choice = places_.choose(s);
    return choice.place ? put_point_at(s, choice).value_or(0) : 0;
  }

  std::optional<std::size_t> put_point_at(const Sliver& s, const Choice& choice) {
    return within_budget(choice.is_strict && !choice.may_tear ? nullptr : budget_for(s, false), [&] {
      const auto is_good = [&](const Cavity_3<Tr>& cavity, const Vec_3& at) { return places_.is_good(s, choice.is_strict, cavity, at); };
      return engine_.put_on_piece(*worker_, choice.place->piece, choice.place->is_subsegment, choice.place->at, choice.may_tear, is_good);
    });
  }

  std::size_t split(const Sliver& s) {
    return within_budget(budget_for(s, true), [&] {
      const auto cause = sliver_cause(complex_, s.cell, !is_explained(engine_.acute(), s.cell));
      return cause ? engine_.split_piece(*worker_, cause->piece, cause->is_subsegment, cause->guard, cancel_).inserted : 0;
    }).value_or(0);
  }

  /// What a point for it counts against; null if it does not.
  std::size_t* budget_for(const Sliver& s, bool is_split) {
    if (s.is_flat()) return &budget_for_flat_;
    const double poorest = squared_ratio_of_poor_around(s.cell);
    if (poorest == 0) return nullptr;
    const bool is_plain = is_split && poorest > much_poorer * much_poorer * squared_ratio(s.cell) && is_explained(engine_.acute(), s.cell);
    const auto may_use = [&](const Budget& b) { return b.left > 0 && (is_plain ? &b == &budgets_[0] : s.cosine > b.cosine); };
    const auto found = std::ranges::find_if(budgets_, may_use);
    return found != budgets_.end() ? &found->left : &budgets_[0].left;
  }

  static double squared_ratio(Cell_handle c) { return tetrahedron_ball(tetrahedron_points(c)).squared_ratio(); }

  /// What `insert` inserts; none if the budget is spent.
  static std::optional<std::size_t> within_budget(std::size_t* budget, const auto& insert) {
    if (budget && *budget == 0) return std::nullopt;
    const std::size_t inserted = insert();
    if (budget) *budget -= std::min(*budget, inserted);
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

  /// The largest one of those that were given up, or will be refined; 0 if there are none.
  double squared_ratio_of_poor_around(Cell_handle c) {
    double largest = 0;
    for (int i = 0; i < 4; ++i) {
      around_.clear();
      tr_.tds().incident_cells(c->vertex(i), std::back_inserter(around_));
      for (const Cell_handle d : around_)
        if (d->is_poor()) largest = std::max(largest, squared_ratio(d));
    }
    return largest;
  }

  Tr& tr_;
  const Complex& complex_;
  Tetrahedron_judge<Criteria> judge_;
  double wanted_;
  Engine& engine_;
  Places places_;  ///< everywhere
  std::unique_ptr<typename Engine::Worker> worker_;
  double as_wedge_;  ///< the cosine of a quarter of the smallest dihedral angle: no wedge makes what is flatter
  std::array<Budget, levels> budgets_;
  std::size_t budget_for_flat_;
  std::size_t most_vertices_;
  const std::atomic<bool>* cancel_;
  std::vector<Cell_handle> around_;
};

}  // namespace pgdr

#endif
