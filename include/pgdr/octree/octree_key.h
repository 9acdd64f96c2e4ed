// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_OCTREE_OCTREE_KEY_H
#define PGDR_OCTREE_OCTREE_KEY_H

#include <cstdint>

namespace pgdr {

/// A node of an octree: its level (0 is the root) and its position in units of its own edge, so that
/// 0 <= x, y, z < 2^level. The functions below need no octree; they know the subdivision of the root cube alone.
struct Octree_key {
  /// The deepest level. Three coordinates of 20 bits fit into one 64-bit Morton code.
  static constexpr int max_level = 20;

  std::uint32_t x = 0, y = 0, z = 0;
  std::uint8_t level = 0;

  /// Child `i` of 8: bit 0 of `i` is the upper half in x, bit 1 in y, bit 2 in z. The order is that of Morton codes.
  /// Needs `level < max_level`.
  constexpr Octree_key child(int i) const {
    const auto bits = static_cast<std::uint32_t>(i);
    return {2 * x + (bits & 1U), 2 * y + (bits >> 1U & 1U), 2 * z + (bits >> 2U & 1U),
            static_cast<std::uint8_t>(level + 1)};
  }

  /// Needs `level > 0`.
  constexpr Octree_key parent() const { return {x / 2, y / 2, z / 2, static_cast<std::uint8_t>(level - 1)}; }

  /// Which child of its parent it is. Nodes of one level and equal parity never touch.
  constexpr int parity() const { return static_cast<int>((x & 1U) | (y & 1U) << 1U | (z & 1U) << 2U); }

  /// The edge in units of the smallest possible leaf: 2^(max_level - level).
  constexpr std::uint32_t edge_units() const { return std::uint32_t{1} << (max_level - level); }

  /// Position of the lower corner in units of the smallest possible leaf.
  constexpr std::uint32_t lower_units(int axis) const {
    return (axis == 0 ? x : axis == 1 ? y : z) << (max_level - level);
  }

  /// Morton code of the lower corner, in 3 * max_level bits: x varies fastest.
  constexpr std::uint64_t morton() const {
    return spread(lower_units(0)) | spread(lower_units(1)) << 1U | spread(lower_units(2)) << 2U;
  }

  /// How many Morton codes the node covers: 8^(max_level - level).
  constexpr std::uint64_t morton_span() const { return std::uint64_t{1} << (3 * (max_level - level)); }

  friend constexpr bool operator==(const Octree_key& a, const Octree_key& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.level == b.level;
  }

 private:
  /// Bit k of `v` moves to bit 3k, for the lower 21 bits.
  static constexpr std::uint64_t spread(std::uint64_t v) {
    v = (v | v << 32U) & 0x1f00000000ffffULL;
    v = (v | v << 16U) & 0x1f0000ff0000ffULL;
    v = (v | v << 8U) & 0x100f00f00f00f00fULL;
    v = (v | v << 4U) & 0x10c30c30c30c30c3ULL;
    v = (v | v << 2U) & 0x1249249249249249ULL;
    return v;
  }
};

/// The same as the member.
constexpr std::uint32_t edge_units(const Octree_key& key) { return key.edge_units(); }

/// The Morton preorder of nodes: an ancestor comes before its descendants, siblings by child number. A strict
/// total order on keys.
constexpr bool precedes(const Octree_key& a, const Octree_key& b) {
  const std::uint64_t code_a = a.morton();
  const std::uint64_t code_b = b.morton();
  return code_a != code_b ? code_a < code_b : a.level < b.level;
}

/// `b` is `a` or a descendant of `a`.
constexpr bool contains(const Octree_key& a, const Octree_key& b) {
  if (a.level > b.level) return false;
  const int up = b.level - a.level;
  return b.x >> up == a.x && b.y >> up == a.y && b.z >> up == a.z;
}

/// The closed cubes meet, in a face, an edge or a corner or parts of them, and neither contains the other.
constexpr bool touch(const Octree_key& a, const Octree_key& b) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t lower_a = a.lower_units(axis);
    const std::uint32_t lower_b = b.lower_units(axis);
    if (lower_a + a.edge_units() < lower_b || lower_b + b.edge_units() < lower_a) return false;
  }
  return !contains(a, b) && !contains(b, a);
}

}  // namespace pgdr

#endif
