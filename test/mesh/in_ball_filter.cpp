// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/mesh/in_ball_filter.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "catch.h"
#include "random.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using pgdr::Vec_3;
using pgdr_test::in_cube;
using pgdr_test::Random;

Point point(const Vec_3& v) { return Point(v.x, v.y, v.z); }

/// 1 inside, -1 outside, 0 on the sphere. \pre the tetrahedron is positive
int exact(const Vec_3& a, const Vec_3& b, const Vec_3& c, const Vec_3& d, const Vec_3& p) {
  return static_cast<int>(Kernel().side_of_oriented_sphere_3_object()(point(a), point(b), point(c), point(d), point(p)));
}
int exact(const Vec_3& a, const Vec_3& b, const Vec_3& c, const Vec_3& p) {
  return static_cast<int>(Kernel().side_of_bounded_sphere_3_object()(point(a), point(b), point(c), point(p)));
}

/// Points around a place, as far apart as `size`, within `height` of a plane, and on a grid or not.
struct Crowd {
  Random& random;
  Vec_3 at;
  double size, height;
  bool is_on_grid;

  Vec_3 next() const {
    Vec_3 v = in_cube(random, size);
    v.z *= height;
    if (is_on_grid) v = {std::round(v.x * 3 / size) * size / 3, std::round(v.y * 3 / size) * size / 3, v.z};
    return at + v;
  }
};

/// How many questions there were, and how many of them were decided in doubles, or at all.
struct Tally {
  std::size_t all = 0, in_doubles = 0, told = 0;
};

/// Compares the filters with the exact predicates, points close to the sphere, flat elements and needles among them.
Tally compare(Random& random, int number, double size, double height, double distance) {
  Tally tally;
  for (int k = 0; k < number; ++k) {
    const Crowd crowd{random, in_cube(random, 30), size, height, random.below(3) == 0};
    Vec_3 a = crowd.next(), b = crowd.next();
    const Vec_3 c = crowd.next(), d = crowd.next();
    const CGAL::Orientation turn = CGAL::orientation(point(a), point(b), point(c), point(d));
    if (CGAL::collinear(point(a), point(b), point(c)) || turn == CGAL::ZERO) continue;
    if (turn == CGAL::NEGATIVE) std::swap(a, b);
    Vec_3 p = crowd.next() + in_cube(random, distance);
    if (random.below(4) == 0) {
      // All but on the sphere.
      const Point q = CGAL::circumcenter(point(a), point(b), point(c));
      const Vec_3 center{q.x(), q.y(), q.z()};
      p = center - (a - center);
    }
    const auto check = [&](int in_doubles, int extended, int both, int is) {
      if (in_doubles != 0) REQUIRE(in_doubles == is);
      if (pgdr::has_extended_precision && extended != 0) REQUIRE(extended == is);
      REQUIRE((both == 0 || both == is));
      ++tally.all;
      tally.in_doubles += in_doubles != 0;
      tally.told += both != 0;
    };
    using Short = pgdr::In_ball_filter<double>;
    using Long = pgdr::In_ball_filter<long double>;
    check(Short::side(a, b, c, d, p), Long::side(a, b, c, d, p), pgdr::side_of_ball(a, b, c, d, p), exact(a, b, c, d, p));
    check(Short::side(a, b, c, p), Long::side(a, b, c, p), pgdr::side_of_ball(a, b, c, p), exact(a, b, c, p));
  }
  return tally;
}

}  // namespace

TEST_CASE("The filters of the in-ball predicates say what the exact predicates say, or nothing", "[mesh]") {
  Random random(3);
  for (const double size : {1e-7, 1e-3, 1.0, 20.0})
    for (const double height : {1.0, 1e-6, 1e-12, 1e-15})
      for (const double distance : {0.0, 1e-6, 1.0}) {
        CAPTURE(size, height, distance);
        compare(random, 2000, size, height, distance);
      }
}

TEST_CASE("The filters tell that what is far from a small element is outside", "[mesh]") {
  Random random(4);
  const Tally small = compare(random, 2000, 1e-7, 1, 1);
  CHECK(small.in_doubles * 10 > small.all * 7);  // all but those made to be on the sphere
  if (pgdr::has_extended_precision) {
    const Tally flat = compare(random, 2000, 1, 1e-14, 1);
    CHECK(flat.told > flat.in_doubles);
    CHECK(flat.told * 10 > flat.all * 7);
  }
}

TEST_CASE("The filters say nothing where products lose bits to underflow, or overflow", "[mesh]") {
  for (const double e : {1e-70, 1e-200, 1e100, 1e300}) {
    const Vec_3 a{0, 0, 0}, b{e, 0, 0}, c{0, e, 0}, d{0, 0, e}, p{2 * e, 2 * e, 2 * e};
    CHECK(pgdr::In_ball_filter<double>::side(a, b, c, d, p) == 0);
    CHECK(pgdr::In_ball_filter<double>::side(a, b, c, p) == 0);
  }
}
