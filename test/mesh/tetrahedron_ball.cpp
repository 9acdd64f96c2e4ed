// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/mesh/tetrahedron_ball.h>

#include <array>
#include <cmath>
#include <limits>

#include "catch.h"
#include "random.h"

namespace {

using pgdr::Tetrahedron_ball;
using pgdr::Tetrahedron_points;
using pgdr::Vec_3;
using pgdr_test::in_cube;
using pgdr_test::Random;

/// Corners near one plane, some of them also near one circle.
Tetrahedron_points flat(Random& random, double size, double height, bool is_cocircular) {
  const Vec_3 at = in_cube(random, 3 * size);
  Tetrahedron_points p;
  for (Vec_3& corner : p) {
    Vec_3 v = in_cube(random, size);
    if (is_cocircular) {
      const double r = std::hypot(v.x, v.y);
      v = {size / r * v.x, size / r * v.y, v.z};
    }
    corner = at + Vec_3{v.x, v.y, height * v.z};
  }
  return p;
}

void compare_balls(const Tetrahedron_ball& ball, const Tetrahedron_ball& rational) {
  if (rational.squared_radius == std::numeric_limits<double>::infinity()) {
    CHECK(ball.squared_radius == rational.squared_radius);
    return;
  }
  constexpr double roundings = 1e-15;
  CHECK(std::abs(ball.squared_radius - rational.squared_radius) <= 4 * roundings * rational.squared_radius);
  // Of the coordinates, too.
  const double radius = std::sqrt(rational.squared_radius), far = radius + length(rational.center);
  CHECK(length(ball.center - rational.center) <= 2 * roundings * far);
  CHECK(std::abs(ball.volume - rational.volume) <= roundings * std::abs(rational.volume));
  CHECK(ball.squared_shortest == rational.squared_shortest);
}

}  // namespace

TEST_CASE("The exact ball of a flat tetrahedron is that of rational numbers, of any size", "[mesh]") {
  Random random(7);
  // The last ones are where determinants in doubles would be denormal, or infinite.
  for (const double size : {1.0, 1e-3, 1e20, 1e-40, 1e-70, 1e-100, 1e33, 1e60})
    for (const double height : {1e-7, 1e-12, 1e-17, 0.0})
      for (int k = 0; k < 50; ++k) {
        const Tetrahedron_points p = flat(random, size, height, k % 2 == 1);
        compare_balls(pgdr::exact_tetrahedron_ball(p), pgdr::internal::rational_tetrahedron_ball(p));
      }
}

TEST_CASE("A tetrahedron that is exactly flat has no ball", "[mesh]") {
  const Tetrahedron_points p{Vec_3{0, 0, 0.1}, Vec_3{1, 0, 0.1}, Vec_3{0, 1, 0.1}, Vec_3{1, 1, 0.1}};
  CHECK(pgdr::exact_tetrahedron_ball(p).squared_radius == std::numeric_limits<double>::infinity());
  CHECK(pgdr::tetrahedron_ball(p).squared_radius == std::numeric_limits<double>::infinity());
}
