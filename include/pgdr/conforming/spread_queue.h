// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_SPREAD_QUEUE_H
#define PGDR_CONFORMING_SPREAD_QUEUE_H

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <pgdr/conforming/fifo.h>

namespace pgdr {

/// A queue for what comes by the thousand from one place and asks for points next to each other: first every 128th, then every 64th of the
/// others, and so on, and half of them at last; among equals the oldest first.
///
/// A vertex may encroach thousands of long subsegments side by side, on the strips of a finely tessellated cylinder for instance. Split one
/// after the other, each point has a cavity as wide as the pieces are long, half of which the one before has just filled; split in this order,
/// the cavities shrink as the points get denser, as in a biased randomized insertion order (N. Amenta, S. Choi, G. Rote, *Incremental
/// constructions con BRIO*, SoCG 2003), with the ruler sequence in place of chance. (Cells in a cavity of a28, and seconds of its first million of vertices
/// on two threads: in order 200, 78; up to every 16th 48; every 128th 40, 46.)
template <class T>
class Spread_queue {
 public:
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }

  void push(T item) {
    levels_[std::min<std::size_t>(static_cast<std::size_t>(std::countr_zero(++pushed_)), levels_.size() - 1)].push(std::move(item));
    ++size_;
  }

  /// What comes next. \pre not empty
  const T& next() const { return levels_[first_level()][0]; }
  T pop() {
    --size_;
    return levels_[first_level()].pop();
  }

  /// Takes over all items of another queue.
  void take_all(Spread_queue& from) {
    for (std::size_t k = 0; k < levels_.size(); ++k) levels_[k].take_all(from.levels_[k]);
    size_ += std::exchange(from.size_, 0);
  }

  /// Gives the memory of an empty queue back.
  void release_if_empty() {
    for (Fifo<T>& level : levels_) level.release_if_empty();
  }

 private:
  /// \pre not empty
  std::size_t first_level() const {
    std::size_t k = levels_.size() - 1;
    while (levels_[k].empty()) --k;
    return k;
  }

  std::array<Fifo<T>, 8> levels_;  ///< the last one first
  std::size_t size_ = 0;
  std::uint64_t pushed_ = 0;  ///< ever: 2^k divides the number of those on level k
};

}  // namespace pgdr

#endif
