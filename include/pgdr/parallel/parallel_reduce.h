// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARALLEL_PARALLEL_REDUCE_H
#define PGDR_PARALLEL_PARALLEL_REDUCE_H

#include <cstddef>
#include <utility>
#include <vector>

#include <pgdr/parallel/parallel_for.h>

namespace pgdr {

/// The values map(first, last) of all chunks of `grain` items of [0, n), in order; computed at once.
template <class Map>
auto parallel_map_chunks(std::size_t n, std::size_t grain, const Map& map) {
  std::vector<decltype(map(n, n))> values(chunk_count(n, grain));
  parallel_for_chunks(n, grain, [&](std::size_t first, std::size_t last) { values[first / grain] = map(first, last); });
  return values;
}

/// Adds up [0, n): add(sum, map(first, last)) for all chunks of `grain` items, from the first to the last, beginning
/// with `sum`. The chunks are mapped at once and added by the caller in order, so that rounding, too, is the same for
/// every number of threads.
template <class T, class Map, class Add>
T parallel_reduce(std::size_t n, std::size_t grain, T sum, const Map& map, const Add& add) {
  for (auto& value : parallel_map_chunks(n, grain, map)) add(sum, std::move(value));
  return sum;
}

/// All items of the vectors map(first, last), in order.
template <class Map>
auto parallel_collect(std::size_t n, std::size_t grain, const Map& map) {
  return parallel_reduce(n, grain, decltype(map(n, n)){}, map, [](auto& all, auto&& part) {
    if (all.empty())
      all = std::forward<decltype(part)>(part);
    else
      all.insert(all.end(), part.begin(), part.end());
  });
}

}  // namespace pgdr

#endif
