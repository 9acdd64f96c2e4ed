// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include <pgdr/octree/linear_octree_3.h>

#include "catch.h"
#include "octree/random_octree.h"
#include "seeded_random.h"

using pgdr::Linear_octree_3;
using pgdr_test::Seeded_random;
using pgdr_test::unit_cube;

namespace {

using Leaves = std::vector<std::uint32_t>;

/// Leaf j shares a piece of a face with leaf i in a direction, by the bounds of both.
bool share_face(const Linear_octree_3& octree, std::uint32_t i, int direction, std::uint32_t j) {
  const auto axis = static_cast<std::size_t>(direction / 2);
  for (std::size_t other = 0; other < 3; ++other) {
    if (other == axis) continue;
    if (octree.upper(i)[other] <= octree.lower(j)[other] ||
        octree.upper(j)[other] <= octree.lower(i)[other]) {
      return false;
    }
  }
  return direction % 2 == 1 ? octree.upper(i)[axis] == octree.lower(j)[axis]
                            : octree.lower(i)[axis] == octree.upper(j)[axis];
}

/// Neighbours by scanning all pairs.
struct Scan {
  explicit Scan(const Linear_octree_3& octree)
      : faces(octree.size(), std::vector<Leaves>(6)), touching(octree.size()) {
    for (std::uint32_t i = 0; i < octree.size(); ++i) {
      for (std::uint32_t j = 0; j < octree.size(); ++j) {
        if (i == j) continue;
        bool meet = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          meet = meet && octree.lower(i)[axis] <= octree.upper(j)[axis] &&
                 octree.lower(j)[axis] <= octree.upper(i)[axis];
        }
        if (meet) touching[i].push_back(j);
        for (int a = 0; a < 6; ++a) {
          if (share_face(octree, i, a, j)) faces[i][static_cast<std::size_t>(a)].push_back(j);
        }
      }
    }
  }

  /// The definition: all that a walk reaches whose steps use no axis twice.
  Leaves buffer(std::uint32_t leaf) const {
    std::set<std::uint32_t> result;
    walk(leaf, 0, result);
    return {result.begin(), result.end()};
  }

  void walk(std::uint32_t leaf, unsigned used_axes, std::set<std::uint32_t>& result) const {
    for (unsigned a = 0; a < 6; ++a) {
      if (used_axes >> (a / 2) & 1U) continue;
      for (const std::uint32_t next : faces[leaf][a]) {
        result.insert(next);
        walk(next, used_axes | 1U << (a / 2), result);
      }
    }
  }

  std::vector<std::vector<Leaves>> faces;
  std::vector<Leaves> touching;
};

void compare_with_scan(const Linear_octree_3& octree) {
  const Scan scan(octree);
  Leaves found;
  bool steep = false;
  for (std::uint32_t i = 0; i < octree.size(); ++i) {
    octree.touching(i, found);
    CHECK(found == scan.touching[i]);
    double shortest = octree.edge(i);
    for (const std::uint32_t j : scan.touching[i]) {
      shortest = std::min(shortest, octree.edge(j));
      steep = steep || octree.edge(j) * 2 < octree.edge(i);
    }
    CHECK(octree.shortest_touching_edge(i) == shortest);
    for (int a = 0; a < 6; ++a) {
      octree.face_neighbors(i, a, found);
      CHECK(found == scan.faces[i][static_cast<std::size_t>(a)]);
    }
    octree.buffer(i, found);
    CHECK(found == scan.buffer(i));
  }
  CHECK(octree.is_balanced() == !steep);
}

}  // namespace

TEST_CASE("touching leaves, face neighbours and BUF are what a scan of all pairs finds") {
  Seeded_random random(31);
  std::size_t unbalanced = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Linear_octree_3 octree = pgdr_test::random_octree(random, unit_cube(), 5, 120);
    unbalanced += !octree.is_balanced();
    compare_with_scan(octree);
    if (trial % 6 == 0) compare_with_scan(pgdr_test::balanced(octree));
  }
  CHECK(unbalanced > 10);
  compare_with_scan(Linear_octree_3(unit_cube()));
  compare_with_scan(Linear_octree_3::uniform(unit_cube(), 2));
}

TEST_CASE("BUF is symmetric, holds all touching leaves and not the leaf itself") {
  Seeded_random random(32);
  for (int trial = 0; trial < 60; ++trial) {
    const Linear_octree_3 octree = pgdr_test::random_octree(random, unit_cube(), 6, 200);
    std::vector<Leaves> buffers(octree.size());
    Leaves touching;
    for (std::uint32_t i = 0; i < octree.size(); ++i) octree.buffer(i, buffers[i]);
    for (std::uint32_t i = 0; i < octree.size(); ++i) {
      octree.touching(i, touching);
      CHECK(std::includes(buffers[i].begin(), buffers[i].end(), touching.begin(), touching.end()));
      CHECK_FALSE(std::binary_search(buffers[i].begin(), buffers[i].end(), i));
      for (const std::uint32_t j : buffers[i])
        CHECK(std::binary_search(buffers[j].begin(), buffers[j].end(), i));
    }
  }
}

TEST_CASE("a leaf of a uniform octree touches 26 leaves and they are its BUF") {
  const Linear_octree_3 octree = Linear_octree_3::uniform(unit_cube(), 3);
  Leaves touching, buffer;
  std::size_t inner = 0;
  for (std::uint32_t i = 0; i < octree.size(); ++i) {
    octree.touching(i, touching);
    octree.buffer(i, buffer);
    CHECK(touching == buffer);
    inner += touching.size() == 26;
  }
  CHECK(inner == 6 * 6 * 6);
}

TEST_CASE("leaves of one level and one parity never touch") {
  Seeded_random random(33);
  Leaves touching;
  for (int trial = 0; trial < 100; ++trial) {
    const Linear_octree_3 octree = pgdr_test::random_octree(random, unit_cube(), 6, 300);
    for (std::uint32_t i = 0; i < octree.size(); ++i) {
      octree.touching(i, touching);
      for (const std::uint32_t j : touching) {
        CHECK((octree[i].level != octree[j].level || octree[i].parity() != octree[j].parity()));
      }
    }
  }
}
