// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARALLEL_PARALLEL_FOR_H
#define PGDR_PARALLEL_PARALLEL_FOR_H

#include <algorithm>
#include <cstddef>
#include <functional>

#ifdef CGAL_LINKED_WITH_TBB
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#endif

namespace pgdr {

/// Items of a chunk where the work on one of them is some tens of nanoseconds: enough to hide what a task costs.
constexpr std::size_t default_grain = 4096;

/// How many chunks of `grain` items `n` items make, the last one perhaps smaller.
constexpr std::size_t chunk_count(std::size_t n, std::size_t grain) { return n / grain + (n % grain != 0); }

namespace internal {

/// Compiled once, whatever is called: what a task costs hides an indirect call.
inline void parallel_for(std::size_t begin, std::size_t end, const std::function<void(std::size_t)>& f) {
#ifdef CGAL_LINKED_WITH_TBB
  namespace tbb = oneapi::tbb;
  if (begin >= end) return;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 1), [&f](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) f(i);
  });
#else
  for (; begin < end; ++begin) f(begin);
#endif
}

}  // namespace internal

/// Calls f(i) for each i of [begin, end), at once on all threads of the caller's arena. Every call is a task of its
/// own that another thread may take, so each should be worth microseconds.
template <class F>
void parallel_for(std::size_t begin, std::size_t end, const F& f) {
  internal::parallel_for(begin, end, std::cref(f));
}

/// Calls f(first, last) for each chunk [first, last) of `grain` items of [0, n), at once. Where the chunks begin
/// does not depend on the number of threads.
template <class F>
void parallel_for_chunks(std::size_t n, std::size_t grain, const F& f) {
  parallel_for(0, chunk_count(n, grain), [&](std::size_t chunk) {
    f(chunk * grain, std::min(n, (chunk + 1) * grain));
  });
}

}  // namespace pgdr

#endif
