// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_BENCH_REPLAY_PREDICTION_H
#define PGDR_BENCH_REPLAY_PREDICTION_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "replay/trace.h"

namespace pgdr::bench {

/// What `workers` simulated workers would need. A prediction from above: see replay_trace.cpp.
struct Prediction {
  std::size_t workers = 1;
  double seconds = 0;
  double speed_up = 1;    ///< over one simulated worker
  double efficiency = 1;  ///< speed-up by worker
};

/// The waves of one epoch.
struct Epoch_figures {
  std::uint32_t epoch = 0;
  std::size_t waves = 0, tasks = 0;
  double work = 0;            ///< seconds in leaf tasks
  double critical_path = 0;   ///< sum over the waves
  std::size_t ready_max = 0;  ///< most tasks at once in one of the waves, with as many workers as tasks
};

/// A trace, replayed.
struct Replay {
  std::size_t tasks = 0, waves = 0, edges = 0;
  double recorded = 0;       ///< seconds from the first event to the end of the last, as recorded
  double leaf_work = 0;      ///< seconds in leaf tasks, over all threads
  double parallel_work = 0;  ///< seconds in parallel sections, times the threads of the recorded run
  double serial = 0;         ///< seconds in serial sections
  double unrecorded = 0;     ///< seconds in no event, between waves and sections; count as serial
  double overhead = 0;       ///< seconds that threads spent within waves but in no task, idle ones too
  double serial_share = 0;   ///< (serial + unrecorded) / recorded
  /// Seconds with endlessly many workers: the serial parts and the longest chain of each wave.
  double critical_path = 0;
  std::size_t ready_max = 0;  ///< most leaf tasks at once with as many workers as tasks
  double ready_mean = 0;      ///< the same, averaged over the time of the waves: leaf work by critical path
  std::vector<Prediction> predictions;  ///< one for each number of workers asked for
  std::vector<Epoch_figures> epochs;
};

/// Replays the trace on each number of workers. Waves, serial and parallel sections follow one another; a serial
/// section takes as long as recorded, a parallel one its work by the number of workers. Throws Trace_error where
/// sections and waves overlap by more than two microseconds, since their time would count twice.
Replay replay(const Trace& trace, const std::vector<std::size_t>& workers);

}  // namespace pgdr::bench

#endif
