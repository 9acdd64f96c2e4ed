// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARALLEL_THREAD_ARENA_H
#define PGDR_PARALLEL_THREAD_ARENA_H

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#ifdef CGAL_LINKED_WITH_TBB
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#endif

// This room, and it alone, asks whether there is oneTBB (by the name that CGAL has for it): without, all of its loops are plain ones.

namespace pgdr {

#ifdef CGAL_LINKED_WITH_TBB

/// How many threads the loops of this room would use here, the calling one included.
inline unsigned thread_count() { return static_cast<unsigned>(oneapi::tbb::this_task_arena::max_concurrency()); }

/// Which of them the caller is, from 0.
inline std::size_t thread_number() { return static_cast<std::size_t>(std::max(oneapi::tbb::this_task_arena::current_thread_index(), 0)); }

/// Runs `f()` so that everything parallel in it uses `threads` threads, and returns its result; 0: runs it in the
/// caller's arena as it is. Exceptions pass through.
///
/// More threads than the machine has cores are granted: oneTBB's own limit is raised while `f` runs. A limit that
/// the caller has set by a `tbb::global_control` stays in force. Without oneTBB there is one thread, whatever is asked for.
template <class F>
decltype(auto) with_threads(unsigned threads, F&& f) {
  if (threads == 0) return std::forward<F>(f)();
  using Control = oneapi::tbb::global_control;
  std::optional<Control> limit;
  if (threads > Control::active_value(Control::max_allowed_parallelism))
    limit.emplace(Control::max_allowed_parallelism, threads);
  oneapi::tbb::task_arena arena(static_cast<int>(threads));
  return arena.execute(std::forward<F>(f));
}

#else

inline unsigned thread_count() { return 1; }
inline std::size_t thread_number() { return 0; }

template <class F>
decltype(auto) with_threads(unsigned, F&& f) {
  return std::forward<F>(f)();
}

#endif

}  // namespace pgdr

#endif
