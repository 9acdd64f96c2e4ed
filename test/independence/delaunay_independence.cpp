// SPDX-License-Identifier: GPL-3.0-or-later
// Theorem 1 (delaunay_independence.h) against the truth: both cavities are replaced by their stars, by hand, and what
// comes out is looked at, cell by cell.
#include <pgdr/independence/delaunay_independence.h>

#include <array>
#include <cstdint>
#include <iostream>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "catch.h"
#include "independence/random_triangulations.h"
#include "seeded_random.h"

using namespace pgdr_test;

namespace {

void fill(Delaunay& t, const Cavity& cavity, const Point& p) {
  t.insert_in_hole(p, cavity.cells.begin(), cavity.cells.end(), cavity.boundary[0].first,
                   cavity.boundary[0].second);
}

/// By the Delaunay lemma: all cells are positive, and no vertex is inside the ball of the cell beside its own. (CGAL's
/// `is_valid` says the same, but ends the program where assertions are on.)
bool is_delaunay(const Delaunay& t) {
  for (const Delaunay::Cell_handle c : t.finite_cell_handles()) {
    if (CGAL::orientation(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(),
                          c->vertex(3)->point()) != CGAL::POSITIVE)
      return false;
    for (int i = 0; i < 4; ++i) {
      const auto opposite = t.mirror_vertex(c, i);
      if (c->neighbor(i)->neighbor(t.mirror_index(c, i)) != c) return false;
      if (!t.is_infinite(opposite) && t.side_of_sphere(c, opposite->point()) == CGAL::ON_BOUNDED_SIDE)
        return false;
    }
  }
  return true;
}

/// Whether replacing both cavities, each as it was before, makes a Delaunay triangulation.
bool truly_independent(Delaunay t, const Point& p, const Point& q) {
  const Cavity at_p(t, p), at_q(t, q);
  if (at_p.meets(at_q)) return false;
  fill(t, at_p, p);
  fill(t, at_q, q);
  return is_delaunay(t);
}

}  // namespace

TEST_CASE("Theorem 1 tells whether two points are Delaunay-independent", "[independence]") {
  Seeded_random random(20080607);
  std::size_t pairs = 0;
  for (const Arrangement arrangement : arrangements) {
    std::array<std::size_t, 2> count{};
    std::size_t share_triangles = 0;
    while (count[0] + count[1] < 4000) {
      const Delaunay t = random_triangulation(arrangement, random);
      for (int k = 0; k < 20; ++k) {
        const auto [p, q] = random_pair(arrangement, random);
        if (p == q || is_vertex(t, p) || is_vertex(t, q)) continue;
        const bool independent = pgdr::are_delaunay_independent(t, p, q);
        CAPTURE(name(arrangement), t.number_of_vertices(), p, q);
        REQUIRE(independent == truly_independent(t, p, q));
        REQUIRE(independent == pgdr::are_delaunay_independent(t, q, p));
        ++count[independent];
        share_triangles += !independent && !Cavity(t, p).meets(Cavity(t, q));
      }
    }
    std::cout << name(arrangement) << ": " << count[1] << " independent, " << count[0] << " dependent, "
              << share_triangles << " of these by condition (3)\n";
    CHECK(count[0] > 200);
    CHECK(count[1] > 200);
    pairs += count[0] + count[1];
  }
  CHECK(pairs >= 20000);
}

TEST_CASE("Condition (3) matters", "[independence]") {
  Seeded_random random(7);
  std::size_t by_condition_3 = 0;
  for (int k = 0; k < 200; ++k) {
    const Delaunay t = random_triangulation(Arrangement::random, random);
    const auto [p, q] = random_pair(Arrangement::random, random);
    if (p == q || is_vertex(t, p) || is_vertex(t, q)) continue;
    by_condition_3 += !Cavity(t, p).meets(Cavity(t, q)) && !pgdr::are_delaunay_independent(t, p, q);
  }
  CHECK(by_condition_3 > 0);
}
