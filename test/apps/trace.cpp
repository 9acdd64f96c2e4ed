// SPDX-License-Identifier: GPL-3.0-or-later
// What `--trace` and the schedule in `--stats` say about a parallel run.
#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <pgdr/schedule/task_order.h>

#include "program.h"

using nlohmann::json;
using pgdr_test::file_text;
using pgdr_test::Sandbox;
using pgdr_test::shape;

namespace {

struct Traced_run {
  explicit Traced_run(const std::string& arguments) {
    const auto run = sandbox.run("mesh " + arguments + " --quiet -o out.mesh --stats s.json --trace t.json");
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(sandbox.names() == std::set<std::string>{"out.mesh", "s.json", "t.json"});
    stats = json::parse(file_text(sandbox / "s.json"));
    trace = json::parse(file_text(sandbox / "t.json"));
  }

  /// The events of one category, in the order of the file.
  std::vector<json> events(const std::string& category) const {
    std::vector<json> found;
    for (const json& e : trace["traceEvents"])
      if (e["cat"] == category) found.push_back(e);
    return found;
  }

  Sandbox sandbox;
  json stats, trace;
};

/// A task of a leaf, times in microseconds.
struct Task {
  pgdr::Octree_key key;
  double begin, end;
  int territory;  ///< not 0 where the leaf's work was divided
};

std::map<int, std::vector<Task>> waves(const std::vector<json>& leaf_events) {
  std::map<int, std::vector<Task>> waves;
  for (const json& e : leaf_events) {
    const json& a = e["args"];
    const pgdr::Octree_key key{a["x"].get<std::uint32_t>(), a["y"].get<std::uint32_t>(), a["z"].get<std::uint32_t>(),
                               a["level"].get<std::uint8_t>()};
    const double begin = e["ts"].get<double>();
    waves[a["wave"].get<int>()].push_back({key, begin, begin + e["dur"].get<double>(), a["territory"].get<int>()});
  }
  return waves;
}

/// Times are written to the nanosecond.
constexpr double rounding = 0.003;

void check_run(const Traced_run& run, unsigned threads) {
  const json& schedule = run.stats["schedule"];
  CHECK(run.stats["threads"] == threads);
  CHECK(run.trace["otherData"]["threads"] == threads);
  const auto leaf = run.events("leaf"), serial = run.events("serial"), parallel = run.events("parallel");
  CHECK(leaf.size() + serial.size() + parallel.size() == run.trace["traceEvents"].size());
  CHECK(!serial.empty());
  CHECK(!parallel.empty());

  // Events of one thread do not overlap, and come in order of time.
  std::map<unsigned, double> busy_until;
  for (const json& e : run.trace["traceEvents"]) {
    CHECK(e["ph"] == "X");
    CHECK(e["tid"].get<unsigned>() < threads);
    if (e["cat"] != "leaf") continue;
    CHECK(e["ts"].get<double>() >= busy_until[e["tid"].get<unsigned>()] - rounding);
    busy_until[e["tid"].get<unsigned>()] = e["ts"].get<double>() + e["dur"].get<double>();
  }

  // In a wave, tasks of touching leaves run one after the other, in the order that the octree gives them.
  std::size_t ordered = 0, early = 0, tasks = 0;
  double last_end = 0;
  for (const auto& [number, wave] : waves(leaf)) {
    tasks += wave.size();
    double end = last_end;
    for (std::size_t i = 0; i < wave.size(); ++i) {
      early += wave[i].begin < last_end - rounding;  // waves do not overlap
      end = std::max(end, wave[i].end);
      for (std::size_t j = 0; j < wave.size(); ++j) {
        if (i != j) CHECK((wave[i].territory != wave[j].territory || !(wave[i].key == wave[j].key)));
        if (i == j || wave[i].territory != 0 || !pgdr::touch(wave[i].key, wave[j].key) || !pgdr::Task_order()(wave[i].key, wave[j].key)) continue;
        ++ordered;
        early += wave[j].begin < wave[i].end - rounding;
      }
    }
    last_end = end;
  }
  CHECK(early == 0);
  CHECK(ordered > 100);

  // Every point is accounted for.
  std::size_t traced = 0, counted = 0, counted_tasks = 0, most_ready = 0;
  for (const json& e : leaf) traced += e["args"]["inserted"].get<std::size_t>();
  for (const json& e : schedule["epochs"]) {
    counted += e["inserted"].get<std::size_t>();
    counted_tasks += e["tasks"].get<std::size_t>();
    most_ready = std::max(most_ready, e["most_ready"].get<std::size_t>());
    CHECK(e["inserted_alone"].get<std::size_t>() <= e["inserted"].get<std::size_t>());
    CHECK(e["seconds"].get<double>() >= 0);
    CHECK(e["serial_share"].get<double>() >= 0);
    CHECK(e["serial_share"].get<double>() <= 1.001);
  }
  const double meshing = run.stats["seconds"]["triangulation"].get<double>() + run.stats["seconds"]["conforming"].get<double>() +
                         run.stats["seconds"]["labelling"].get<double>() + run.stats["seconds"]["refinement"].get<double>() +
                         run.stats["seconds"].value("slivers", 0.0);
  const double side_by_side = schedule["seconds"].get<double>() * (1 - schedule["serial_share"].get<double>()) +
                              run.stats["slivers"]["parallel_seconds"].get<double>();
  CHECK(run.stats["serial_share"].get<double>() == Approx(1 - side_by_side / meshing).margin(1e-3));
  CHECK(tasks == counted_tasks);
  CHECK(most_ready >= 8);
  CHECK(traced + schedule["settled"].get<std::size_t>() == counted);
  CHECK(counted <= run.stats["steiner_points"].get<std::size_t>());
}

}  // namespace

TEST_CASE("a trace shows tasks of touching leaves one after the other", "[apps]") {
  const Traced_run run(shape("cube.poly") + " --size 0.022 --min-dihedral 0 --threads 4 --check-zones");
  check_run(run, 4);
  // Nothing is inserted but by the refinement.
  std::size_t counted = 0;
  for (const json& e : run.stats["schedule"]["epochs"]) counted += e["inserted"].get<std::size_t>();
  CHECK(counted == run.stats["steiner_points"].get<std::size_t>());
  // Several threads had tasks.
  std::set<unsigned> threads;
  for (const json& e : run.events("leaf")) threads.insert(e["tid"].get<unsigned>());
  CHECK(threads.size() > 1);
}

TEST_CASE("a trace of leaves of many sizes is in order", "[apps]") {
  const Traced_run run(shape("winged_body_in_box.poly") + " --size 0.8 --threads 3");
  check_run(run, 3);
}

TEST_CASE("without --trace no task is recorded, and the mesh is the same", "[apps]") {
  const Traced_run traced(shape("cube.poly") + " --size 0.04 --threads 2");
  const Sandbox sandbox;
  REQUIRE(sandbox.run("mesh " + shape("cube.poly") + " --size 0.04 --threads 1 --quiet -o out.mesh").exit_code == 0);
  CHECK(sandbox.names() == std::set<std::string>{"out.mesh"});
  CHECK(file_text(sandbox / "out.mesh") == file_text(traced.sandbox / "out.mesh"));
}
