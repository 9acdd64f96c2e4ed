// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SCHEDULE_TASK_ORDER_H
#define PGDR_SCHEDULE_TASK_ORDER_H

#include <cstdint>
#include <initializer_list>

#include <pgdr/octree/octree_key.h>

namespace pgdr {

/// A strict total order of leaves, by which tasks on touching leaves follow each other. Any such order that depends on
/// the octree alone gives a valid mesh, the same for every number of threads; another order, another mesh.
///
/// The usual one: larger leaves first, as in the paper, then by colour, so that chains are short, then along the
/// Morton curve. With `shuffle` other than 0, a random order that is a function of `shuffle` and the keys.
struct Task_order {
  std::uint64_t shuffle = 0;

  bool operator()(const Octree_key& a, const Octree_key& b) const {
    if (shuffle != 0 && rank(a) != rank(b)) return rank(a) < rank(b);
    if (a.level != b.level) return a.level < b.level;
    if (a.parity() != b.parity()) return a.parity() < b.parity();
    return a.morton() < b.morton();
  }

 private:
  /// Two rounds of multiplication and folding: as good as random, and the same on every machine.
  std::uint64_t rank(const Octree_key& key) const {
    std::uint64_t x = key.morton() + shuffle;
    for (const std::uint64_t factor : {0xbf58476d1ce4e5b9u, 0x94d049bb133111ebu}) x = (x ^ x >> 30) * factor;
    return x ^ x >> 31;
  }
};

}  // namespace pgdr

#endif
