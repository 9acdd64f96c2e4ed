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

#include <CGAL/Triangulation_utils_3.h>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/split_points_3.h>
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
/// In the wedge between facets that meet at a small dihedral angle tetrahedra are as flat as it is, and stay. Those that are flatter than any
/// wedge do not, and have a budget of their own: there are few, and no solver can use a mesh with one.
/// \pre no other thread works
template <class Tr, class Criteria, class Engine>
class Feature_sliver_remover_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Sliver = Sliver_3<Tr>;

  /// `wanted`: the cosine of the angle below which a tetrahedron is a sliver. With `most_vertices` in the triangulation nothing is begun.
  Feature_sliver_remover_3(const Tr& tr, const Complex& complex, const Tetrahedron_judge<Criteria>& judge, double wanted, Engine& engine,
                           std::size_t most_vertices, const std::atomic<bool>* cancel)
      : tr_(tr), complex_(complex), judge_(judge), wanted_(wanted), engine_(engine), split_points_(complex, engine.acute()), worker_(engine.make_worker()),
        budget_(static_cast<std::size_t>(budget_share * static_cast<double>(tr.number_of_vertices()))), most_vertices_(most_vertices), cancel_(cancel) {}

  /// Tries to remove slivers; returns how many points were inserted. All by 1. and 2. first, which cost less.
  std::size_t remove(const std::vector<Sliver>& slivers) {
    std::size_t inserted = 0;
    for (const bool is_split : {false, true})
      for (const Sliver& s : slivers)
        if (s.is_live() && (is_flat(s) || !is_in_wedge(s.cell)) && !must_stop()) inserted += is_split ? split(s) : put_point(s);
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
  static constexpr std::size_t more_for_flat = 64;  ///< small meshes have flat tetrahedra, too

  struct Place {
    Piece_id piece;
    bool is_subsegment = false;
    Vec_3 at;
  };

  /// How good a place is: largest cosines of dihedral angles, or `refused`.
  struct Value {
    double strict = refused, relaxed = refused;
  };

  bool must_stop() const {
    return tr_.number_of_vertices() >= most_vertices_ || (cancel_ && cancel_->load(std::memory_order_relaxed));
  }

  std::size_t put_point(const Sliver& s) {
    list_places(s);
    Value best{s.cosine, s.cosine};
    const Place *strict = nullptr, *relaxed = nullptr;
    for (const Place& place : places_) {
      engine_.put_on_piece(*worker_, place.piece, place.is_subsegment, place.at, [&](const Cavity_3<Tr>& cavity, const Vec_3& at) {
        if (std::ranges::find(cavity.cells(), s.cell) == cavity.cells().end()) return false;
        const double ratio2 = std::max(most_ratio * most_ratio, is_flat(s) ? squared_ratio_of_poor(cavity) : 0);
        const Value value = value_of(cavity, at, best, ratio2);
        if (value.strict < best.strict) best.strict = value.strict, strict = &place;
        if (value.relaxed < best.relaxed) best.relaxed = value.relaxed, relaxed = &place;
        return false;
      });
      if (best.strict <= wanted_) break;
    }
    const Place* const chosen = strict ? strict : relaxed;
    if (!chosen) return 0;
    return within_budget(s, !strict, [&] {
      const auto always = [](const Cavity_3<Tr>&, const Vec_3&) { return true; };
      return engine_.put_on_piece(*worker_, chosen->piece, chosen->is_subsegment, chosen->at, always);
    });
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
    if (!places_.empty() && !is_flat(s)) return;
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

  /// Of a point with this cavity; as far as it may be below a limit. `ratio2`: what tetrahedra that are refined later have at most, squared
  Value value_of(const Cavity_3<Tr>& cavity, const Vec_3& at, const Value& limit, double ratio2) const {
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
      if (d->state() == Cell_state::exempt) {
        const Tetrahedron_ball ball = tetrahedron_ball(tetrahedron_points(d));
        largest = std::max(largest, ball.squared_radius / ball.squared_shortest);
      }
    return largest;
  }

  std::size_t split(const Sliver& s) {
    return within_budget(s, true, [&] {
      const auto cause = sliver_cause(complex_, s.cell);
      return cause ? engine_.split_piece(*worker_, cause->piece, cause->is_subsegment, cause->guard, cancel_).inserted : 0;
    });
  }

  /// As only cocircular vertices make it, of which images next to small angles are many: no angle of the input is as small.
  static bool is_flat(const Sliver& s) {
    constexpr double flattest = 1 - 1.5e-12;  // the cosine of 1e-4 degrees
    return s.cosine > flattest;
  }

  /// What `insert` inserts, if there is a budget left or it does not count.
  std::size_t within_budget(const Sliver& s, bool may_count, const auto& insert) {
    const bool flat = is_flat(s);
    const bool counts = may_count && (flat || is_next_to_poor(s.cell));
    std::size_t& spent = flat ? spent_on_flat_ : spent_;
    if (counts && spent >= (flat ? budget_ + more_for_flat : budget_)) return 0;
    const std::size_t inserted = insert();
    if (counts) spent += inserted;
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
  Split_points_3<Tr> split_points_;
  std::unique_ptr<typename Engine::Worker> worker_;
  std::size_t budget_, spent_ = 0, spent_on_flat_ = 0;
  std::size_t most_vertices_;
  const std::atomic<bool>* cancel_;
  std::vector<Place> places_;
  std::vector<Cell_handle> around_;
};

}  // namespace pgdr

#endif
