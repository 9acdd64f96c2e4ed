// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARALLEL_PARALLEL_PIPELINE_H
#define PGDR_PARALLEL_PARALLEL_PIPELINE_H

#include <cstddef>
#include <functional>

#include <pgdr/parallel/thread_arena.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <oneapi/tbb/parallel_pipeline.h>
#endif

namespace pgdr {

/// Calls next(), one at a time, until it returns null; work(item) for each item, at once on all threads of the caller's arena; and
/// finish(item), one at a time and in order, if there is a `finish`. At most `most` items are under way. After an exception nothing more is finished; it passes through.
inline void parallel_pipeline([[maybe_unused]] std::size_t most, const std::function<void*()>& next, const std::function<void(void*)>& work,
                              const std::function<void(void*)>& finish = {}) {
#ifdef CGAL_LINKED_WITH_TBB
  namespace tbb = oneapi::tbb;
  const auto begin = [&next](tbb::flow_control& control) {
    void* const item = next();
    if (!item) control.stop();
    return item;
  };
  const auto middle = [&work](void* item) {
    work(item);
    return item;
  };
  const auto end = [&finish](void* item) {
    if (finish) finish(item);
  };
  tbb::parallel_pipeline(most, tbb::make_filter<void, void*>(tbb::filter_mode::serial_in_order, begin) &
                                   tbb::make_filter<void*, void*>(tbb::filter_mode::parallel, middle) &
                                   tbb::make_filter<void*, void>(finish ? tbb::filter_mode::serial_in_order : tbb::filter_mode::parallel, end));
#else
  while (void* const item = next()) {
    work(item);
    if (finish) finish(item);
  }
#endif
}

}  // namespace pgdr

#endif
