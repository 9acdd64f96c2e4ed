// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SCHEDULE_IN_ARENA_H
#define PGDR_SCHEDULE_IN_ARENA_H

#include <optional>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

namespace pgdr {

/// Runs f with `threads` threads; 0: in the arena that the calling thread is in, so that a caller's own limits hold.
template <class F>
void in_arena(unsigned threads, const F& f) {
  if (threads == 0) return f();
  std::optional<tbb::global_control> more;
  if (static_cast<int>(threads) > tbb::info::default_concurrency())
    more.emplace(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute(f);
}

}  // namespace pgdr

#endif
