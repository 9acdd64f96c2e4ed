// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay/list_schedule.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace pgdr::bench {

double list_schedule(const Wave_graph& graph, std::size_t workers) {
  using Running = std::pair<double, std::uint32_t>;  // when it ends, which task
  std::priority_queue<Running, std::vector<Running>, std::greater<>> running;
  std::vector<std::uint32_t> waiting_for = graph.predecessors;
  std::vector<std::uint32_t> ready;  // a queue: [taken, end) is ready, what is before has begun
  ready.reserve(graph.size());
  std::size_t taken = 0;
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    if (waiting_for[i] == 0) ready.push_back(i);

  double now = 0;
  while (taken < ready.size() || !running.empty()) {
    while (taken < ready.size() && running.size() < workers) {
      const std::uint32_t task = ready[taken++];
      running.emplace(now + graph.seconds[task], task);
    }
    const std::uint32_t done = running.top().second;
    now = running.top().first;
    running.pop();
    for (std::uint32_t i = graph.first[done]; i < graph.first[done + 1]; ++i)
      if (--waiting_for[graph.successors[i]] == 0) ready.push_back(graph.successors[i]);
  }
  return now;
}

Wave_width wave_width(const Wave_graph& graph) {
  Wave_width width;
  std::vector<double> start(graph.size(), 0);
  std::vector<std::pair<double, int>> events;  // +1 and -1 for the number of tasks that run
  events.reserve(2 * graph.size());
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const double end = start[i] + graph.seconds[i];
    width.critical_path = std::max(width.critical_path, end);
    if (graph.predecessors[i] == 0) ++width.ready_first;
    for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k)
      start[graph.successors[k]] = std::max(start[graph.successors[k]], end);
    events.emplace_back(start[i], 1);
    events.emplace_back(end, -1);
  }
  std::sort(events.begin(), events.end());  // at one time ends come before starts
  long count = 0, most = 0;
  for (const auto& event : events) most = std::max(most, count += event.second);
  width.ready_max = std::max(static_cast<std::size_t>(most), width.ready_first);
  return width;
}

}  // namespace pgdr::bench
