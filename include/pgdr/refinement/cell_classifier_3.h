// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_CELL_CLASSIFIER_3_H
#define PGDR_REFINEMENT_CELL_CLASSIFIER_3_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/flat_cell_3.h>
#include <pgdr/mesh/mesh_triangulation_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/refinement/enclosing_ball.h>
#include <pgdr/refinement/leaf_session_3.h>

namespace pgdr {

/// Where vertices are dense along a segment and the mesh around them is not graded yet, thousands of tetrahedra join them to the same
/// vertex far away, with Steiner points next to each other, and the cavity of each holds all the others. One point removes
/// them: the largest comes first, and no task looks at them while others are at work, who could not insert it. Inside of a body by
/// quality alone, ratios of some tens are what it begins with, and order does not matter. Seconds of a bracket with steps of a
/// 40,000th of its size, and of a ball of 14,000 facets: 12: 8, 34; 32: 9, 38; 64: 9, 12; 100: 9, 18; 256: 17, 15; never: no end, 16.
inline bool is_steep(const Tetrahedron_ball& ball) {
  constexpr double steepness = 64;
  return ball.squared_radius > steepness * steepness * ball.squared_shortest;
}

/// More than what rounding to single precision takes away.
inline constexpr float upwards = 1.000001f;
inline float radius_above(double r) { return upwards * static_cast<float>(r); }

/// Tells what is to become of new tetrahedra, and puts those that are poor on the worklist of a session.
template <class Tr, class Criteria>
class Cell_classifier_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Complex = Constraint_complex_3<Tr>;
  using Session = Leaf_session_3<Tr>;
  using Cell_id = typename Session::Cell_id;

  Cell_classifier_3(const Tr& tr, Complex& complex, const Criteria& criteria) : tr_(tr), complex_(complex), criteria_(criteria) {}

  /// Puts a tetrahedron on the worklist if it is poor; flat ones on a facet become requests to split that facet.
  void classify(Session& s, Cell_handle c) {
    if (c->subdomain() == 0) return classify_outside(s, c);
    if (c->has_subfacet() && is_handed_over(s, c)) return classify_outside(s, c);
    const Tetrahedron_ball ball = tetrahedron_ball(position(c->vertex(0)), position(c->vertex(1)),
                                                   position(c->vertex(2)), position(c->vertex(3)));
    classify(s, c, ball, criteria_.is_poor(ball, c->subdomain()));
  }

  /// The same for a tetrahedron of the domain that was measured.
  void classify(Session& s, Cell_handle c, const Tetrahedron_ball& ball, bool is_poor) {
    const double r = std::sqrt(ball.squared_radius);
    c->ball().set(ball.center, r, ball_error);
    const float radius = radius_above(r);
    c->set_state(is_poor ? Cell_state::poor : Cell_state::good);
    if (is_poor)
      s.list().add_poor({c, c->generation(), radius}, s.task().target, is_steep(ball));
    else
      note_coarse(s, c, static_cast<double>(radius));
  }

  /// The k-th tetrahedron around a new Steiner point.
  void classify_new(Session& s, std::size_t k) {
    const Cell_handle c = s.cavity().star()[k];
    if (s.star().is_empty() || c->subdomain() == 0 || c->has_subfacet()) return classify(s, c);
    classify(s, c, s.star()[k].ball, s.star()[k].is_poor);
  }

  /// The tetrahedra made on features since the last time.
  void take_fresh(Session& s) {
    for (const Cell_id& id : s.features().fresh_cells())
      if (id.is_live()) {
        if (s.cavity().territory().owns(id.cell))
          classify(s, id.cell);
        else
          s.send_fresh(id);
      }
    s.features().fresh_cells().clear();
  }

 private:
  void classify_outside(Session& s, Cell_handle c) {
    const double target = s.task().outside_target;
    if (target == std::numeric_limits<double>::infinity() || tr_.is_infinite(c)) return;
    const Tetrahedron_points p = tetrahedron_points(c);
    const Tetrahedron_ball ball = tetrahedron_ball(p);
    const double r = std::sqrt(ball.squared_radius);
    c->ball().set(ball.center, r, ball_error);
    const double m = r <= target ? r : enclosing_radius(p);
    const Cell_id id{c, c->generation(), radius_above(m)};
    if (m > target)
      s.list().add_outside(id, true);
    else if (!s.task().last)
      s.list().add_outside(id, false);  // smaller leaves may come
    else
      note_coarse(s, c, m * static_cast<double>(upwards));
  }

  static void note_coarse(Session& s, Cell_handle c, double radius) {
    s.list().note_coarse(radius);
    if (s.collects_coarse) s.send(position(c->vertex(0)), Session::Kind::coarse, {c, c->generation(), radius_above(radius)});
  }

  /// Gives a flat tetrahedron to the outside if that is what lies beyond its facet; else a point on the facet has to
  /// remove it.
  bool is_handed_over(Session& s, Cell_handle c) const {
    std::vector<Cell_handle> flat{c};
    while (!flat.empty()) {
      const Cell_handle d = flat.back();
      flat.pop_back();
      const std::uint32_t t = subfacet_of_flat_cell(complex_, d);
      if (t == Complex::none) continue;
      if (!move_across_sheet(complex_, d, 0)) {
        // In a bent facet any four vertices may be off one plane by what they are apart, and another point makes other such four.
        if (!complex_.is_bent(complex_.subfacet(t).facet)) s.features().request_subfacet(t, Split_reason::flat);
        continue;
      }
      for (int i = 0; i < 4; ++i) {
        const Cell_handle n = d->neighbor(i);
        if (d->subfacet(i) == Complex::none || n->subdomain() == 0) continue;
        // What changes with it are its neighbors, too.
        if (s.cavity().territory().owns(n) && s.features().zone().leads_on(n))
          flat.push_back(n);
        else
          s.send_fresh({n, n->generation(), 0});
      }
    }
    return c->subdomain() == 0;
  }

  const Tr& tr_;
  Complex& complex_;
  const Criteria& criteria_;
};

}  // namespace pgdr

#endif
