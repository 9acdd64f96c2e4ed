// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_RADIUS_QUEUE_H
#define PGDR_REFINEMENT_RADIUS_QUEUE_H

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>

#include <pgdr/conforming/fifo.h>

namespace pgdr {

/// Elements by their `radius`, the larger ones first, within a factor of 2 the oldest first.
///
/// Where features are sampled before the volume between them, two of n points each have n² tetrahedra between them, and whatever is
/// inserted there has to look at them all. The center of a large one removes most of them (the idea of B. Hudson, G. Miller,
/// T. Phillips, *Sparse Voronoi refinement*, 2006). Within a factor of 2 the order in which they came takes the work
/// through memory step by step.
template <class Item>
class Radius_queue {
 public:
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }

  void push(Item item) {
    auto& its_class = classes_[exponent(item.radius)];
    its_class.push(std::move(item));
    ++size_;
  }

  /// \pre not empty
  Item pop() {
    const auto largest = classes_.begin();
    Item item = largest->second.pop();
    if (largest->second.empty()) classes_.erase(largest);
    --size_;
    return item;
  }

  /// All those within a factor of 2 of the largest, in their order. \pre not empty
  Fifo<Item> pop_class() {
    Fifo<Item> items = std::move(classes_.begin()->second);
    classes_.erase(classes_.begin());
    size_ -= items.size();
    return items;
  }

  /// Gives back what is left of them. \pre no others have the same size
  void push_class(Fifo<Item> items) {
    if (items.empty()) return;
    size_ += items.size();
    classes_[exponent(items[0].radius)] = std::move(items);
  }

  /// Those that come next. \pre not empty
  const Fifo<Item>& next() const { return classes_.begin()->second; }

  /// Calls `found` with every `step`-th item.
  template <class Found>
  void sample(std::size_t step, const Found& found) const {
    std::size_t at = 0;
    for (const auto& [size_class, queue] : classes_) {
      for (; at < queue.size(); at += step) found(queue[at]);
      at -= queue.size();
    }
  }

  /// Takes over all items of another queue, in their order.
  void take_all(Radius_queue& from) {
    for (auto& [size_class, queue] : from.classes_) classes_[size_class].take_all(queue);
    size_ += std::exchange(from.size_, 0);
    from.classes_.clear();
  }

 private:
  /// Grows by 1 where a radius that is not negative doubles; a call of the mathematical library takes longer than the rest of `push`.
  static std::uint32_t exponent(float radius) { return std::bit_cast<std::uint32_t>(radius) >> 23; }

  std::map<std::uint32_t, Fifo<Item>, std::greater<>> classes_;  ///< by the exponent of the radius; none is empty
  std::size_t size_ = 0;
};

}  // namespace pgdr

#endif
