// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <pgdr/sizing/combined_sizing_field.h>
#include <pgdr/sizing/sizing_field.h>
#include <pgdr/sizing/uniform_sizing_field.h>

#include "catch.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Linear {
  double operator()(const Point& p) const { return 1 + p.x(); }
};

static_assert(pgdr::SizingField<pgdr::Uniform_sizing_field, Kernel>);
static_assert(pgdr::SizingField<pgdr::Combined_sizing_field, Kernel>);
static_assert(pgdr::SizingField<pgdr::Combined_sizing_field, Exact_kernel>);
static_assert(pgdr::SizingField<pgdr::Local_sizing_field<Linear>, Kernel>);
static_assert(pgdr::SizingField<double (*)(const Point&), Kernel>);
static_assert(!pgdr::SizingField<double, Kernel>);
static_assert(!pgdr::SizingField<Linear, Exact_kernel>);

}  // namespace

TEST_CASE("a uniform sizing field is the same everywhere", "[sizing]") {
  CHECK(pgdr::Uniform_sizing_field(0.25)(Point(1, 2, 3)) == 0.25);
  CHECK(pgdr::Uniform_sizing_field()(Point(1, 2, 3)) == infinity);
  CHECK(pgdr::unbounded_sizing_field().radius() == infinity);
  const auto lambda = [](const Point& p) { return p.x(); };
  CHECK(pgdr::SizingField<decltype(lambda), Kernel>);
}

TEST_CASE("the smallest bound wins where boxes overlap", "[sizing]") {
  const pgdr::Combined_sizing_field sizing(
      pgdr::Uniform_sizing_field(1.0),
      {{{0, 0, 0}, {2, 2, 2}, 0.5}, {{1, 1, 1}, {3, 3, 3}, 0.25}, {{1, 1, 1}, {9, 9, 9}, 4.0}});
  CHECK(sizing(Point(0.5, 0.5, 0.5)) == 0.5);
  CHECK(sizing(Point(1.5, 1.5, 1.5)) == 0.25);
  CHECK(sizing(Point(2.5, 2.5, 2.5)) == 0.25);
  CHECK(sizing(Point(5, 5, 5)) == 1.0);
  CHECK(sizing(Point(-1, 0, 0)) == 1.0);
  CHECK(sizing(Point(0, 2, 0)) == 0.5);  // closed
  CHECK(sizing(Exact_kernel::Point_3(0, 2, 0)) == 0.5);
}

TEST_CASE("boxes refine any outer field", "[sizing]") {
  const pgdr::Local_sizing_field<Linear> sizing(Linear{}, {{{0, 0, 0}, {4, 1, 1}, 2.0}});
  CHECK(sizing(Point(0.5, 0, 0)) == 1.5);
  CHECK(sizing(Point(3, 0, 0)) == 2.0);
  CHECK(sizing(Point(3, 2, 0)) == 4.0);
  CHECK(pgdr::Combined_sizing_field()(Point(0, 0, 0)) == infinity);
}

TEST_CASE("balls refine, and their border belongs to them", "[sizing]") {
  const pgdr::Combined_sizing_field::Local sizing(pgdr::Uniform_sizing_field(1), {{{0, 0, 0}, {1, 1, 1}, 0.5}}, {{{0, 0, 0}, 2, 0.25}, {{9, 0, 0}, 0, 0.1}});
  CHECK(sizing(Point(0, 0, 2)) == 0.25);
  CHECK(sizing(Point(0, 0, 2.001)) == 1);
  CHECK(sizing(Point(1, 1, 1)) == 0.25);
  CHECK(sizing(Point(9, 0, 0)) == 0.1);
  CHECK(sizing(Point(9, 0, 1e-9)) == 1);
}

TEST_CASE("with a gradation sizes grow from a place with the distance, and no faster anywhere", "[sizing]") {
  const pgdr::Combined_sizing_field::Local sizing(pgdr::Uniform_sizing_field(1), {{{0, 0, 0}, {1, 1, 1}, 0.1}, {{5, 0, 0}, {6, 1, 1}, 0.3}}, {{{0, 0, 4}, 0.5, 0.2}}, 0.25);
  CHECK(sizing(Point(0.5, 0.5, 0.5)) == 0.1);
  CHECK(sizing(Point(3, 1, 1)) == Approx(0.1 + 0.25 * 2));
  CHECK(sizing(Point(2, 2, 1)) == Approx(0.1 + 0.25 * std::sqrt(2.0)));
  CHECK(sizing(Point(4.5, 0, 0)) == Approx(0.3 + 0.25 * 0.5));
  CHECK(sizing(Point(0, 0, 5)) == Approx(0.2 + 0.25 * 0.5));
  CHECK(sizing(Point(50, 50, 50)) == 1);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> r(-2, 8);
  for (int i = 0; i < 10000; ++i) {
    const double px = r(random), py = r(random), pz = r(random), qx = r(random), qy = r(random), qz = r(random);
    const Point p(px, py, pz), q(qx, qy, qz);
    REQUIRE(std::abs(sizing(p) - sizing(q)) <= 0.25 * std::sqrt(CGAL::squared_distance(p, q)) + 1e-12);
  }
  for (const double scale : {1e-200, 1e200}) {
    const pgdr::Combined_sizing_field::Local scaled(pgdr::Uniform_sizing_field(scale), {{{0, 0, 0}, {scale, scale, scale}, 0.1 * scale}}, {{{0, 0, 4 * scale}, 0.5 * scale, 0.2 * scale}}, 0.25);
    CHECK(scaled(Point(2 * scale, 2 * scale, scale)) == Approx((0.1 + 0.25 * std::sqrt(2.0)) * scale));
    CHECK(scaled(Point(0, scale, 4 * scale)) == Approx((0.2 + 0.25 * 0.5) * scale));
  }
  // Without a bound elsewhere, the places' grow for ever.
  const pgdr::Combined_sizing_field::Local open({}, {}, {{{0, 0, 0}, 0, 0.1}}, 0.5);
  CHECK(open(Point(100, 0, 0)) == Approx(50.1));
}

TEST_CASE("sizes by the distance from triangles", "[sizing]") {
  const std::vector<pgdr::Distance_sizing_field::Triangle> triangles{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                                                      {{{0, 0, 5}, {1, 0, 5}, {0, 1, 5}}},
                                                                      {{{2, 2, 2}, {3, 3, 3}, {4, 4, 4}}}};  // no area: of no account
  const pgdr::Distance_sizing_field sizing(triangles, 0.1, 0.5, 2);
  CHECK(sizing(Point(0.2, 0.2, 0)) == 0.1);
  CHECK(sizing(Point(0.2, 0.2, 1)) == Approx(0.3));
  CHECK(sizing(Point(0.2, 0.2, -2)) == Approx(0.5));
  CHECK(sizing(Point(0.2, 0.2, 4.5)) == Approx(0.2));
  CHECK(sizing(Point(3, 3, 3)) == 0.5);
  CHECK(sizing.distance({3, 0, 0}) == Approx(2));
  const pgdr::Distance_sizing_field wide(triangles, 0.1, 0.5, 2, 0.5);
  CHECK(wide(Point(0.2, 0.2, 0.5)) == 0.1);
  CHECK(wide(Point(0.2, 0.2, 1.5)) == Approx(0.3));
  const pgdr::Combined_sizing_field both(pgdr::Combined_sizing_field::Local(pgdr::Uniform_sizing_field(0.25)), {sizing});
  CHECK(both(Point(0.2, 0.2, 0)) == 0.1);
  CHECK(both(Point(0.2, 0.2, 1)) == 0.25);
  CHECK(both(Exact_kernel::Point_3(0, 0, 0)) == 0.1);
  using Field = pgdr::Distance_sizing_field;
  CHECK_THROWS_AS(Field({}, 0.1, 0.5, 2), std::invalid_argument);
  CHECK_THROWS_AS(Field({triangles[2]}, 0.1, 0.5, 2), std::invalid_argument);
  CHECK_THROWS_AS(Field(triangles, 0.1, 0.5, 2, -1), std::invalid_argument);
  for (const auto& [near, far, reach] : {std::array{0.0, 1.0, 1.0}, {2, 1, 1}, {1, infinity, 1}, {1, 2, 0}, {1, 2, infinity}, {1, 2, 1}, {not_a_number, 1, 1}})
    CHECK_THROWS_AS(Field(triangles, near, far, reach), std::invalid_argument);
}

TEST_CASE("with a limit it is known whether a size is below, wherever the surface is and however large", "[sizing]") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> r(0, 1);
  for (const double scale : {1.0, 1e-200, 1e200})
    for (const double offset : {0.0, 5e6}) {
      const auto point = [&] {
        const double x = r(random), y = r(random), z = r(random);
        return std::array<double, 3>{scale * (x + offset), scale * (y - offset), scale * z};
      };
      std::vector<pgdr::Distance_sizing_field::Triangle> triangles;
      for (int i = 0; i < 20; ++i) {
        const auto a = point(), b = point(), c = point();
        triangles.push_back({a, b, c});
      }
      const pgdr::Distance_sizing_field near(triangles, 0.01 * scale, 0.2 * scale, 0.4 * scale);
      CHECK((1 < near.area(scale) && near.area(scale) < 40));
      const pgdr::Combined_sizing_field field(pgdr::Combined_sizing_field::Local(pgdr::Uniform_sizing_field(0.15 * scale)), {near});
      int below = 0;
      for (int i = 0; i < 3000; ++i) {
        const auto p = point();
        const Point q(p[0], p[1], p[2]);
        const double size = field(q);
        for (const double limit : {size * (1 + 1e-6), size * (1 - 1e-6), scale * 0.3 * r(random)}) {
          const double found = field.size_if_below(q, [limit] { return limit; });
          REQUIRE((found < limit) == (size < limit));
          if (found < limit) REQUIRE(found >= size);
          // Else so far above that the refinement need not ask again.
          if (size > limit * (1 + 5e-7)) REQUIRE(found > limit * (1 + 1e-7));
        }
        below += size < 0.1 * scale;
      }
      CHECK((300 < below && below < 2990));
    }
}

TEST_CASE("nonsense sizes are refused", "[sizing]") {
  CHECK_THROWS_AS(pgdr::Uniform_sizing_field(0), std::invalid_argument);
  CHECK_THROWS_AS(pgdr::Uniform_sizing_field(-1), std::invalid_argument);
  CHECK_THROWS_AS(pgdr::Uniform_sizing_field(not_a_number), std::invalid_argument);
  using pgdr::Combined_sizing_field;
  const pgdr::Uniform_sizing_field base;
  CHECK_THROWS_AS(Combined_sizing_field(base, {{{0, 0, 0}, {1, 1, 1}, 0}}), std::invalid_argument);
  CHECK_THROWS_AS(Combined_sizing_field(base, {{{0, 0, 0}, {1, 1, 0}, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(Combined_sizing_field(base, {{{0, not_a_number, 0}, {1, 1, 1}, 1}}), std::invalid_argument);
  using Local = Combined_sizing_field::Local;
  CHECK_THROWS_AS(Local(base, {}, {{{0, 0, 0}, 1, 0}}), std::invalid_argument);
  CHECK_THROWS_AS(Local(base, {}, {{{0, 0, 0}, -1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(Local(base, {}, {{{0, not_a_number, 0}, 1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(Local(base, {}, {}, 0), std::invalid_argument);
  CHECK_THROWS_AS(Local(base, {}, {}, not_a_number), std::invalid_argument);
}
