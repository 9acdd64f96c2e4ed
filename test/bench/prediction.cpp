// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay/prediction.h"

#include <algorithm>
#include <vector>

#include "catch.h"
#include "replay/list_schedule.h"
#include "replay/wave_graph.h"
#include "traces.h"

using namespace pgdr::bench;
using namespace pgdr_test;

TEST_CASE("a chain takes as long on any number of workers") {
  // A row of leaves of ever smaller size, each touching only the one before and the one after.
  const std::vector<Leaf_task> tasks = {task(node(1, 0, 0, 0), 4), task(node(2, 2, 0, 0), 2),
                                        task(node(3, 6, 0, 0), 1), task(node(4, 14, 0, 0), 3)};
  const Wave_graph graph = make_wave_graph(tasks);
  REQUIRE(graph.successors.size() == 3);
  for (std::size_t workers : {1, 2, 7}) CHECK(list_schedule(graph, workers) == 10);
  CHECK(wave_width(graph).critical_path == 10);
  CHECK(wave_width(graph).ready_max == 1);
}

TEST_CASE("independent tasks are dealt out") {
  std::vector<Leaf_task> tasks;
  for (std::uint32_t i = 0; i < 8; ++i) tasks.push_back(task(node(4, 2 * i, 0, 0), 1));
  const Wave_graph graph = make_wave_graph(tasks);
  REQUIRE(graph.successors.empty());
  CHECK(list_schedule(graph, 1) == 8);
  CHECK(list_schedule(graph, 2) == 4);
  CHECK(list_schedule(graph, 3) == 3);
  CHECK(list_schedule(graph, 8) == 1);
  CHECK(list_schedule(graph, 100) == 1);
  CHECK(wave_width(graph).ready_max == 8);
}

TEST_CASE("first come, first served: a long task that is last in the queue is started late") {
  // The same four leaves, the long one first or last in the order of Morton codes.
  const auto seconds = [](double first, double last) {
    return list_schedule(
        make_wave_graph(std::vector<Leaf_task>{task(node(4, 0, 0, 0), first), task(node(4, 2, 0, 0), 1),
                                               task(node(4, 4, 0, 0), 1), task(node(4, 6, 0, 0), last)}),
        2);
  };
  CHECK(seconds(3, 1) == 3);
  CHECK(seconds(1, 3) == 4);
}

TEST_CASE("a uniform grid runs in eight colours") {
  const int level = 4;  // 4096 leaves, 512 of each colour
  const Wave_graph graph = make_wave_graph(grid(level, 1));
  const Wave_width width = wave_width(graph);
  CHECK(width.critical_path == 8);
  CHECK(width.ready_first == 512);
  CHECK(width.ready_max == 512);
  CHECK(list_schedule(graph, 1) == 4096);
  CHECK(list_schedule(graph, 512) == 8);
  CHECK(list_schedule(graph, 4096) == 8);
  CHECK(list_schedule(graph, 64) == 64);
}

TEST_CASE("no schedule beats its bounds, and greedy ones keep Graham's") {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const Wave_graph graph = make_wave_graph(random_leaves(seed, 5));
    double work = 0;
    for (double s : graph.seconds) work += s;
    const double path = wave_width(graph).critical_path;
    CHECK(list_schedule(graph, 1) == Approx(work));
    CHECK(list_schedule(graph, graph.size()) == Approx(path));
    for (std::size_t p : {2, 3, 4, 16, 64}) {
      const double time = list_schedule(graph, p), each = work / static_cast<double>(p);
      CHECK(time >= std::max(path, each) * (1 - 1e-12));
      CHECK(time <= (each + path * (1 - 1 / static_cast<double>(p))) * (1 + 1e-12));
    }
  }
}

TEST_CASE("waves, serial and parallel sections add up") {
  Trace trace;
  trace.threads = 2;
  // 0-1 serial; 1-3 a wave of 4 s of work on 2 threads; 3-5 a parallel loop; 5-6 nothing recorded; 6-8 a second wave.
  trace.sections = {{"plan", 0, 1, false}, {"sort", 3, 2, true}};
  trace.tasks = {{node(4, 0, 0, 0), 0, 0, 1, 1}, {node(4, 2, 0, 0), 0, 0, 1, 1},
                 {node(4, 4, 0, 0), 0, 0, 2, 1}, {node(4, 6, 0, 0), 0, 0, 2, 1},
                 {node(4, 0, 0, 0), 0, 1, 6, 1}, {node(4, 1, 0, 0), 0, 1, 7, 1}};
  const Replay result = replay(trace, {1, 2, 4, 8});
  CHECK(result.recorded == Approx(8));
  CHECK(result.leaf_work == Approx(6));
  CHECK(result.parallel_work == Approx(4));
  CHECK(result.serial == Approx(1));
  CHECK(result.unrecorded == Approx(1));
  CHECK(result.overhead == Approx(2));  // the second thread during the second wave
  CHECK(result.serial_share == Approx(0.25));
  CHECK(result.critical_path == Approx(1 + 1 + 1 + 2));
  CHECK(result.waves == 2);
  CHECK(result.edges == 1);
  CHECK(result.ready_max == 4);
  CHECK(result.ready_mean == Approx(2));
  REQUIRE(result.predictions.size() == 4);
  CHECK(result.predictions[0].seconds == Approx(12));
  CHECK(result.predictions[1].seconds == Approx(8));  // as it was recorded
  CHECK(result.predictions[2].seconds == Approx(1 + 1 + 1 + 1 + 2));
  CHECK(result.predictions[3].seconds == Approx(1 + 1 + 1 + 0.5 + 2));
  CHECK(result.predictions[2].speed_up == Approx(2));
  CHECK(result.predictions[2].efficiency == Approx(0.5));
  REQUIRE(result.epochs.size() == 1);
  CHECK(result.epochs[0].waves == 2);
  CHECK(result.epochs[0].critical_path == Approx(3));
}

TEST_CASE("a wave in which a section ran is refused") {
  Trace trace;
  trace.tasks = {{node(4, 0, 0, 0), 3, 1, 1, 1}, {node(4, 2, 0, 0), 3, 1, 2, 1}};
  trace.sections = {{"plan", 0, 1.000001, false}};  // rounded to microseconds
  CHECK_NOTHROW(replay(trace, {1}));
  trace.sections = {{"plan", 2.5, 0.1, false}};
  CHECK_THROWS_AS(replay(trace, {1}), Trace_error);
}
