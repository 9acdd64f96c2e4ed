// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/nodal_sizing_field.h>

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "../catch.h"

namespace {

using Node = pgdr::Nodal_sizing_field::Point;

double linear_size(const Node& p) { return 10 + p[0] - 2 * p[1] + 0.5 * p[2]; }

}  // namespace

TEST_CASE("a linear function of the nodes is reproduced inside, and the nearest node counts outside") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> in_cube(-1, 1);
  std::vector<Node> points;
  std::vector<double> values;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  for (int i = 0; i < 300; ++i) points.push_back({in_cube(random), in_cube(random), in_cube(random)});
  for (const Node& p : points) values.push_back(linear_size(p));
  points.push_back(points[3]);  // twice, the first one counts
  values.push_back(1e6);
  const pgdr::Nodal_sizing_field field(points, values);
  for (int i = 0; i < 1000; ++i) {
    const Node p{in_cube(random), in_cube(random), in_cube(random)};
    CHECK(std::abs(field.size_at(p) - linear_size(p)) < 1e-9);
  }
  CHECK(field.size_at({5, 5, 5}) == linear_size({1, 1, 1}));
}

TEST_CASE("nodes in a plane, or only one, make a field of nearest values") {
  const pgdr::Nodal_sizing_field one({{0, 0, 0}}, {0.5});
  CHECK(one.size_at({3, 4, 5}) == 0.5);
  const pgdr::Nodal_sizing_field plane({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {1, 2, 3, 4});
  CHECK(plane.size_at({0.9, 0.8, 7}) == 4);
}

TEST_CASE("values that make no sense are refused") {
  CHECK_THROWS_AS(pgdr::Nodal_sizing_field({}, {}), std::invalid_argument);
  CHECK_THROWS_AS(pgdr::Nodal_sizing_field({{0, 0, 0}}, {1, 2}), std::invalid_argument);
  CHECK_THROWS_AS(pgdr::Nodal_sizing_field({{0, 0, 0}}, {0}), std::invalid_argument);
  CHECK_THROWS_AS(pgdr::Nodal_sizing_field({{0, 0, 0}}, {std::nan("")}), std::invalid_argument);
}
