// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <pgdr/octree/octree_box.h>

#include "catch.h"
#include "seeded_random.h"

using pgdr::Octree_box;
using pgdr::Octree_key;

namespace {

using Point = std::array<double, 3>;

/// A coordinate in multiples of `unit`, a power of two; fails where it is none.
std::int64_t multiple(double c, double unit) {
  const double quotient = c / unit;
  REQUIRE(std::fabs(quotient) <= 0x1p53);
  REQUIRE(quotient == std::floor(quotient));
  return static_cast<std::int64_t>(quotient);
}

struct Sample {
  Point lower, upper;
};

Sample random_sample(pgdr_test::Random& random) {
  Sample s{};
  const double size = std::ldexp(random.between(0.5, 1), static_cast<int>(random.below(80)) - 40);
  const double distance = size * std::ldexp(1.0, static_cast<int>(random.below(60)) - 20);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    s.lower[axis] = distance * random.between(-1, 1);
    s.upper[axis] = s.lower[axis] + size * random.between(0, 1);
  }
  return s;
}

Octree_key random_key(pgdr_test::Random& random) {
  const auto level = static_cast<std::uint8_t>(random.below(Octree_key::max_level + 1));
  const std::uint32_t end = std::uint32_t{1} << level;
  return {random.below(end), random.below(end), random.below(end), level};
}

}  // namespace

TEST_CASE("the root of the unit cube is the unit cube") {
  const Octree_box box = Octree_box::around({0, 0, 0}, {1, 1, 1});
  CHECK(box.edge() == 1);
  CHECK(box.lower() == Point{0, 0, 0});
  CHECK(box.upper() == Point{1, 1, 1});
  CHECK(box.edge(3) == 0.125);
  CHECK(Octree_box::around({-1, -1, -1}, {1, 1, 1}).lower() == Point{-1, -1, -1});
  CHECK(Octree_box::around({0, 0, 0}, {1, std::nextafter(1.0, 2.0), 1}).edge() == 2);
}

TEST_CASE("the root contains the box and is the smallest that does") {
  pgdr_test::Seeded_random random(11);
  for (int trial = 0; trial < 2000; ++trial) {
    const Sample s = random_sample(random);
    const Octree_box box = Octree_box::around(s.lower, s.upper);
    int exponent = 0;
    CHECK(std::frexp(box.edge(), &exponent) == 0.5);
    bool half_fits = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(box.lower()[axis] <= s.lower[axis]);
      CHECK(s.upper[axis] <= box.upper()[axis]);
      const double half = box.edge() / 2;
      const double unit = std::ldexp(half, -Octree_key::max_level);
      half_fits = half_fits && std::fabs(s.lower[axis]) <= 0x1p28 * half &&
                  std::fabs(s.upper[axis]) <= 0x1p28 * half &&
                  s.upper[axis] <= std::floor(s.lower[axis] / unit) * unit + half;
    }
    CHECK_FALSE(half_fits);
  }
}

TEST_CASE("bounds of nodes, also moved by eighths of an edge, are exact") {
  pgdr_test::Seeded_random random(12);
  for (int trial = 0; trial < 2000; ++trial) {
    const Sample s = random_sample(random);
    const Octree_box box = Octree_box::around(s.lower, s.upper);
    const double unit = std::ldexp(box.edge(), -Octree_key::max_level - 3);  // an eighth of the smallest leaf
    const Octree_key key = random_key(random);
    const std::int64_t edge = std::int64_t{8} * key.edge_units();
    CHECK(multiple(box.edge(key.level), unit) == edge);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const std::int64_t expected = multiple(box.lower()[a], unit) + std::int64_t{8} * key.lower_units(axis);
      CHECK(multiple(box.lower(key)[a], unit) == expected);
      CHECK(multiple(box.upper(key)[a], unit) == expected + edge);
      const double shift = 3 * box.edge(key.level) / 8;
      CHECK(multiple(box.lower(key)[a] - shift, unit) == expected - 3 * edge / 8);
      CHECK(multiple(box.upper(key)[a] + shift, unit) == expected + edge + 3 * edge / 8);
    }
  }
}

TEST_CASE("points are located by the exact bounds, and moved into the root") {
  pgdr_test::Seeded_random random(13);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::uint32_t last = (std::uint32_t{1} << Octree_key::max_level) - 1;
  for (int trial = 0; trial < 2000; ++trial) {
    const Sample s = random_sample(random);
    const Octree_box box = Octree_box::around(s.lower, s.upper);
    const Octree_key key = random_key(random);
    const Point corner = box.lower(key);
    const Octree_key at = box.locate(corner);
    const Octree_key before =
        box.locate({std::nextafter(corner[0], -infinity), std::nextafter(corner[1], -infinity),
                    std::nextafter(corner[2], -infinity)});
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(at.lower_units(axis) == key.lower_units(axis));
      CHECK(before.lower_units(axis) + 1 == std::max(1U, key.lower_units(axis)));
    }
  }
  const Octree_box box = Octree_box::around({-1, -1, -1}, {1, 1, 1});
  CHECK(box.locate({-1e-30, 0, 1e-30}) == Octree_key{(last + 1) / 2 - 1, (last + 1) / 2, (last + 1) / 2, 20});
  CHECK(box.locate({-5, 1, infinity}) == Octree_key{0, last, last, 20});
  CHECK(box.locate({std::nan(""), -infinity, 0}) == Octree_key{0, 0, (last + 1) / 2, 20});
}

TEST_CASE("boxes without a root are refused, flat and tiny ones are not") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(Octree_box::around({0, 0, 0}, {1, -1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(Octree_box::around({0, std::nan(""), 0}, {1, 1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(Octree_box::around({0, 0, 0}, {infinity, 1, 1}), std::invalid_argument);
  CHECK_THROWS_AS(Octree_box::around({-0x1p1001, 0, 0}, {1, 1, 1}), std::invalid_argument);
  CHECK(Octree_box::around({0, 0, 0}, {0, 0, 0}).edge() > 0);
  CHECK(Octree_box::around({-0x1p1000, 0, 0}, {0x1p1000, 1, 1}).edge() == 0x1p1001);
  CHECK(Octree_box::around({3, 3, 3}, {3, 3, 3}).upper()[0] >= 3);
  const double tiny = std::numeric_limits<double>::denorm_min();
  CHECK(Octree_box::around({-tiny, 0, 0}, {1e10, 1, 1}).lower()[0] <= -tiny);
}
