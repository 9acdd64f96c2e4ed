// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_FIFO_H
#define PGDR_CONFORMING_FIFO_H

#include <cstddef>
#include <utility>
#include <vector>

namespace pgdr {

/// A first-in, first-out queue that can give its memory back: there are a few for every leaf.
template <class T>
class Fifo {
 public:
  bool empty() const { return first_ == items_.size(); }
  std::size_t size() const { return items_.size() - first_; }
  const T& operator[](std::size_t i) const { return items_[first_ + i]; }
  auto begin() const { return items_.begin() + static_cast<std::ptrdiff_t>(first_); }
  auto end() const { return items_.end(); }

  void push(T item) { items_.push_back(std::move(item)); }

  T pop() {
    T item = std::move(items_[first_++]);
    if (first_ == items_.size()) {
      items_.clear();
      first_ = 0;
    } else if (first_ >= 1024 && 2 * first_ >= items_.size()) {
      items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(first_));
      first_ = 0;
    }
    return item;
  }

  void clear() {
    items_.clear();
    first_ = 0;
  }

  /// Takes over all items of another queue, in their order.
  void take_all(Fifo& from) {
    while (!from.empty()) push(from.pop());
  }

  /// Gives the memory of an empty queue back.
  void release_if_empty() {
    if (empty()) std::vector<T>().swap(items_);
  }

 private:
  std::vector<T> items_;
  std::size_t first_ = 0;
};

}  // namespace pgdr

#endif
