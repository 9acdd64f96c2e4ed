// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_BENCH_REPLAY_LIST_SCHEDULE_H
#define PGDR_BENCH_REPLAY_LIST_SCHEDULE_H

#include <cstddef>

#include "replay/wave_graph.h"

namespace pgdr::bench {

/// How many seconds `workers` equal workers need for the tasks of a wave. A worker that is free takes the task that has
/// been ready longest, and no worker waits while a task is ready: at most 2 - 1/workers times the best possible
/// schedule (R. L. Graham, Bounds on multiprocessing timing anomalies, 1969). Ties go to the task that the graph puts
/// first.
double list_schedule(const Wave_graph& graph, std::size_t workers);

/// A wave on as many workers as it has tasks.
struct Wave_width {
  double critical_path = 0;     ///< seconds of the longest chain of tasks that wait for one another
  std::size_t ready_first = 0;  ///< tasks that wait for nobody
  std::size_t ready_max = 0;    ///< most tasks that run at once
};
Wave_width wave_width(const Wave_graph& graph);

}  // namespace pgdr::bench

#endif
