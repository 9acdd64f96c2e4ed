// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARALLEL_THREAD_ARENA_H
#define PGDR_PARALLEL_THREAD_ARENA_H

#include <optional>
#include <utility>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

namespace pgdr {

/// How many threads the loops of this room would use here, the calling one included.
inline unsigned thread_count() { return static_cast<unsigned>(oneapi::tbb::this_task_arena::max_concurrency()); }

/// Runs `f()` so that everything parallel in it uses `threads` threads, and returns its result; 0: runs it in the
/// caller's arena as it is. Exceptions pass through.
///
/// More threads than the machine has cores are granted: oneTBB's own limit is raised while `f` runs. A limit that
/// the caller has set by a `tbb::global_control` stays in force.
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

}  // namespace pgdr

#endif
