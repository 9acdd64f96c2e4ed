// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_BENCH_TRACES_H
#define PGDR_TEST_BENCH_TRACES_H

#include <cstdint>
#include <random>
#include <vector>

#include "replay/trace.h"

namespace pgdr_test {

inline pgdr::Octree_key node(int level, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return {x, y, z, static_cast<std::uint8_t>(level)};
}

inline pgdr::bench::Leaf_task task(pgdr::Octree_key key, double seconds, double start = 0) {
  return {key, 0, 0, start, seconds, false};
}

/// All leaves of one level, each of which ran for the same time, one after another.
inline std::vector<pgdr::bench::Leaf_task> grid(int level, double seconds) {
  std::vector<pgdr::bench::Leaf_task> tasks;
  const std::uint32_t end = std::uint32_t{1} << level;
  for (std::uint32_t z = 0; z < end; ++z)
    for (std::uint32_t y = 0; y < end; ++y)
      for (std::uint32_t x = 0; x < end; ++x)
        tasks.push_back(task(node(level, x, y, z), seconds, seconds * static_cast<double>(tasks.size())));
  return tasks;
}

/// The leaves of a random octree that is not balanced, some of which are left out, with random times.
inline std::vector<pgdr::bench::Leaf_task> random_leaves(unsigned seed, int depth) {
  std::mt19937 random(seed);
  std::vector<pgdr::bench::Leaf_task> tasks;
  std::vector<pgdr::Octree_key> open = {pgdr::Octree_key{}};
  while (!open.empty()) {
    const pgdr::Octree_key key = open.back();
    open.pop_back();
    if (key.level == 0 || (key.level < depth && random() % 3 == 0)) {
      for (int i = 0; i < 8; ++i) open.push_back(key.child(i));
    } else if (random() % 5 != 0) {
      tasks.push_back(task(key, 0.001 * static_cast<double>(1 + random() % 50)));
    }
  }
  return tasks;
}

}  // namespace pgdr_test

#endif
