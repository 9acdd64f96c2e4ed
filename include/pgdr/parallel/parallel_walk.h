// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARALLEL_PARALLEL_WALK_H
#define PGDR_PARALLEL_PARALLEL_WALK_H

#include <cstddef>
#include <deque>

#ifdef CGAL_LINKED_WITH_TBB
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#endif

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
    Value* value = nullptr;
  };
  std::deque<Value> values;  // whose references stay valid while it grows
  std::size_t position = 0;
  const auto step = [&] {
    Chunk chunk{position, first, 0, &values.emplace_back()};
    for (; chunk.count < grain && first != last; ++first) ++chunk.count;
    position += chunk.count;
    return chunk;
  };
  const auto work = [&f](const Chunk& chunk) { *chunk.value = f(chunk.position, chunk.first, chunk.count); };
#ifdef CGAL_LINKED_WITH_TBB
  namespace tbb = oneapi::tbb;
  const auto begin = [&](tbb::flow_control& control) -> Chunk {
    if (first != last) return step();
    control.stop();
    return {};
  };
  const auto tokens = 4 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  tbb::parallel_pipeline(tokens, tbb::make_filter<void, Chunk>(tbb::filter_mode::serial_in_order, begin) &
                                     tbb::make_filter<Chunk, void>(tbb::filter_mode::parallel, work));
#else
  while (first != last) work(step());
#endif
  return values;
}

}  // namespace pgdr

#endif
