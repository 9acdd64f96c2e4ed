// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/parallel/task_graph.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <pgdr/parallel/thread_arena.h>

#include "catch.h"
#include "seeded_random.h"

using Graph = std::vector<std::vector<std::uint32_t>>;

namespace {

/// Edges from smaller to larger numbers.
Graph random_graph(std::size_t n, std::uint32_t degree, std::uint64_t seed) {
  pgdr_test::Seeded_random random(seed);
  Graph graph(n);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    for (std::uint32_t d = random.below(degree + 1); d > 0; --d)
      graph[k].push_back(static_cast<std::uint32_t>(k + 1) +
                         random.below(static_cast<std::uint32_t>(n - k - 1)));
    std::sort(graph[k].begin(), graph[k].end());
    graph[k].erase(std::unique(graph[k].begin(), graph[k].end()), graph[k].end());
  }
  return graph;
}

auto successors_of(const Graph& graph) {
  return [&graph](std::size_t k, std::vector<std::uint32_t>& out) { out = graph[k]; };
}

}  // namespace

TEST_CASE("Every task runs once, after all that precede it", "[parallel]") {
  for (const unsigned threads : {1u, 2u, 8u})
    for (const std::uint32_t degree : {0u, 1u, 6u}) {
      const std::size_t n = 400;
      const Graph graph = random_graph(n, degree, 10 * threads + degree);
      std::vector<std::uint8_t> waits(n, 0);
      for (const auto& out : graph)
        for (const auto s : out) waits[s] = 1;
      std::atomic<std::uint64_t> clock{1};
      std::vector<std::uint64_t> begin(n, 0), end(n, 0);
      std::atomic<int> again{0};
      std::size_t ready = 0;
      pgdr::with_threads(threads, [&] {
        ready = pgdr::run_task_graph(n, successors_of(graph), [&](std::size_t k) {
          again += begin[k] != 0;
          begin[k] = clock++;
          for (std::atomic<int> spin = 0; spin < 200; ++spin) {
          }
          end[k] = clock++;
        });
      });
      CAPTURE(threads, degree);
      CHECK(again == 0);
      CHECK(ready == static_cast<std::size_t>(std::count(waits.begin(), waits.end(), 0)));
      CHECK(std::count(end.begin(), end.end(), 0u) == 0);
      std::size_t too_early = 0, edges = 0;
      for (std::size_t k = 0; k < n; ++k)
        for (const auto s : graph[k]) {
          ++edges;
          too_early += begin[s] < end[k];
        }
      CHECK(too_early == 0);
      CHECK((edges > 100) == (degree > 0));
    }
}

TEST_CASE("No tasks are done at once", "[parallel]") {
  CHECK(pgdr::run_task_graph(
            0, [](std::size_t, std::vector<std::uint32_t>& out) { out.clear(); },
            [](std::size_t) { FAIL("there is no task"); }) == 0);
}

TEST_CASE("What a task throws comes out, and what depends on it does not run", "[parallel]") {
  // A chain through the one that throws, and others beside it.
  const std::size_t n = 60, bad = 20;
  Graph graph(n);
  for (std::size_t k = 0; k + 3 < n; ++k) graph[k].push_back(static_cast<std::uint32_t>(k + 3));
  for (const unsigned threads : {1u, 4u}) {
    CAPTURE(threads);
    std::vector<std::atomic<int>> ran(n);
    std::atomic<bool> over{false};
    std::string what;
    std::atomic<int> late{0};
    pgdr::with_threads(threads, [&] {
      try {
        pgdr::run_task_graph(n, successors_of(graph), [&](std::size_t k) {
          late += over.load();
          if (k == bad) throw std::runtime_error("task 20");
          ++ran[k];
        });
      } catch (const std::runtime_error& e) {
        what = e.what();
      }
      over = true;
    });
    CHECK(what == "task 20");
    CHECK(late == 0);
    for (std::size_t k = 0; k < n; ++k) {
      CHECK(ran[k] <= 1);
      if (k >= bad && k % 3 == bad % 3) CHECK(ran[k] == 0);
    }
    // The next graph is not affected.
    std::atomic<int> count{0};
    pgdr::run_task_graph(n, successors_of(graph), [&](std::size_t) { ++count; });
    CHECK(count == static_cast<int>(n));
  }
}

TEST_CASE("A thread that waits inside of a task takes no other task meanwhile", "[parallel]") {
  // As a user's sizing field does that calls a parallel loop of its own.
  constexpr std::size_t threads = 4, tasks = 200;
  std::vector<int> busy(threads, 0);
  std::atomic<std::size_t> entered_twice = 0, loops = 0;
  pgdr::with_threads(threads, [&] {
    pgdr::run_task_graph(
        tasks, [](std::size_t, std::vector<std::uint32_t>& out) { out.clear(); },
        [&](std::size_t) {
          int& mine = busy[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())];
          entered_twice += mine++ != 0;
          tbb::parallel_for(0, 64, [&](int) {
            ++loops;
            std::this_thread::sleep_for(std::chrono::microseconds(20));
          });
          --mine;
        });
    return 0;
  });
  CHECK(loops == 64 * tasks);
  CHECK(entered_twice == 0);
}
