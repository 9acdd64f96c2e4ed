// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_BENCH_REPLAY_WAVE_GRAPH_H
#define PGDR_BENCH_REPLAY_WAVE_GRAPH_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "replay/trace.h"

namespace pgdr::bench {

/// The tasks of one wave and who waits for whom: the flow graph that the schedule builds from the leaves with work. An
/// edge joins every two tasks whose leaves touch; it goes from the larger leaf to the smaller, then by parity, then by
/// Morton code.
struct Wave_graph {
  std::vector<double> seconds;              ///< of each task
  std::vector<std::uint32_t> predecessors;  ///< how many tasks each one waits for
  std::vector<std::uint32_t> successors;    ///< who waits for task 0, for task 1, ...
  std::vector<std::uint32_t> first;         ///< those of task i: from first[i] to first[i + 1] - 1

  std::size_t size() const { return seconds.size(); }
};

/// The graph of the tasks of one wave. Tasks are renumbered in the order that directs the edges, so that every edge
/// goes from a lower number to a higher one; parts have no edges. Possible neighbours are looked up, not searched: the time grows as the
/// number of tasks by that of levels. Throws Trace_error where two leaves overlap.
Wave_graph make_wave_graph(std::span<const Leaf_task> tasks);

}  // namespace pgdr::bench

#endif
