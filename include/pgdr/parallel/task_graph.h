// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARALLEL_TASK_GRAPH_H
#define PGDR_PARALLEL_TASK_GRAPH_H

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#ifdef CGAL_LINKED_WITH_TBB
#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace pgdr {

#ifdef CGAL_LINKED_WITH_TBB

/// Runs `body(k)` for k = 0 ... n-1 as the nodes of a `tbb::flow::graph`: a task starts when all that precede it have
/// ended. `successors(k, out)` fills in those that k precedes; it is called from several threads and must describe
/// an acyclic graph. Rethrows what a task throws, after the others have ended. Returns how many tasks precede no one
/// else's end: those that are ready at once.
inline std::size_t run_task_graph(std::size_t n, const std::function<void(std::size_t, std::vector<std::uint32_t>&)>& successors,
                                  const std::function<void(std::size_t)>& body) {
  namespace tbb = oneapi::tbb;
  using Node = tbb::flow::continue_node<tbb::flow::continue_msg>;
  tbb::flow::graph graph;
  std::deque<Node> nodes;
  for (std::size_t k = 0; k < n; ++k)
    nodes.emplace_back(graph, [&body, k](const tbb::flow::continue_msg&) {
      // A thread that waits for a parallel loop inside of the body, a user's sizing field say, must not take another task meanwhile: each
      // has memory of its thread's in use.
      tbb::this_task_arena::isolate([&body, k] { body(k); });
    });
  std::vector<std::uint8_t> waits(n, 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 64), [&](const auto& range) {
    std::vector<std::uint32_t> out;
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      successors(k, out);
      for (const std::uint32_t s : out) {
        tbb::flow::make_edge(nodes[k], nodes[s]);
        std::atomic_ref<std::uint8_t>(waits[s]).store(1, std::memory_order_relaxed);
      }
    }
  });
  // Should memory end while tasks are started, those that have been must not outlive their nodes.
  struct Waiter {
    tbb::flow::graph& graph;
    bool is_needed = true;
    ~Waiter() {
      if (!is_needed) return;
      graph.cancel();
      try {
        graph.wait_for_all();
      } catch (...) {
        // Whatever they threw, the first exception is on its way.
      }
    }
  } waiter{graph};
  std::size_t ready = 0;
  for (std::size_t k = 0; k < n; ++k)
    if (!waits[k]) {
      ++ready;
      nodes[k].try_put(tbb::flow::continue_msg());
    }
  waiter.is_needed = false;
  graph.wait_for_all();
  return ready;
}

#else

/// The same with one thread: those that are ready one after the other, in the order in which they became so.
inline std::size_t run_task_graph(std::size_t n, const std::function<void(std::size_t, std::vector<std::uint32_t>&)>& successors,
                                  const std::function<void(std::size_t)>& body) {
  std::vector<std::uint32_t> waits_for(n, 0), out;
  for (std::size_t k = 0; k < n; ++k) {
    successors(k, out);
    for (const std::uint32_t s : out) ++waits_for[s];
  }
  std::deque<std::size_t> ready;
  for (std::size_t k = 0; k < n; ++k)
    if (waits_for[k] == 0) ready.push_back(k);
  const std::size_t ready_at_once = ready.size();
  for (; !ready.empty(); ready.pop_front()) {
    body(ready.front());
    successors(ready.front(), out);
    for (const std::uint32_t s : out)
      if (--waits_for[s] == 0) ready.push_back(s);
  }
  return ready_at_once;
}

#endif

}  // namespace pgdr

#endif
