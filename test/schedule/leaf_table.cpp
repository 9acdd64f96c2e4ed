// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/schedule/leaf_table.h>
#include <pgdr/schedule/task_order.h>

#include <algorithm>
#include <array>
#include <vector>

#include "catch.h"
#include "octree/random_octree.h"
#include "schedule/list_engine.h"
#include "seeded_random.h"

using namespace pgdr_test;
using pgdr::Linear_octree_3;
using pgdr::Octree_key;

TEST_CASE("The order of tasks is a strict total order on the leaves", "[schedule]") {
  Seeded_random random(5);
  for (std::uint64_t round = 0; round < 20; ++round) {
    const Linear_octree_3 octree = balanced(random_octree(random, unit_cube(), 6, 200));
    const pgdr::Task_order before{round / 2};  // the usual one, and random ones
    std::vector<Octree_key> leaves = octree.leaves();
    std::sort(leaves.begin(), leaves.end(), before);
    // Compatible with the positions in one list: total, irreflexive, transitive.
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i)
      for (std::size_t j = 0; j < leaves.size(); ++j) wrong += before(leaves[i], leaves[j]) != (i < j);
    CAPTURE(round, leaves.size());
    CHECK(wrong == 0);
  }
}

TEST_CASE("Larger leaves go first, and chains of tasks that wait for each other are short", "[schedule]") {
  Seeded_random random(6);
  for (int round = 0; round < 20; ++round) {
    const Linear_octree_3 octree = balanced(random_octree(random, unit_cube(), 6, 500));
    std::vector<std::uint32_t> order(octree.size()), length(octree.size(), 1), touching;
    for (std::uint32_t i = 0; i < octree.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return pgdr::Task_order()(octree[a], octree[b]); });
    std::uint32_t longest = 0, levels = 1;
    for (const std::uint32_t i : order) {
      octree.touching(i, touching);
      for (const std::uint32_t n : touching) {
        if (octree[n].level < octree[i].level) CHECK(pgdr::Task_order()(octree[n], octree[i]));
        if (pgdr::Task_order()(octree[n], octree[i])) length[i] = std::max(length[i], length[n] + 1);
      }
      longest = std::max(longest, length[i]);
      levels = std::max<std::uint32_t>(levels, octree[i].level + 1u);
    }
    CAPTURE(round, octree.size());
    // Eight colours a level: equal leaves of one colour do not touch.
    CHECK(longest <= 8 * levels);
  }
}

TEST_CASE("Every point of space is in the region of the leaf that is found for it", "[schedule]") {
  Seeded_random random(7);
  const Linear_octree_3 octree = random_octree(random, unit_cube(), 5, 300);
  for (int k = 0; k < 2000; ++k) {
    std::array<double, 3> p{};
    for (double& x : p) x = k % 3 == 0 ? random.below(65) / 64.0 : random.between(-0.5, 1.5);
    std::vector<std::uint32_t> in;
    for (std::uint32_t i = 0; i < octree.size(); ++i)
      if (pgdr::leaf_region(octree, i).contains({p[0], p[1], p[2]})) in.push_back(i);
    CAPTURE(k, p[0], p[1], p[2]);
    REQUIRE(in.size() == 1);
    CHECK(in[0] == octree.find(p));
  }
}

TEST_CASE("Leaves know those that touch them, and their slots for them", "[schedule]") {
  Seeded_random random(8);
  const Linear_octree_3 octree = balanced(random_octree(random, unit_cube(), 6, 400));
  std::vector<pgdr::Scheduled_leaf<List_engine>> leaves(octree.size());
  leaves[0].outbox.resize(3);  // of an octree before
  pgdr::connect_leaves(octree, leaves);
  for (std::uint32_t i = 0; i < octree.size(); ++i) {
    const auto& leaf = leaves[i];
    double shortest = octree.edge(i);
    std::size_t touching = 0;
    for (std::uint32_t n = 0; n < octree.size(); ++n) {
      const bool near = n != i && pgdr::touch(octree[i], octree[n]);
      touching += near;
      CHECK((leaf.slot_of(n) < leaf.outbox.size()) == near);
      if (near) shortest = std::min(shortest, octree.edge(n));
    }
    CHECK(leaf.touching.size() == touching);
    CHECK(leaf.outbox.size() == touching);
    CHECK(leaf.edge == octree.edge(i));
    CHECK(leaf.shortest == shortest);
  }
}
