// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_OCTREE_RANDOM_OCTREE_H
#define PGDR_TEST_OCTREE_RANDOM_OCTREE_H

#include <cstdint>
#include <vector>

#include <pgdr/octree/linear_octree_3.h>

#include "mesh/random.h"

namespace pgdr_test {

inline pgdr::Octree_box unit_cube() { return pgdr::Octree_box::around({0, 0, 0}, {1, 1, 1}); }

/// Splits leaves at random: a few of them everywhere, or again and again the leaf at one point, for steep jumps.
inline pgdr::Linear_octree_3 random_octree(Random& random, const pgdr::Octree_box& box, int max_level,
                                           std::uint32_t max_leaves) {
  pgdr::Linear_octree_3 octree(box);
  const bool steep = random.below(2) == 0;
  const double probability = random.between(0.05, 0.6);
  std::array<double, 3> focus{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    focus[axis] = box.lower()[axis] + box.edge() * random.between(0, 1);
  }
  for (int round = 0; round < max_level && octree.size() < max_leaves; ++round) {
    std::vector<std::uint8_t> which(octree.size(), 0);
    for (auto& flag : which) flag = random.between(0, 1) < (steep ? probability / 8 : probability) ? 1 : 0;
    if (steep || round == 0) which[octree.find(focus)] = 1;
    for (std::uint32_t i = 0; i < octree.size(); ++i) {
      if (octree[i].level >= max_level) which[i] = 0;
    }
    octree = octree.split(which);
  }
  return octree;
}

/// Splits what is too large beside smaller leaves, until edges of touching leaves differ by a factor of 2 at most.
inline pgdr::Linear_octree_3 balanced(pgdr::Linear_octree_3 octree) {
  std::vector<std::uint32_t> around;
  while (!octree.is_balanced()) {
    std::vector<std::uint8_t> which(octree.size(), 0);
    for (std::uint32_t i = 0; i < octree.size(); ++i) {
      octree.touching(i, around);
      for (const std::uint32_t j : around) {
        if (octree[j].level > octree[i].level + 1) which[i] = 1;
      }
    }
    octree = octree.split(which);
  }
  return octree;
}

}  // namespace pgdr_test

#endif
