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
  /// The same of the task of a territory that was made larger: soon enough there may be room for more of them (table in docs/performance.md).
  static constexpr std::size_t most_in_larger = 1024;

  void start_epoch() { halvings_ = 0; }

  /// One round, or none where that is not worth while, or where the one before left too much undone. `task` is what the leaf's
  /// own task would be; `drain(part, task)` runs one part, on any thread.
  template <class Drain>
  std::optional<Round> run(Engine& engine, Worker& worker, Worklist& list, const Leaf_task& task, Task_recorder& recorder,
                           const Drain& drain) {
    if (std::exchange(is_stalled_, false)) return std::nullopt;
    double begin = recorder.now();
    auto division = engine.divide(worker, list, task, rounds_++, halvings_);
    const std::size_t n = division.parts.size();
    recorder.section("division", false, begin);
    if (n == 0) return std::nullopt;
    std::vector<Drain_result> results(n);
    run_task_graph(
        n, [](std::size_t, std::vector<std::uint32_t>& successors) { successors.clear(); },
        [&](std::size_t k) {
          Leaf_task part = task;
          if (halvings_ > 0) part.pause_after = most_in_larger;
          part.territory = division.territories[k];
          part.region = part.territory.region;
          if (task.quota != Leaf_task{}.quota) part.quota = task.quota / n + (k < task.quota % n ? 1 : 0);
          results[k] = drain(division.parts[k], part);
        });
    begin = recorder.now();
    std::size_t handed_on = 0;
    for (Worklist& part : division.parts) handed_on += part.outgoing().size();
    engine.unite(list, division.parts, task.target, task.outside_target);
    Round round{{}, n};
    for (const Drain_result& r : results) {
      round.result.inserted += r.inserted;
      round.result.refused += r.refused;
      round.result.limited += r.limited;
      round.result.stopped |= r.stopped;
    }
    recorder.section("union", false, begin);
    judge(round.result.inserted, handed_on);
    return round;
  }

 private:
  /// Where most of a round was in vain, since cavities or split points lay beyond a border, the next one has larger territories; where
  /// hardly anything was, far smaller ones.
  void judge(std::size_t inserted, std::size_t handed_on) {
    const double part = inserted == 0 ? 0 : static_cast<double>(inserted) / static_cast<double>(inserted + handed_on);
    is_stalled_ = part < 0.5;
    if (part < 0.4) ++halvings_;
    if (part > 0.7) halvings_ /= 2;
  }

  std::size_t rounds_ = 0;
  unsigned halvings_ = 0;  ///< of the number of territories
  bool is_stalled_ = false;
};

}  // namespace pgdr

#endif
