// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <pgdr/sizing/grid_sizing_field.h>
#include <pgdr/sizing/minimum_sizing_field.h>
#include <pgdr/sizing/uniform_sizing_field.h>

#include "catch.h"
#include "seeded_random.h"

namespace {

using Grid_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Grid_point = Grid_kernel::Point_3;

static_assert(pgdr::SizingField<pgdr::Grid_sizing_field, Grid_kernel>);
static_assert(pgdr::SizingField<pgdr::Minimum_sizing_field<pgdr::Uniform_sizing_field, pgdr::Grid_sizing_field>, Grid_kernel>);

const pgdr::Sizing_grid grid{{-1, 0, 2}, {0.5, 0.25, 1}, {5, 9, 4}};

}  // namespace

TEST_CASE("the minimum of several fields is a field", "[sizing]") {
  const auto slope = [](const Grid_point& p) { return p.x(); };
  const pgdr::Minimum_sizing_field least(pgdr::Uniform_sizing_field(0.5), slope, [](const Grid_point& p) { return p.y(); });
  CHECK(least(Grid_point(1, 2, 0)) == 0.5);
  CHECK(least(Grid_point(0.25, 2, 0)) == 0.25);
  CHECK(least(Grid_point(0.25, 0.125, 0)) == 0.125);
  CHECK(least(Grid_point(0.25, -1, 0)) == -1);
  CHECK(std::isnan(least(Grid_point(std::numeric_limits<double>::quiet_NaN(), 1, 0))));
  CHECK(std::isnan(least(Grid_point(1, std::numeric_limits<double>::quiet_NaN(), 0))));
}

TEST_CASE("sizes on a grid are trilinear, and constant beyond it", "[sizing]") {
  // A function that is linear in each coordinate comes out as it is.
  const auto trilinear = [](const Grid_point& p) { return 10 + p.x() + 2 * p.y() - 0.5 * p.z() + p.x() * p.y() * p.z() / 8; };
  const auto field = pgdr::Grid_sizing_field::sampled<Grid_point>(grid, trilinear);
  pgdr_test::Seeded_random random(7);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.between(-1, 1), y = random.between(0, 2), z = random.between(2, 5);
    CHECK(field(Grid_point(x, y, z)) == Approx(trilinear(Grid_point(x, y, z))).epsilon(1e-13));
  }
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto p = grid.point(i);
    CHECK(field(Grid_point(p[0], p[1], p[2])) == field.values()[i]);
  }
  CHECK(field(Grid_point(-7, 1, 3)) == field(Grid_point(-1, 1, 3)));
  CHECK(field(Grid_point(9, 9, 9)) == field(Grid_point(1, 2, 5)));
}

TEST_CASE("a gradation bounds how fast sizes on a grid grow, and takes no more away than it has to", "[sizing]") {
  const pgdr::Sizing_grid cubes{{-1, 0, 2}, {0.5, 0.5, 0.5}, {5, 9, 4}};
  std::vector<double> values(cubes.size(), 2);
  const std::size_t fine = 2 + 5 * (4 + 9 * 1);
  values[fine] = 0.125;
  const pgdr::Grid_sizing_field sharp(cubes, values), graded = sharp.graded(0.5);
  CHECK(graded.values()[fine] == 0.125);
  double largest = 0;
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    const auto p = cubes.point(i), q = cubes.point(fine);
    const double distance = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    CHECK(graded.values()[i] >= std::min(2.0, 0.125 + 0.5 * distance) * (1 - 1e-12));
    CHECK(graded.values()[i] <= std::min(2.0, 0.125 + 0.5 * 1.13 * distance) * (1 + 1e-12));
    largest = std::max(largest, graded.values()[i]);
    for (std::size_t j = 0; j < cubes.size(); ++j) {
      const auto r = cubes.point(j);
      const double way = std::hypot(p[0] - r[0], p[1] - r[1], p[2] - r[2]);
      CHECK(graded.values()[i] - graded.values()[j] <= 0.5 * 1.13 * way + 1e-12);
    }
  }
  CHECK(largest > 1);
  CHECK(sharp(Grid_point(-0.25, 2, 2.5)) > graded(Grid_point(-0.25, 2, 2.5)));
  CHECK(graded.graded(0.5).values() == graded.values());
  CHECK(sharp.graded(1e9).values() == values);
}

TEST_CASE("a grid that is none, and sizes that are none, are refused", "[sizing]") {
  CHECK_THROWS_AS(pgdr::Grid_sizing_field({{0, 0, 0}, {1, 1, 1}, {1, 2, 2}}, std::vector<double>(4, 1)), std::invalid_argument);
  CHECK_THROWS_AS(pgdr::Grid_sizing_field({{0, 0, 0}, {1, 0, 1}, {2, 2, 2}}, std::vector<double>(8, 1)), std::invalid_argument);
  CHECK_THROWS_AS(pgdr::Grid_sizing_field(grid, std::vector<double>(grid.size() - 1, 1)), std::invalid_argument);
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    std::vector<double> values(grid.size(), 1);
    values[17] = wrong;
    CHECK_THROWS_AS(pgdr::Grid_sizing_field(grid, values), std::invalid_argument);
  }
  const pgdr::Grid_sizing_field even(grid, std::vector<double>(grid.size(), 1));
  CHECK_THROWS_AS(even.graded(0), std::invalid_argument);
  CHECK_THROWS_AS(even.graded(-1), std::invalid_argument);
}
