// SPDX-License-Identifier: GPL-3.0-or-later
//
// Predicts the time of the parallel refinement on machines with more cores, from the trace of a run on this one:
// the leaf tasks of each wave are scheduled again, as they depend on one another, on 1 to 256 simulated workers.
//
// The speed-up is an upper bound. Simulated workers share no caches and no memory bandwidth, start tasks without
// delay, and divide parallel loops evenly; the work is that of the recorded run. Record with one thread: two
// threads that already slow each other down record longer tasks.
//
// usage: replay_trace FILE.json [--workers P,P,...] [--epochs] [--json]
//   FILE.json  written by `pgdr mesh ... --trace FILE.json`; see replay/trace.h
//   --workers  default 1,2,4,8,16,32,64,128,256
//   --epochs   a second table, one row for each epoch
//   --json     everything as JSON instead of tables

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "replay/prediction.h"
#include "replay/trace.h"

namespace {

using namespace pgdr::bench;

constexpr const char* usage = "usage: replay_trace FILE.json [--workers P,P,...] [--epochs] [--json]\n";

struct Arguments {
  std::string file;
  std::vector<std::size_t> workers = {1, 2, 4, 8, 16, 32, 64, 128, 256};
  bool epochs = false, json = false;
};

/// Nothing if they make no sense.
std::optional<std::vector<std::size_t>> parse_workers(const std::string& text) {
  std::vector<std::size_t> workers;
  std::istringstream in(text);
  for (std::string item; std::getline(in, item, ',');) {
    char* end = nullptr;
    const long value = std::strtol(item.c_str(), &end, 10);
    if (item.empty() || *end != '\0' || value < 1 || value > 1000000) return std::nullopt;
    workers.push_back(static_cast<std::size_t>(value));
  }
  if (workers.empty()) return std::nullopt;
  return workers;
}

std::optional<Arguments> parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--epochs") {
      arguments.epochs = true;
    } else if (word == "--json") {
      arguments.json = true;
    } else if (word == "--workers" && i + 1 < argc) {
      const auto workers = parse_workers(argv[++i]);
      if (!workers) return std::nullopt;
      arguments.workers = *workers;
    } else if (word.empty() || word[0] == '-' || !arguments.file.empty()) {
      return std::nullopt;
    } else {
      arguments.file = word;
    }
  }
  if (arguments.file.empty()) return std::nullopt;
  return arguments;
}

void print_tables(const Trace& trace, const Replay& r, bool epochs) {
  std::printf("recorded on %u thread%s: %.3f s\n", trace.threads, trace.threads == 1 ? "" : "s", r.recorded);
  std::printf(
      "  in %zu leaf tasks of %zu waves  %10.3f s of work, and %.3f s between them within the waves\n",
      r.tasks, r.waves, r.leaf_work, r.overhead);
  std::printf("  in parallel sections            %10.3f s of work\n", r.parallel_work);
  std::printf("  in serial sections              %10.3f s, and %.3f s in no event: serial share %.2f %%\n",
              r.serial, r.unrecorded, 100 * r.serial_share);
  std::printf("tasks that touch: %zu pairs; ready at once: at most %zu, on average %.1f\n", r.edges,
              r.ready_max, r.ready_mean);
  std::printf("critical path (endlessly many workers): %.3f s\n\n", r.critical_path);
  std::printf("simulated, without any limit of memory bandwidth:\n");
  std::printf("workers     seconds  speed-up  efficiency\n");
  for (const Prediction& p : r.predictions)
    std::printf("%7zu  %10.3f  %8.2f  %9.1f %%\n", p.workers, p.seconds, p.speed_up, 100 * p.efficiency);
  if (!epochs) return;
  std::printf("\n  epoch  waves     tasks      work, s  critical path, s  work/path  at once\n");
  for (const Epoch_figures& e : r.epochs)
    std::printf("%7u  %5zu  %8zu  %11.3f  %16.4f  %9.1f  %7zu\n", e.epoch, e.waves, e.tasks, e.work,
                e.critical_path, e.critical_path > 0 ? e.work / e.critical_path : 0.0, e.ready_max);
}

void print_json(const Trace& trace, const Replay& r) {
  using Json = nlohmann::ordered_json;
  Json predictions = Json::array(), epochs = Json::array();
  for (const Prediction& p : r.predictions)
    predictions.push_back({{"workers", p.workers},
                           {"seconds", p.seconds},
                           {"speed_up", p.speed_up},
                           {"efficiency", p.efficiency}});
  for (const Epoch_figures& e : r.epochs)
    epochs.push_back({{"epoch", e.epoch},
                      {"waves", e.waves},
                      {"tasks", e.tasks},
                      {"work_seconds", e.work},
                      {"critical_path_seconds", e.critical_path},
                      {"ready_max", e.ready_max}});
  const Json json = {{"threads", trace.threads},
                     {"tasks", r.tasks},
                     {"waves", r.waves},
                     {"edges", r.edges},
                     {"recorded_seconds", r.recorded},
                     {"leaf_work_seconds", r.leaf_work},
                     {"parallel_work_seconds", r.parallel_work},
                     {"serial_seconds", r.serial},
                     {"unrecorded_seconds", r.unrecorded},
                     {"overhead_seconds", r.overhead},
                     {"serial_share", r.serial_share},
                     {"critical_path_seconds", r.critical_path},
                     {"ready_max", r.ready_max},
                     {"ready_mean", r.ready_mean},
                     {"predictions", predictions},
                     {"epochs", epochs}};
  std::cout << json.dump(2) << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  const auto arguments = parse(argc, argv);
  if (!arguments) {
    std::cerr << usage;
    return 2;
  }
  std::ifstream file(arguments->file, std::ios::binary);
  if (!file) {
    std::cerr << "replay_trace: cannot read " << arguments->file << "\n";
    return 1;
  }
  try {
    const Trace trace = read_trace(file);
    const Replay result = replay(trace, arguments->workers);
    if (arguments->json)
      print_json(trace, result);
    else
      print_tables(trace, result, arguments->epochs);
  } catch (const Trace_error& error) {
    std::cerr << "replay_trace: " << arguments->file << ": " << error.what() << "\n";
    return 1;
  }
}
