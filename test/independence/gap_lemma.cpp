// SPDX-License-Identifier: GPL-3.0-or-later
// The gap lemma: leaves that do not touch are separated along some axis by at least the larger of their l*, the
// shortest edge among a leaf and those that touch it (zone_condition.h, docs/theory.md).
#include <algorithm>
#include <cstdint>
#include <vector>

#include <pgdr/independence/zone_condition.h>
#include <pgdr/octree/linear_octree_3.h>

#include "catch.h"
#include "octree/random_octree.h"
#include "seeded_random.h"

using pgdr::Linear_octree_3;
using pgdr::Octree_key;
using pgdr_test::Seeded_random;
using pgdr_test::unit_cube;

namespace {

/// The largest distance along one axis, in units of the smallest possible leaf; 0 or less where the cubes meet.
std::int64_t gap(const Octree_key& a, const Octree_key& b) {
  std::int64_t result = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t lower_a = a.lower_units(axis), lower_b = b.lower_units(axis);
    result = std::max({result, lower_b - lower_a - a.edge_units(), lower_a - lower_b - b.edge_units()});
  }
  return result;
}

/// What the lemma was asked for, and how close it came.
struct Tally {
  std::size_t pairs = 0;       ///< pairs of leaves that do not touch
  std::size_t violations = 0;  ///< of: gap >= max(l*_i, l*_j)
  std::size_t tight = 0;       ///< gap == max(l*_i, l*_j): any larger constant fails on these
  std::size_t edge_fails = 0;  ///< gap < max(l_i, l_j): the leaves' own edges would be too much
  std::size_t sum_fails = 0;   ///< gap < l*_i + l*_j

  void add(const Octree_key& a, std::int64_t shortest_a, const Octree_key& b, std::int64_t shortest_b) {
    const std::int64_t g = gap(a, b);
    ++pairs;
    violations += g < std::max(shortest_a, shortest_b);
    tight += g == std::max(shortest_a, shortest_b);
    edge_fails += g < std::max<std::int64_t>(a.edge_units(), b.edge_units());
    sum_fails += g < shortest_a + shortest_b;
  }
};

void add_all_pairs(const Linear_octree_3& octree, Tally& tally) {
  std::vector<std::int64_t> shortest(octree.size());
  for (std::uint32_t i = 0; i < octree.size(); ++i) {
    shortest[i] = static_cast<std::int64_t>(octree.shortest_touching_edge(i) * 0x1p20);
  }
  for (std::uint32_t i = 0; i < octree.size(); ++i) {
    for (std::uint32_t j = i + 1; j < octree.size(); ++j) {
      if (!touch(octree[i], octree[j])) tally.add(octree[i], shortest[i], octree[j], shortest[j]);
    }
  }
}

/// The leaves of the coarsest octree that has `a` and `b` as leaves.
void coarsest_leaves(const Octree_key& node, const Octree_key& a, const Octree_key& b,
                     std::vector<Octree_key>& out) {
  const bool above = (contains(node, a) && !(node == a)) || (contains(node, b) && !(node == b));
  if (!above) {
    out.push_back(node);
    return;
  }
  for (int c = 0; c < 8; ++c) coarsest_leaves(node.child(c), a, b, out);
}

std::int64_t shortest_touching(const std::vector<Octree_key>& leaves, const Octree_key& key) {
  std::int64_t result = key.edge_units();
  for (const Octree_key& leaf : leaves) {
    if (leaf.edge_units() < result && touch(leaf, key)) result = leaf.edge_units();
  }
  return result;
}

/// Every pair of nodes to a depth, of which neither contains the other and that do not touch, each in the coarsest
/// octree in which both are leaves. All other octrees with these leaves refine that one: they keep the gap and can
/// only lower l*. So this is every pair of leaves in every octree of the depth. By the symmetry of the cube, `a`
/// runs through the nodes in one of 48 wedges (and those across its boundary).
Tally every_octree(int depth) {
  std::vector<Octree_key> keys{Octree_key{}};
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Octree_key key = keys[i];
    if (key.level < depth) {
      for (int c = 0; c < 8; ++c) keys.push_back(key.child(c));
    }
  }
  Tally tally;
  std::vector<Octree_key> leaves;
  for (const Octree_key& a : keys) {
    const bool in_wedge = a.x <= a.y && a.y <= a.z && 2 * a.z <= (std::uint32_t{1} << a.level) - 1;
    if (!in_wedge) continue;
    for (const Octree_key& b : keys) {
      if (contains(a, b) || contains(b, a) || touch(a, b)) continue;
      leaves.clear();
      coarsest_leaves(Octree_key{}, a, b, leaves);
      tally.add(a, shortest_touching(leaves, a), b, shortest_touching(leaves, b));
    }
  }
  return tally;
}

}  // namespace

TEST_CASE("gap lemma: every pair of leaves of every octree to depth 4") {
  const Tally tally = every_octree(4);
  CHECK(tally.pairs > 400000);
  CHECK(tally.violations == 0);
  // The statement cannot be made stronger: these counts show that the test would see it.
  CHECK(tally.tight > 0);
  CHECK(tally.edge_fails > 0);
  CHECK(tally.sum_fails > 0);
}

TEST_CASE("gap lemma: every octree of two levels, leaf by leaf") {
  // All 2^8 ways to split the children of the root; l* from the octree itself.
  Tally tally;
  const Linear_octree_3 eight = Linear_octree_3::uniform(unit_cube(), 1);
  for (unsigned mask = 0; mask < 256; ++mask) {
    std::vector<std::uint8_t> which(8);
    for (unsigned c = 0; c < 8; ++c) which[c] = mask >> c & 1U;
    add_all_pairs(eight.split(which), tally);
  }
  CHECK(tally.pairs > 50000);
  CHECK(tally.violations == 0);
  CHECK(tally.tight > 0);
}

TEST_CASE("gap lemma: random octrees, balanced and not") {
  Seeded_random random(41);
  Tally tally;
  std::size_t steep = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Linear_octree_3 octree = pgdr_test::random_octree(random, unit_cube(), 3 + trial % 8, 400);
    steep += !octree.is_balanced();
    add_all_pairs(octree, tally);
    if (trial % 10 == 0) add_all_pairs(pgdr_test::balanced(octree), tally);
  }
  CHECK(steep > 100);
  CHECK(tally.pairs > 1000000);
  CHECK(tally.violations == 0);
  CHECK(tally.edge_fails > 0);
  CHECK(tally.sum_fails > 0);
}

TEST_CASE("gap lemma: uniform octrees to depth 4") {
  for (int depth = 1; depth <= 4; ++depth) {
    Tally tally;
    add_all_pairs(Linear_octree_3::uniform(unit_cube(), depth), tally);
    CHECK(tally.violations == 0);
    CHECK((depth == 1) == (tally.pairs == 0));
  }
}
