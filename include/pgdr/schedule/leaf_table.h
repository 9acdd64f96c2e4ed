// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SCHEDULE_LEAF_TABLE_H
#define PGDR_SCHEDULE_LEAF_TABLE_H

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <pgdr/domain/region_3.h>
#include <pgdr/octree/linear_octree_3.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/refinement/leaf_refiner.h>

namespace pgdr {

/// A leaf of the octree at work.
template <class Engine>
struct Scheduled_leaf {
  using Parcel = typename Engine::Parcel;

  typename Engine::Worklist work;
  std::vector<std::uint32_t> touching;        ///< ascending
  std::vector<std::vector<Parcel>> outbox;    ///< one slot for every touching leaf
  std::vector<std::pair<std::uint32_t, Parcel>> far;  ///< for leaves that do not touch
  double edge = 0;
  double shortest = 0;  ///< ell*: the shortest edge among the leaf and those that touch it
  double target = std::numeric_limits<double>::infinity();
  double cap = std::numeric_limits<double>::infinity();  ///< what a neighbour's split asks the target to be
  bool final = false;       ///< will not be split; all its poor elements are active
  bool admissible = true;   ///< its zone condition holds: it may run beside leaves that do not touch it
  mutable std::uint8_t inbound = 0;  ///< some outbox holds a parcel for it

  std::size_t slot_of(std::uint32_t neighbor) const {
    const auto at = std::lower_bound(touching.begin(), touching.end(), neighbor);
    return at != touching.end() && *at == neighbor ? static_cast<std::size_t>(at - touching.begin())
                                                   : std::numeric_limits<std::size_t>::max();
  }
  std::atomic_ref<std::uint8_t> has_inbound() const { return std::atomic_ref<std::uint8_t>(inbound); }
};

/// The half-open box of a leaf, without end where the leaf ends at the root's boundary.
inline Region_3 leaf_region(const Linear_octree_3& octree, std::uint32_t i) {
  const auto lo = octree.lower(i), hi = octree.upper(i);
  const auto root_lo = octree.box().lower(), root_hi = octree.box().upper();
  Region_3 r;
  for (int k = 0; k < 3; ++k) {
    const auto a = static_cast<std::size_t>(k);
    if (lo[a] > root_lo[a]) r.lower[k] = lo[a];
    if (hi[a] < root_hi[a]) r.upper[k] = hi[a];
  }
  return r;
}

/// A box grown by `by` on every side.
inline Region_3 grown(Region_3 r, double by) {
  for (int k = 0; k < 3; ++k) {
    r.lower[k] -= by;
    r.upper[k] += by;
  }
  return r;
}

/// Calls f(i) for each of n leaves, at once.
template <class F>
void for_leaves(std::size_t n, const F& f) {
  parallel_for(0, n, [&f](std::size_t i) { f(static_cast<std::uint32_t>(i)); });
}

/// Fills in what a leaf knows of its surroundings. The outboxes must be empty.
template <class Engine>
void connect_leaves(const Linear_octree_3& octree, std::vector<Scheduled_leaf<Engine>>& leaves) {
  for_leaves(octree.size(), [&](std::uint32_t i) {
    Scheduled_leaf<Engine>& leaf = leaves[i];
    octree.touching(i, leaf.touching);
    leaf.touching.shrink_to_fit();
    leaf.outbox.clear();
    leaf.outbox.resize(leaf.touching.size());
    leaf.edge = octree.edge(i);
    leaf.shortest = leaf.edge;
    for (const std::uint32_t n : leaf.touching) leaf.shortest = std::min(leaf.shortest, octree.edge(n));
  });
}

}  // namespace pgdr

#endif
