// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_EDGE_TABLE_H
#define PGDR_MESH_EDGE_TABLE_H

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pgdr {

/// A number for each edge of a surface whose vertices are numbered: a hash table with linear probing that keeps its memory from one surface
/// to the next. (A `std::unordered_map` took a sixth of the time where cavities have hundreds of tetrahedra, for its allocations.)
class Edge_table {
 public:
  /// Forgets everything, and makes room for `edges` edges.
  void reset(std::size_t edges) {
    const std::size_t size = std::bit_ceil(2 * edges + 1);
    shift_ = static_cast<unsigned>(64 - std::countr_zero(size));
    if (slots_.size() < size) slots_.resize(size);
    std::fill_n(slots_.begin(), size, Slot{});
    mask_ = size - 1;
  }

  /// That of the edge between a and b, a < b; 0 where it was not set.
  std::uint32_t& operator()(std::uint32_t a, std::uint32_t b) {
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio (Knuth, volume 3, 6.4): spreads successive keys
    const std::uint64_t key = (static_cast<std::uint64_t>(a) << 32) | b;
    std::size_t k = (key * golden) >> shift_;
    while (slots_[k].key != key && slots_[k].key != none) k = (k + 1) & mask_;
    slots_[k].key = key;
    return slots_[k].value;
  }

 private:
  static constexpr std::uint64_t none = 0;  // no edge's, as a < b

  struct Slot {
    std::uint64_t key = none;
    std::uint32_t value = 0;
  };
  std::vector<Slot> slots_;
  std::size_t mask_ = 0;
  unsigned shift_ = 0;
};

}  // namespace pgdr

#endif
