// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_CANONICAL_ORDER_H
#define PGDR_REFINEMENT_CANONICAL_ORDER_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <pgdr/domain/vec_3.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_sort.h>

namespace pgdr::internal {

/// Interleaves 21 bits each of three coordinates scaled to [0, 1].
inline std::uint64_t morton_code(const Vec_3& unit) {
  const auto spread = [](double t) {
    auto x = static_cast<std::uint64_t>(std::clamp(t, 0.0, 1.0) * 2097151.0);
    x = (x | x << 32) & 0x1f00000000ffffull;
    x = (x | x << 16) & 0x1f0000ff0000ffull;
    x = (x | x << 8) & 0x100f00f00f00f00full;
    x = (x | x << 4) & 0x10c30c30c30c30c3ull;
    return (x | x << 2) & 0x1249249249249249ull;
  };
  return spread(unit.x) | spread(unit.y) << 1 | spread(unit.z) << 2;
}

/// The even permutation of a tetrahedron's vertices that starts with the smallest two it can.
inline std::array<std::uint32_t, 4> canonical(std::array<std::uint32_t, 4> t) {
  bool odd = false;
  const auto order = [&](std::size_t i, std::size_t j) {
    const std::uint32_t a = t[i], b = t[j];
    const bool wrong = b < a;
    t[i] = wrong ? b : a;
    t[j] = wrong ? a : b;
    odd ^= wrong;
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  const std::uint32_t c = t[2], d = t[3];
  t[2] = odd ? d : c;
  t[3] = odd ? c : d;
  return t;
}

/// The rotation of a triangle that starts with its smallest vertex.
inline std::array<std::uint32_t, 3> canonical(std::array<std::uint32_t, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// An edge that starts with its smaller vertex.
inline std::array<std::uint32_t, 2> canonical(std::array<std::uint32_t, 2> e) {
  return {std::min(e[0], e[1]), std::max(e[0], e[1])};
}

/// Sorts `items`, of which each one is in `points`, along a Morton curve through the box from `lower` to `upper`; ties
/// by coordinates. \pre No two points are the same.
inline void sort_along_curve(std::span<std::uint32_t> items, const std::vector<std::array<double, 3>>& points,
                             const std::array<double, 3>& lower, const std::array<double, 3>& upper) {
  struct Key {
    std::uint64_t code;
    std::uint32_t item;
  };
  std::vector<Key> keys(items.size());
  parallel_for_chunks(items.size(), default_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Vec_3 unit;
      for (std::size_t k = 0; k < 3; ++k) {
        const double size = upper[k] - lower[k];
        unit[static_cast<int>(k)] = size > 0 ? (points[items[i]][k] - lower[k]) / size : 0;
      }
      keys[i] = {morton_code(unit), items[i]};
    }
  });
  parallel_sort(keys.begin(), keys.end(), [&points](const Key& a, const Key& b) {
    return a.code != b.code ? a.code < b.code : points[a.item] < points[b.item];
  });
  parallel_for_chunks(items.size(), default_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) items[i] = keys[i].item;
  });
}

/// Something of N vertices in a list of such: tetrahedra, triangles, edges.
template <std::size_t N>
struct Element {
  std::array<std::uint32_t, N> vertices;
  std::int32_t reference;
  friend bool operator<(const Element& a, const Element& b) { return a.vertices < b.vertices; }
};

}  // namespace pgdr::internal

#endif
