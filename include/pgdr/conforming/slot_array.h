// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_SLOT_ARRAY_H
#define PGDR_CONFORMING_SLOT_ARRAY_H

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace pgdr {

/// An array whose elements never move and that several threads may extend at once, each through a pool of its own.
///
/// Blocks double in size, so that a position tells its block. Which slot a thread gets depends on timing: nothing
/// may be decided by the number of a slot.
template <class T>
class Slot_array {
 public:
  /// Slots that one thread may use next.
  struct Pool {
    std::vector<std::uint32_t> free;
    std::uint32_t next = 0, end = 0;
  };

  /// `most`: how many slots there may be; `take` throws `std::length_error` rather than give out more. By default as many as can be told
  /// apart where one bit of a number is taken for something else.
  explicit Slot_array(std::uint32_t most = 0x80000000u) : most_(most) {}
  Slot_array(const Slot_array&) = delete;
  Slot_array& operator=(const Slot_array&) = delete;
  ~Slot_array() {
    for (auto& b : blocks_) delete[] b.load(std::memory_order_relaxed);
  }

  T& operator[](std::uint32_t i) { return *at(i); }
  const T& operator[](std::uint32_t i) const { return *at(i); }

  /// One more than the largest slot that was ever given out; those above it in some pool included.
  std::size_t size() const { return size_.load(std::memory_order_acquire); }

  std::uint32_t take(Pool& pool) {
    if (!pool.free.empty()) {
      const std::uint32_t i = pool.free.back();
      pool.free.pop_back();
      return i;
    }
    if (pool.next == pool.end) {
      const std::uint32_t next = size_.load(std::memory_order_acquire) < most_ ? size_.fetch_add(batch, std::memory_order_acq_rel) : most_;
      if (next >= most_) throw std::length_error("more than " + std::to_string(most_) + " pieces of segments or facets");
      pool.next = next;
      pool.end = std::min(next + batch, most_);
      make_block(block_of(pool.next));
    }
    return pool.next++;
  }

 private:
  static constexpr unsigned first_bits = 8;
  /// Divides the first block, hence never straddles two.
  static constexpr std::uint32_t batch = 64;

  static std::size_t block_of(std::uint32_t i) {
    return static_cast<std::size_t>(std::bit_width((i >> first_bits) + 1u)) - 1;
  }
  static std::uint32_t block_start(std::size_t b) { return ((1u << b) - 1u) << first_bits; }

  T* at(std::uint32_t i) const {
    const std::size_t b = block_of(i);
    return blocks_[b].load(std::memory_order_acquire) + (i - block_start(b));
  }

  void make_block(std::size_t b) {
    if (blocks_[b].load(std::memory_order_acquire)) return;
    T* fresh = new T[std::size_t{1} << (first_bits + b)]();
    T* none = nullptr;
    if (!blocks_[b].compare_exchange_strong(none, fresh, std::memory_order_acq_rel)) delete[] fresh;
  }

  std::array<std::atomic<T*>, 32 - first_bits> blocks_{};
  std::atomic<std::uint32_t> size_{0};
  std::uint32_t most_;
};

}  // namespace pgdr

#endif
