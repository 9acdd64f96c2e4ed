// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SCHEDULE_DIVIDED_WORK_H
#define PGDR_SCHEDULE_DIVIDED_WORK_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <pgdr/parallel/task_graph.h>
#include <pgdr/refinement/leaf_refiner.h>
#include <pgdr/schedule/task_recorder.h>

namespace pgdr {

/// Works on a leaf that is everything with all threads: in rounds, each of which divides the work among territories whose
/// borders are elsewhere than before. What is on a border waits for another round, or for the leaf's own task, alone.
///
/// How the work is divided depends on the work, never on the number of threads.
template <LeafRefiner Engine>
class Divided_work {
 public:
  using Worker = typename Engine::Worker;
  using Worklist = typename Engine::Worklist;

  struct Round {
    Drain_result result;    ///< of all parts together
    std::size_t tasks = 0;  ///< one for each part
  };

  /// Points that the leaf's own task inserts before it is asked again whether the work should be divided.
  static constexpr std::size_t most_alone = 128;

  void start_epoch() { halvings_ = 0; }

  /// One round, or none where that is not worth while, or where the one before left too much undone. `task` is what the leaf's
  /// own task would be; `drain(part, task)` runs one part, on any thread.
  template <class Drain>
  std::optional<Round> run(Engine& engine, Worker& worker, Worklist& list, const Leaf_task& task, Task_recorder& recorder,
                           const Drain& drain) {
    if (std::exchange(is_stalled_, false)) return std::nullopt;
    double begin = recorder.now();
    const std::size_t active = list.active();
    auto division = engine.divide(worker, list, task, rounds_++, halvings_);
    const std::size_t n = division.parts.size();
    recorder.section("division", false, begin);
    if (n == 0) return std::nullopt;
    std::vector<Drain_result> results(n);
    run_task_graph(
        n, [](std::size_t, std::vector<std::uint32_t>& successors) { successors.clear(); },
        [&](std::size_t k) {
          Leaf_task part = task;
          part.region = division.regions[k];
          part.territory = static_cast<std::uint16_t>(k + 1);
          if (task.quota != Leaf_task{}.quota) part.quota = task.quota / n + (k < task.quota % n ? 1 : 0);
          results[k] = drain(division.parts[k], part);
        });
    begin = recorder.now();
    engine.unite(list, division.parts, task.target, task.outside_target);
    Round round{{}, n};
    for (const Drain_result& r : results) {
      round.result.inserted += r.inserted;
      round.result.refused += r.refused;
      round.result.limited += r.limited;
      round.result.stopped |= r.stopped;
    }
    recorder.section("union", false, begin);
    judge(static_cast<double>(list.active()) / static_cast<double>(active));
    return round;
  }

 private:
  /// `left`: how much is left to do, most of it because it belongs to nobody. Larger territories have less of that.
  void judge(double left) {
    is_stalled_ = left > 0.5;
    if (left > 0.6) ++halvings_;
    if (left < 0.3 && halvings_ > 0) --halvings_;
  }

  std::size_t rounds_ = 0;
  unsigned halvings_ = 0;  ///< of the number of territories
  bool is_stalled_ = false;
};

}  // namespace pgdr

#endif
