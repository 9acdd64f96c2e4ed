// SPDX-License-Identifier: GPL-3.0-or-later
// The selection balls (selection_ball.h, docs/theory.md section 8) of random tetrahedra.
#include <pgdr/independence/selection_ball.h>

#include <algorithm>
#include <cmath>

#include <pgdr/refinement/point_placement.h>

#include "catch.h"
#include "seeded_random.h"

using pgdr::Vec_3;
using pgdr_test::Random;
using pgdr_test::Seeded_random;

namespace {

Vec_3 any_point(Random& random) {
  return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
}

double nearest_corner(const pgdr::Tetrahedron_points& corners, const Vec_3& p) {
  double nearest = 1e300;
  for (const Vec_3& c : corners) nearest = std::min(nearest, pgdr::length(p - c));
  return nearest;
}

}  // namespace

TEST_CASE("A point of a selection ball keeps its distance from the corners", "[independence]") {
  Seeded_random random(11);
  std::size_t over = 0, under = 0;
  for (int k = 0; k < 20000; ++k) {
    const pgdr::Tetrahedron_points corners{any_point(random), any_point(random), any_point(random),
                                           any_point(random)};
    const pgdr::Tetrahedron_ball ball = pgdr::tetrahedron_ball(corners);
    const double r = std::sqrt(ball.squared_radius), l = std::sqrt(ball.squared_shortest);
    const double bound = random.below(2) ? 2 : random.between(2, 6);
    const bool is_over = r > bound * l;
    ++(is_over ? over : under);
    const pgdr::Poor_tetrahedron t{corners, ball, is_over, bound};
    const double one = t.type_1_radius(), two = t.type_2_radius();
    CAPTURE(r, l, bound, one, two);
    REQUIRE(one < r);
    REQUIRE(two <= one * (1 + 1e-12));  // always inside
    if (is_over && bound == 2) REQUIRE(two == 0);
    // What is inserted in the end may be half as far away as the Steiner point: 2 l for type I.
    const double least_1 = is_over ? 2 * l : (1 - pgdr::size_selection_fraction) * r;
    const double least_2 = is_over ? 2 * r / bound : least_1;
    CHECK(least_2 >= least_1 * (1 - 1e-12));
    const Vec_3 direction = any_point(random);
    for (const double s : {one, two}) {
      const Vec_3 p = ball.center + (s / pgdr::length(direction)) * direction;
      REQUIRE(nearest_corner(corners, p) >= (s == one ? least_1 : least_2) * (1 - 1e-6));
    }
    REQUIRE(pgdr::length(pgdr::Type_1_placement()(t) - ball.center) <= one);
    REQUIRE(pgdr::length(pgdr::Type_2_placement()(t) - ball.center) <= two);
    REQUIRE(pgdr::length(pgdr::Circumcenter_placement()(t) - ball.center) == 0);
  }
  CHECK(over > 1000);
  CHECK(under > 1000);
}

TEST_CASE("The type-I point is where the ball is nearest to the shortest edge", "[independence]") {
  // A needle: the circumcenter is far from the short edge.
  const pgdr::Tetrahedron_points corners{Vec_3{0, 0, 0}, {0.1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const pgdr::Tetrahedron_ball ball = pgdr::tetrahedron_ball(corners);
  const pgdr::Poor_tetrahedron t{corners, ball, true, 2};
  const Vec_3 middle{0.05, 0, 0};
  CHECK(pgdr::length(pgdr::middle_of_shortest_edge(corners) - middle) == 0);
  const double s = t.type_1_radius(), far = pgdr::length(ball.center - middle);
  REQUIRE(s > 0);
  CHECK(pgdr::length(pgdr::Type_1_placement()(t) - middle) == Approx(far - s).epsilon(1e-5));
  CHECK(pgdr::length(pgdr::Type_2_placement()(t) - ball.center) == 0);
}
