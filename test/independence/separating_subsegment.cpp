// SPDX-License-Identifier: GPL-3.0-or-later
// Theorem 2 (separating_subsegment.h): its witness is what it says, and implies theorem 1.
#include <pgdr/independence/separating_subsegment.h>

#include <cmath>
#include <cstdint>
#include <iostream>

#include <pgdr/independence/delaunay_independence.h>

#include "catch.h"
#include "independence/random_triangulations.h"
#include "seeded_random.h"

using namespace pgdr_test;

namespace {

/// Points strictly inside the cube whose refined triangulation is `t`.
Point inside(Random& random) {
  return Point(random.between(-0.99, 0.99), random.between(-0.99, 0.99), random.between(-0.99, 0.99));
}

/// Condition (8), by another way: distances from the centers that CGAL computes.
bool is_witness(const Delaunay& t, const Point& p, const Point& q, const pgdr::Separating_subsegment& s) {
  const Kernel::Vector_3 way = q - p;
  const Kernel::Segment_3 piece(p + s.from * way, p + s.to * way);
  const double length = std::sqrt(piece.squared_length());
  for (const Delaunay::Cell_handle c : t.finite_cell_handles()) {
    const Point center = t.dual(c);
    const double r = std::sqrt(CGAL::squared_distance(center, c->vertex(0)->point()));
    if (std::sqrt(CGAL::squared_distance(center, piece)) < r * (1 - 1e-9) && 2 * r > length * (1 + 1e-9))
      return false;
  }
  return length > 0;
}

/// Enough points for balls that are small beside the cube.
Delaunay fine_triangulation(Arrangement a, Random& random) {
  Delaunay t = random_triangulation(a, random);
  if (a == Arrangement::gridded || a == Arrangement::nearly_flat) {
    for (int i = 0; i <= 6; ++i)
      for (int j = 0; j <= 6; ++j)
        for (int k = 0; k <= 6; ++k) t.insert(Point(i / 3.0 - 1, j / 3.0 - 1, k / 3.0 - 1));
  } else {
    for (int i = 0; i < 400; ++i) t.insert(inside(random));
  }
  return t;
}

}  // namespace

TEST_CASE("Theorem 2 implies theorem 1", "[independence]") {
  Seeded_random random(2008);
  std::size_t pairs = 0, all_found = 0, all_missed = 0;
  for (const Arrangement arrangement : arrangements) {
    std::size_t found = 0, missed = 0, dependent = 0;
    while (found + missed + dependent < 4000) {
      const Delaunay t = fine_triangulation(arrangement, random);
      for (int k = 0; k < 200; ++k) {
        const Point p = inside(random), q = inside(random);
        if (p == q || is_vertex(t, p) || is_vertex(t, q)) continue;
        CAPTURE(name(arrangement), t.number_of_vertices(), p, q);
        const auto s = pgdr::find_separating_subsegment(t, p, q);
        const bool independent = pgdr::are_delaunay_independent(t, p, q);
        if (s) {
          REQUIRE(independent);
          REQUIRE(s->largest_radius <= 0.5 * s->length);
          if (found % 16 == 0) REQUIRE(is_witness(t, p, q, *s));
        }
        ++(s ? found : independent ? missed : dependent);
      }
    }
    std::cout << name(arrangement) << ": " << found << " with a subsegment, " << missed
              << " independent without one, " << dependent << " dependent\n";
    CHECK(dependent > 20);
    pairs += found + missed + dependent;
    all_found += found;
    all_missed += missed;
  }
  std::cout << "independent pairs that theorem 2 misses: " << 100 * all_missed / (all_found + all_missed)
            << " %\n";
  CHECK(pairs >= 20000);
  CHECK(all_found > 1000);
  CHECK(all_missed > 1000);
}
