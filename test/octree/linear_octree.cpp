// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <pgdr/octree/linear_octree_3.h>

#include "catch.h"
#include "octree/random_octree.h"
#include "seeded_random.h"

using pgdr::Linear_octree_3;
using pgdr::Octree_box;
using pgdr::Octree_key;
using pgdr_test::Seeded_random;
using pgdr_test::unit_cube;

namespace {

std::uint32_t find_by_scan(const Linear_octree_3& octree, const std::array<double, 3>& p) {
  for (std::uint32_t i = 0; i < octree.size(); ++i) {
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      inside = inside && octree.lower(i)[axis] <= p[axis] && p[axis] < octree.upper(i)[axis];
    }
    if (inside) return i;
  }
  return octree.size();
}

}  // namespace

TEST_CASE("an octree is one leaf, or all leaves of a level") {
  CHECK(Linear_octree_3(unit_cube()).size() == 1);
  for (int level = 0; level <= 4; ++level) {
    const Linear_octree_3 octree = Linear_octree_3::uniform(unit_cube(), level);
    CHECK(octree.size() == std::uint32_t{1} << (3 * level));
    CHECK(octree.is_valid());
    CHECK(octree.is_balanced());
    for (std::uint32_t i = 0; i < octree.size(); ++i) CHECK(octree[i].level == level);
  }
  CHECK_THROWS_AS(Linear_octree_3::uniform(unit_cube(), -1), std::invalid_argument);
  CHECK_THROWS_AS(Linear_octree_3::uniform(unit_cube(), 10), std::invalid_argument);
}

TEST_CASE("find gives the half-open leaf of a point and the leaf of a node") {
  Seeded_random random(21);
  for (int trial = 0; trial < 60; ++trial) {
    const Octree_box box = Octree_box::around({-3.7, 1.25, 100}, {4, 2, 101});
    const Linear_octree_3 octree = pgdr_test::random_octree(random, box, 6, 300);
    for (int sample = 0; sample < 50; ++sample) {
      std::array<double, 3> p{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double c =
            octree.lower(random.below(octree.size()))[axis];  // on a bound, beside it, or anywhere
        const std::uint32_t kind = random.below(3);
        p[axis] = kind == 0   ? c
                  : kind == 1 ? std::nextafter(c, -1e300)
                              : c + box.edge() * random.between(0, 1);
        p[axis] = std::clamp(p[axis], box.lower()[axis], std::nextafter(box.upper()[axis], -1e300));
      }
      CHECK(octree.find(p) == find_by_scan(octree, p));
    }
    for (std::uint32_t i = 0; i < octree.size(); ++i) {
      CHECK(octree.find(octree[i]) == i);
      if (octree[i].level < Octree_key::max_level) CHECK(octree.find(octree[i].child(5)) == i);
      if (octree[i].parity() == 0 && octree[i].level > 0) CHECK(octree.find(octree[i].parent()) == i);
    }
    CHECK(octree.find(std::array<double, 3>{-1e9, -1e9, -1e9}) == 0);
    CHECK(octree.find(std::array<double, 3>{1e9, 1e9, 1e9}) == octree.size() - 1);
  }
}

TEST_CASE("split replaces leaves by their children in place") {
  Seeded_random random(22);
  for (int trial = 0; trial < 100; ++trial) {
    const Linear_octree_3 octree = pgdr_test::random_octree(random, unit_cube(), 5, 200);
    std::vector<std::uint8_t> which(octree.size(), 0);
    std::uint32_t count = 0;
    for (auto& flag : which) {
      flag = random.below(3) == 0 ? static_cast<std::uint8_t>(1 + random.below(255)) : std::uint8_t{0};
      count += flag != 0;
    }
    std::vector<std::uint32_t> parent(3, 77);
    const Linear_octree_3 finer = octree.split(which, &parent);
    CHECK(finer.is_valid());
    CHECK(finer.size() == octree.size() + 7 * count);
    REQUIRE(parent.size() == finer.size());
    for (std::uint32_t j = 0; j < finer.size(); ++j) {
      CHECK(finer[j].level == octree[parent[j]].level + (which[parent[j]] != 0 ? 1 : 0));
      CHECK(contains(octree[parent[j]], finer[j]));
    }
    CHECK(std::is_sorted(finer.leaves().begin(), finer.leaves().end(), pgdr::precedes));
  }
  CHECK_THROWS_AS(Linear_octree_3(unit_cube()).split({1, 0}), std::invalid_argument);
}

TEST_CASE("leaves reach the deepest level and go no further") {
  Linear_octree_3 octree(unit_cube());
  const std::array<double, 3> p{0.3, 0.7, 0.1};
  for (int level = 0; level < Octree_key::max_level; ++level) {
    std::vector<std::uint8_t> which(octree.size(), 0);
    which[octree.find(p)] = 1;
    octree = octree.split(which);
  }
  const std::uint32_t leaf = octree.find(p);
  CHECK(octree.edge(leaf) == 0x1p-20);
  CHECK(octree.is_valid());
  CHECK(find_by_scan(octree, p) == leaf);
  std::vector<std::uint8_t> which(octree.size(), 0);
  which[leaf] = 1;
  CHECK_THROWS_AS(octree.split(which), std::invalid_argument);
}

TEST_CASE("is_valid sees every corruption of a list of leaves") {
  Seeded_random random(23);
  for (int trial = 0; trial < 100; ++trial) {
    const std::vector<Octree_key> leaves = pgdr_test::random_octree(random, unit_cube(), 4, 100).leaves();
    REQUIRE(leaves.size() > 1);
    CHECK(Linear_octree_3::is_valid(leaves));
    const auto refused = [](const std::vector<Octree_key>& bad) {
      CHECK_FALSE(Linear_octree_3::is_valid(bad));
      CHECK_THROWS_AS(Linear_octree_3(unit_cube(), bad), std::invalid_argument);
    };
    const auto i = random.below(static_cast<std::uint32_t>(leaves.size() - 1));
    std::vector<Octree_key> bad = leaves;
    bad.erase(bad.begin() + i);
    refused(bad);  // a hole
    bad = leaves;
    bad.insert(bad.begin() + i, leaves[i]);
    refused(bad);  // twice
    bad = leaves;
    std::swap(bad[i], bad[i + 1]);
    refused(bad);  // out of order
    bad = leaves;
    bad[i] = bad[i].parent();
    refused(bad);  // overlaps its siblings
    bad = leaves;
    bad[i] = bad[i].child(0);
    refused(bad);  // seven eighths are missing
    bad = leaves;
    bad[i].x += std::uint32_t{1} << bad[i].level;
    refused(bad);  // outside the root
    bad = leaves;
    bad.pop_back();
    refused(bad);
    bad = leaves;
    bad[i].level = 21;
    refused(bad);
  }
  CHECK_FALSE(Linear_octree_3::is_valid(std::vector<Octree_key>{}));
}
