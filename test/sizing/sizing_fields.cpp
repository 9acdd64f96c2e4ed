// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>
#include <stdexcept>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <pgdr/sizing/box_sizing_field.h>
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
static_assert(pgdr::SizingField<pgdr::Command_line_sizing, Kernel>);
static_assert(pgdr::SizingField<pgdr::Command_line_sizing, Exact_kernel>);
static_assert(pgdr::SizingField<pgdr::Box_sizing_field<Linear>, Kernel>);
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
  const pgdr::Command_line_sizing sizing(
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
  const pgdr::Box_sizing_field<Linear> sizing(Linear{}, {{{0, 0, 0}, {4, 1, 1}, 2.0}});
  CHECK(sizing(Point(0.5, 0, 0)) == 1.5);
  CHECK(sizing(Point(3, 0, 0)) == 2.0);
  CHECK(sizing(Point(3, 2, 0)) == 4.0);
  CHECK(pgdr::Command_line_sizing()(Point(0, 0, 0)) == infinity);
}

TEST_CASE("nonsense sizes are refused", "[sizing]") {
  CHECK_THROWS_AS(pgdr::Uniform_sizing_field(0), std::invalid_argument);
  CHECK_THROWS_AS(pgdr::Uniform_sizing_field(-1), std::invalid_argument);
  CHECK_THROWS_AS(pgdr::Uniform_sizing_field(not_a_number), std::invalid_argument);
  using pgdr::Command_line_sizing;
  const pgdr::Uniform_sizing_field base;
  CHECK_THROWS_AS(Command_line_sizing(base, {{{0, 0, 0}, {1, 1, 1}, 0}}), std::invalid_argument);
  CHECK_THROWS_AS(Command_line_sizing(base, {{{0, 0, 0}, {1, 1, 0}, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(Command_line_sizing(base, {{{0, not_a_number, 0}, {1, 1, 1}, 1}}), std::invalid_argument);
}
