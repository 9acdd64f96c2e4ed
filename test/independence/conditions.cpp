// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <pgdr/independence/buffer_condition.h>
#include <pgdr/independence/zone_condition.h>

#include "catch.h"
#include "octree/random_octree.h"
#include "seeded_random.h"

using pgdr::Buffer_condition;
using pgdr::Linear_octree_3;
using pgdr::Requirement;
using pgdr::Zone_condition;
using pgdr_test::Seeded_random;
using pgdr_test::unit_cube;

TEST_CASE("the zone condition asks for m < l*/8 within 3/8 l* of the leaf") {
  // One small leaf of edge 1/4 in the corner: the opposite leaf of edge 1/2 touches its siblings only.
  std::vector<std::uint8_t> which(8, 0);
  which[0] = 1;
  const Linear_octree_3 octree = Linear_octree_3::uniform(unit_cube(), 1).split(which);
  std::vector<Requirement> requirements(3);
  Zone_condition().requirements(octree, 0, requirements);
  REQUIRE(requirements.size() == 1);
  CHECK(requirements[0].hole_lower == std::array<double, 3>{0, 0, 0});
  CHECK(requirements[0].hole_upper == std::array<double, 3>{0.25, 0.25, 0.25});
  CHECK(requirements[0].lower == std::array<double, 3>{-0.09375, -0.09375, -0.09375});
  CHECK(requirements[0].upper == std::array<double, 3>{0.34375, 0.34375, 0.34375});
  CHECK(requirements[0].bound == 0.03125);
  CHECK_FALSE(requirements[0].circumball);
  // The leaf across the cube's diagonal meets the small ones in a corner: its l* is theirs.
  Zone_condition().requirements(octree, octree.size() - 1, requirements);
  CHECK(requirements[0].hole_lower == std::array<double, 3>{0.5, 0.5, 0.5});
  CHECK(requirements[0].lower == std::array<double, 3>{0.40625, 0.40625, 0.40625});
  CHECK(requirements[0].bound == 0.03125);
}

TEST_CASE("the zones of leaves that do not conflict are disjoint, by the requirements themselves") {
  Seeded_random random(51);
  std::size_t pairs = 0, closer = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const auto box = pgdr::Octree_box::around({-7.3, 0.1, 2}, {-6.1, 1.4, 2.2});
    const Linear_octree_3 octree = pgdr_test::random_octree(random, box, 7, 200);
    std::vector<Requirement> requirements(octree.size());
    std::vector<std::vector<std::uint32_t>> conflicts(octree.size());
    for (std::uint32_t i = 0; i < octree.size(); ++i) {
      std::vector<Requirement> one;
      Zone_condition().requirements(octree, i, one);
      requirements[i] = one.at(0);
      Zone_condition().conflicting(octree, i, conflicts[i]);
    }
    for (std::uint32_t i = 0; i < octree.size(); ++i) {
      for (std::uint32_t j = 0; j < octree.size(); ++j) {
        if (i == j || std::binary_search(conflicts[i].begin(), conflicts[i].end(), j)) continue;
        // The zone reaches 2d, four times the bound d/2, beyond the hole.
        const auto apart = [&](double reach) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const Requirement &a = requirements[i], &b = requirements[j];
            const double sum = reach * (a.bound + b.bound);
            if (b.hole_lower[axis] - a.hole_upper[axis] >= sum ||
                a.hole_lower[axis] - b.hole_upper[axis] >= sum) {
              return true;
            }
          }
          return false;
        };
        ++pairs;
        CHECK(apart(4));
        closer += !apart(4.1);  // a wider zone would not do
      }
    }
  }
  CHECK(pairs > 100000);
  CHECK(closer > 0);
}

TEST_CASE("the buffer condition asks for a sixth of the edge of every leaf of BUF") {
  Seeded_random random(52);
  for (int trial = 0; trial < 30; ++trial) {
    const Linear_octree_3 octree = pgdr_test::random_octree(random, unit_cube(), 5, 100);
    std::vector<Requirement> requirements;
    std::vector<std::uint32_t> buffer, conflicts;
    for (std::uint32_t i = 0; i < octree.size(); ++i) {
      octree.buffer(i, buffer);
      Buffer_condition().conflicting(octree, i, conflicts);
      CHECK(conflicts == buffer);
      Buffer_condition().requirements(octree, i, requirements);
      REQUIRE(requirements.size() == buffer.size());
      for (std::size_t k = 0; k < buffer.size(); ++k) {
        CHECK(requirements[k].circumball);
        CHECK(requirements[k].lower == octree.lower(buffer[k]));
        CHECK(requirements[k].upper == octree.upper(buffer[k]));
        CHECK(requirements[k].hole_lower == requirements[k].hole_upper);
        // Never above the true sixth: 6 * bound, without rounding, is at most the edge.
        CHECK(std::fma(6, requirements[k].bound, -octree.edge(buffer[k])) <= 0);
        CHECK(requirements[k].bound == Approx(octree.edge(buffer[k]) / 6));
      }
    }
  }
}
