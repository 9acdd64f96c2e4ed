// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SCHEDULE_TASK_RECORDER_H
#define PGDR_SCHEDULE_TASK_RECORDER_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pgdr/octree/octree_key.h>
#include <pgdr/parallel/thread_arena.h>
#include <pgdr/report/schedule_statistics.h>

namespace pgdr {

/// Times what the scheduler does, and keeps a record of every task if that is wanted.
class Task_recorder {
  using Clock = std::chrono::steady_clock;

 public:
  Task_recorder(bool keep, std::size_t threads)
      : keep_(keep), of_thread_(threads), start_(Clock::now()) {}

  double now() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  void leaf(const Octree_key& key, std::uint16_t territory, std::size_t epoch, std::size_t wave, std::size_t inserted, double begin) {
    if (!keep_) return;
    Task_record r;
    r.territory = territory;
    r.level = key.level;
    r.x = key.x;
    r.y = key.y;
    r.z = key.z;
    r.epoch = static_cast<std::uint32_t>(epoch);
    r.wave = static_cast<std::uint32_t>(wave);
    r.inserted = static_cast<std::uint32_t>(inserted);
    add(r, begin, now());
  }

  /// A section between waves; from the scheduler's own thread.
  void section(const char* name, bool parallel, double begin) {
    const double end = now();
    if (!parallel) serial_ += end - begin;
    if (keep_) {
      Task_record r;
      r.kind = parallel ? Task_record::Kind::parallel : Task_record::Kind::serial;
      r.name = name;
      add(r, begin, end);
    }
  }

  /// A leaf task, recorded by `leaf`, beside which there was no other.
  void lone_leaf(double begin) { serial_ += now() - begin; }

  /// Seconds in serial sections and lone tasks so far.
  double serial() const { return serial_; }

  std::vector<Task_record> take() {
    std::vector<Task_record> all;
    for (auto& records : of_thread_) all.insert(all.end(), records.begin(), records.end());
    std::sort(all.begin(), all.end(), [](const Task_record& a, const Task_record& b) { return a.start < b.start; });
    return all;
  }

 private:
  void add(Task_record& r, double begin, double end) {
    const std::size_t t = thread_number();
    r.thread = static_cast<std::uint16_t>(t);
    r.start = begin;
    r.seconds = end - begin;
    of_thread_[t].push_back(r);
  }

  bool keep_;
  std::vector<std::vector<Task_record>> of_thread_;
  Clock::time_point start_;
  double serial_ = 0;
};

}  // namespace pgdr

#endif
