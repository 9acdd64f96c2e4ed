// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_LEAF_REFINER_H
#define PGDR_REFINEMENT_LEAF_REFINER_H

#include <concepts>
#include <cstddef>
#include <limits>

#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// A half-open box; the default is all of space.
struct Leaf_region {
  Vec_3 lower{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
              -std::numeric_limits<double>::infinity()};
  Vec_3 upper{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
              std::numeric_limits<double>::infinity()};

  bool contains(const Vec_3& p) const {
    return lower.x <= p.x && p.x < upper.x && lower.y <= p.y && p.y < upper.y && lower.z <= p.z && p.z < upper.z;
  }
};

/// What one `drain` did.
struct Drain_result {
  std::size_t inserted = 0;   ///< points, on features and in the volume
  std::size_t refused = 0;    ///< poor elements that were given up
  std::size_t forwarded = 0;  ///< poor elements whose Steiner point lies outside the region
  bool stopped = false;       ///< asked to stop before the worklist was empty
};

/// A sequential engine that a scheduler can run leaf by leaf.
///
/// `drain(region, worklist)` refines poor elements until none is left whose Steiner point lies in the region. It
/// takes elements from the front of `worklist` and appends those that it makes; elements that belong elsewhere are
/// moved to `worklist.forwarded`. What it does is a function of the mesh near the region and of the worklist only:
/// no clock, no addresses, no thread. The scheduler sees nothing else of an engine, in particular no tetrahedron.
template <class R>
concept LeafRefiner = requires(R refiner, const Leaf_region& region, typename R::Worklist& worklist) {
  { worklist.empty() } -> std::convertible_to<bool>;
  { worklist.size() } -> std::convertible_to<std::size_t>;
  { worklist.forwarded.size() } -> std::convertible_to<std::size_t>;
  { refiner.drain(region, worklist) } -> std::same_as<Drain_result>;
};

}  // namespace pgdr

#endif
