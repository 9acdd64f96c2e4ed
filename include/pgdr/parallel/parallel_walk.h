// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARALLEL_PARALLEL_WALK_H
#define PGDR_PARALLEL_PARALLEL_WALK_H

#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include <pgdr/parallel/parallel_pipeline.h>

namespace pgdr {

/// Goes through a range that can only be walked, like the cells of a triangulation, with all threads of the caller's
/// arena: one at a time steps over the next `grain` items, then works on them while others step on.
///
/// Returns the values f(position of the first item, iterator to it, number of items) in the order of the range.
template <class Iterator, class F>
auto parallel_walk(Iterator first, Iterator last, std::size_t grain, const F& f) {
  using Value = decltype(f(grain, first, grain));
  struct Chunk {
    std::size_t position = 0;
    Iterator first;
    std::size_t count = 0;
    Value value{};
  };
  std::deque<Chunk> chunks;  // whose references stay valid while it grows
  std::size_t position = 0;
  const auto step = [&]() -> void* {
    if (first == last) return nullptr;
    Chunk& chunk = chunks.emplace_back(Chunk{position, first});
    for (; chunk.count < grain && first != last; ++first) ++chunk.count;
    position += chunk.count;
    return &chunk;
  };
  const auto work = [&f](void* at) {
    Chunk& chunk = *static_cast<Chunk*>(at);
    chunk.value = f(chunk.position, chunk.first, chunk.count);
  };
  parallel_pipeline(4 * std::size_t{thread_count()}, step, work);
  std::vector<Value> values;
  values.reserve(chunks.size());
  for (Chunk& chunk : chunks) values.push_back(std::move(chunk.value));
  return values;
}

/// Calls f(iterator) for each item of such a range, `grain` of them a task.
template <class Iterator, class F>
void parallel_for_each(Iterator first, Iterator last, std::size_t grain, const F& f) {
  parallel_walk(first, last, grain, [&f](std::size_t, Iterator it, std::size_t count) {
    for (; count > 0; --count, ++it) f(it);
    return true;
  });
}

}  // namespace pgdr

#endif
