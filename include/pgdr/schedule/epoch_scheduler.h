// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SCHEDULE_EPOCH_SCHEDULER_H
#define PGDR_SCHEDULE_EPOCH_SCHEDULER_H

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <pgdr/independence/buffer_condition.h>
#include <pgdr/octree/linear_octree_3.h>
#include <pgdr/parallel/task_graph.h>
#include <pgdr/parallel/thread_arena.h>
#include <pgdr/parameters.h>
#include <pgdr/report/schedule_statistics.h>
#include <pgdr/schedule/divided_work.h>
#include <pgdr/schedule/leaf_table.h>
#include <pgdr/schedule/split_decision.h>
#include <pgdr/schedule/task_order.h>
#include <pgdr/schedule/task_recorder.h>

namespace pgdr {

/// Refines with all threads of the calling thread's TBB arena (one without TBB); the mesh is the same for every number of them.
///
/// Alternates between *waves*, graphs of leaf tasks in which the tasks of touching leaves are ordered by the octree
/// alone, and *decisions* on which leaves to split. An epoch is what happens between two decisions. A task's effect is
/// a function of the mesh within its leaf's zone and of its worklist; by the zone theorem and the gap lemma
/// (docs/theory.md) the zones of leaves that do not touch are disjoint. So no task ever waits for a lock, none is
/// undone, and timing decides nothing.
///
/// Leaves are split only where the zone condition holds afterwards, so that every leaf may always run. Where the mesh
/// is too coarse for smaller leaves (steep grading), a large leaf does all of its work in one task.
template <LeafRefiner Engine>
class Epoch_scheduler {
  using Leaf = Scheduled_leaf<Engine>;
  using Worklist = typename Engine::Worklist;
  using Parcel = typename Engine::Parcel;
  using Worker = typename Engine::Worker;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

 public:
  /// `vertices` is the number of vertices at the start, against which `Parameters::max_vertices` counts.
  Epoch_scheduler(Engine& engine, const Parameters& parameters, std::size_t vertices)
      : engine_(engine), parameters_(parameters), vertices_(vertices),
        octree_(Octree_box::around(corner(engine.hull().lower), corner(engine.hull().upper))),
        recorder_(parameters.record_tasks, thread_count()) {
    for (unsigned t = 0; t < thread_count(); ++t) workers_.push_back(engine.make_worker());
  }

  /// Refines until nothing poor is left or a limit is reached; then returns false.
  bool run() {
    leaves_.resize(1);
    const double begin = recorder_.now();
    leaves_[0].work = engine_.everything(*workers_[0]);
    connect_leaves(octree_, leaves_);
    recorder_.section("first worklist", false, begin);
    if (parameters_.octree_depth > 0)
      run_on_fixed_octree();
    else
      run_in_epochs();
    if (stopped_) close();
    finish_epoch();
    statistics_.threads = static_cast<unsigned>(workers_.size());
    statistics_.root_lower = octree_.box().lower();
    statistics_.root_edge = octree_.box().edge();
    statistics_.seconds = recorder_.now();
    statistics_.serial_seconds = recorder_.serial();
    statistics_.records = recorder_.take();
    return !stopped_;
  }

  Schedule_statistics& statistics() { return statistics_; }
  /// How often an element was given up at the minimum edge length.
  std::size_t limited() const { return limited_; }

 private:
  static std::array<double, 3> corner(const Vec_3& p) { return {p.x, p.y, p.z}; }

  // Epochs.

  void run_in_epochs() {
    while (true) {
      start_epoch();
      run_waves();
      if (stopped_ || !has_deferred()) return;
      decide_and_split();
    }
  }

  void decide_and_split() {
    double begin = recorder_.now();
    Split_decision<Engine> decision(engine_, octree_, leaves_, parameters_.outside_points);
    const bool change = decision.decide();
    recorder_.section("decision", true, begin);
    if (!change) return;
    if (!refines_outside_) {
      // The first split of all: now the outside matters, too.
      begin = recorder_.now();
      refines_outside_ = true;
      engine_.add_outside(*workers_[0], leaves_[0].work, zone_target(leaves_[0].shortest));
      recorder_.section("outside", false, begin);
      return;
    }
    split(decision.split(), decision.next());
    for (std::uint32_t j = 0; j < octree_.size(); ++j)
      if (decision.measured(j)) leaves_[j].work.reset_coarsest(*decision.measured(j));
  }

  void start_epoch() {
    finish_epoch();
    divided_.start_epoch();
    const double begin = recorder_.now();
    Epoch_statistics epoch;
    epoch.leaves = leaves_.size();
    statistics_.epochs.push_back(epoch);
    epoch_start_ = begin;
    epoch_serial_ = recorder_.serial();
    for_leaves(leaves_.size(), [this](std::uint32_t i) {
      Leaf& leaf = leaves_[i];
      leaf.target = leaf.final ? 0 : std::min(leaf.cap, zone_target(leaf.shortest));
      engine_.activate(leaf.work, leaf.target, outside_target(leaf));
    });
    for (const Leaf& leaf : leaves_) statistics_.epochs.back().active += leaf.work.active();
    recorder_.section("targets", true, begin);
  }

  void finish_epoch() {
    if (statistics_.epochs.empty() || epoch_start_ < 0) return;
    Epoch_statistics& epoch = statistics_.epochs.back();
    for (const Leaf& leaf : leaves_) epoch.deferred += leaf.work.deferred();
    epoch.seconds = recorder_.now() - epoch_start_;
    epoch.serial_seconds = recorder_.serial() - epoch_serial_;
    epoch_start_ = -1;
  }

  bool has_deferred() const {
    return std::any_of(leaves_.begin(), leaves_.end(), [](const Leaf& leaf) { return leaf.work.deferred() > 0; });
  }

  double outside_target(const Leaf& leaf) const {
    if (outside_limit_ > 0) return std::min(leaf.cap, outside_limit_);
    const bool stays_alone = leaves_.size() == 1 && leaf.final;
    return refines_outside_ && !stays_alone ? std::min(leaf.cap, zone_target(leaf.shortest)) : infinity;
  }

  /// Replaces the leaves by those of `next`, which splits the marked ones. \pre no parcel is under way
  void split(const std::vector<std::uint8_t>& which, const Linear_octree_3& next) {
    const double begin = recorder_.now();
    std::vector<Leaf> fresh(next.size());
    std::vector<std::uint32_t> first(leaves_.size());
    for (std::uint32_t i = 0, j = 0; i < leaves_.size(); ++i) {
      first[i] = j;
      j += which[i] ? 8 : 1;
    }
    std::vector<std::vector<std::pair<std::uint32_t, Parcel>>> strays(leaves_.size());
    for_leaves(leaves_.size(), [&](std::uint32_t i) {
      const std::uint32_t j = first[i];
      if (!which[i]) {
        fresh[j] = std::move(leaves_[i]);
        return;
      }
      for (std::uint32_t c = j; c < j + 8; ++c) {
        fresh[c].work.inherit(leaves_[i].work);
        fresh[c].final = leaves_[i].final;
      }
      engine_.dispatch(worker(), leaves_[i].work, [&](Parcel&& parcel) {
        const std::uint32_t to = next.find(corner(parcel.at));
        if (to >= j && to < j + 8)
          engine_.receive(fresh[to].work, std::move(parcel), infinity, infinity);
        else
          strays[i].emplace_back(to, std::move(parcel));
      });
    });
    for (auto& list : strays)
      for (auto& [to, parcel] : list) engine_.receive(fresh[to].work, std::move(parcel), infinity, infinity);
    leaves_ = std::move(fresh);
    octree_ = next;
    connect_leaves(octree_, leaves_);
    recorder_.section("split", true, begin);
  }

  // Waves.

  void run_waves() {
    while (!stopped_ && wave()) {
      deliver_far();
      // A task that was stopped still has pieces of its own to recover: until then nothing can be mended.
      if (std::none_of(results_.begin(), results_.end(), [](const Drain_result& r) { return r.stopped; })) settle(false);
      report();
    }
  }

  /// Runs every leaf that has work, once. False if there was none.
  bool wave() {
    double begin = recorder_.now();
    runnable_.clear();
    for (std::uint32_t i = 0; i < leaves_.size(); ++i)
      if (leaves_[i].work.has_work() || leaves_[i].inbound) runnable_.push_back(i);
    if (runnable_.empty()) return false;
    const std::size_t quota = share_of_budget();
    if (stopped_) return true;
    Epoch_statistics& epoch = statistics_.epochs.back();
    ++epoch.waves;
    epoch.tasks += runnable_.size();
    results_.assign(runnable_.size(), {});
    if (runnable_.size() == 1) {
      recorder_.section("wave", false, begin);
      if (!run_divided(quota)) run_alone(0, quota);
    } else {
      run_graph(begin, quota);
    }
    begin = recorder_.now();
    std::size_t inserted = 0;
    for (const Drain_result& r : results_) {
      inserted += r.inserted;
      limited_ += r.limited;
    }
    epoch.inserted += inserted;
    vertices_ += inserted;
    if (parameters_.cancel && parameters_.cancel->load(std::memory_order_relaxed)) stopped_ = true;
    ++wave_;
    recorder_.section("results", false, begin);
    return true;
  }

  void run_graph(double begin, std::size_t quota) {
    std::vector<std::uint32_t> together, alone;
    node_of_.assign(leaves_.size(), none);
    for (std::uint32_t k = 0; k < runnable_.size(); ++k)
      if (leaves_[runnable_[k]].admissible) {
        node_of_[runnable_[k]] = static_cast<std::uint32_t>(together.size());
        together.push_back(k);
      } else {
        alone.push_back(k);
      }
    recorder_.section("wave", false, begin);
    if (!together.empty()) {
      const Task_order before{parameters_.task_order};
      const std::size_t ready = run_task_graph(
          together.size(),
          [&](std::size_t n, std::vector<std::uint32_t>& out) {
            out.clear();
            const std::uint32_t i = runnable_[together[n]];
            for (const std::uint32_t t : leaves_[i].touching)
              if (node_of_[t] != none && before(octree_[i], octree_[t])) out.push_back(node_of_[t]);
          },
          [&](std::size_t n) { run_leaf(together[n], quota); });
      Epoch_statistics& epoch = statistics_.epochs.back();
      epoch.most_ready = std::max(epoch.most_ready, ready);
    }
    for (const std::uint32_t k : alone) run_alone(k, quota);
  }

  void run_alone(std::size_t k, std::size_t quota) {
    const double begin = recorder_.now();
    run_leaf(k, quota);
    recorder_.lone_leaf(begin);
    Epoch_statistics& epoch = statistics_.epochs.back();
    epoch.inserted_alone += results_[k].inserted;
    epoch.most_ready = std::max<std::size_t>(epoch.most_ready, 1);
  }

  /// Whether the only leaf's work may be divided; the paper's octree is left as the paper has it.
  bool is_divisible() const { return leaves_.size() == 1 && parameters_.octree_depth == 0; }

  /// Where one leaf is everything: its work, divided. False if that is not worth while.
  bool run_divided(std::size_t quota) {
    if (!is_divisible()) return false;
    const Leaf_task task = task_for(leaves_[0], quota);
    const auto round = divided_.run(engine_, *workers_[0], leaves_[0].work, task, recorder_, [&](Worklist& part, Leaf_task mine) {
      const double start = recorder_.now();
      if (parameters_.check_zones) mine.tag = thread_tag();
      const Drain_result result = engine_.drain(worker(), mine, part);
      recorder_.leaf(octree_[0], static_cast<std::uint16_t>(mine.territory.number - mine.territory.first), statistics_.epochs.size() - 1, wave_, result.inserted, start);
      return result;
    });
    if (!round) return false;
    results_[0] = round->result;
    Epoch_statistics& epoch = statistics_.epochs.back();
    epoch.most_ready = std::max(epoch.most_ready, round->tasks);
    epoch.tasks += round->tasks - 1;
    return true;
  }

  /// What a leaf's task is, wherever the leaf is.
  Leaf_task task_for(const Leaf& leaf, std::size_t quota) const {
    Leaf_task task;
    task.target = leaf.target;
    task.outside_target = outside_target(leaf);
    task.last = leaf.final;
    task.quota = quota;
    task.cancel = parameters_.cancel;
    return task;
  }

  static std::uint16_t thread_tag() { return static_cast<std::uint16_t>(thread_number() + 1); }

  /// The k-th runnable leaf: gathers what came for it, works, and leaves what belongs to others in its outbox.
  void run_leaf(std::size_t k, std::size_t quota) {
    const double begin = recorder_.now();
    const std::uint32_t i = runnable_[k];
    Leaf& leaf = leaves_[i];
    gather(i);
    Leaf_task task = task_for(leaf, quota == unlimited ? quota : quota + (k < extra_ ? 1 : 0));
    task.region = leaf_region(octree_, i);
    const Region_3 box = closed_box(i);
    task.near = leaf.admissible && leaves_.size() > 1 ? grown(box, leaf.shortest / 4) : Region_3{};
    task.reach = leaf.admissible && leaves_.size() > 1 ? grown(box, leaf.shortest / 2) : Region_3{};
    task.features_only = std::any_of(leaf.touching.begin(), leaf.touching.end(),
                                     [this](std::uint32_t n) { return leaves_[n].work.is_torn(); });
    if (is_divisible()) task.pause_after = Divided_work<Engine>::most_alone;
    if (parameters_.check_zones) task.tag = thread_tag();
    results_[k] = engine_.drain(worker(), task, leaf.work);
    post(leaf.work, i);
    recorder_.leaf(octree_[i], 0, statistics_.epochs.size() - 1, wave_, results_[k].inserted, begin);
  }

  void gather(std::uint32_t i) {
    Leaf& leaf = leaves_[i];
    if (!leaf.has_inbound().exchange(0, std::memory_order_relaxed)) return;
    for (const std::uint32_t n : leaf.touching) {
      auto& slot = leaves_[n].outbox[leaves_[n].slot_of(i)];
      for (Parcel& parcel : slot) engine_.receive(leaf.work, std::move(parcel), leaf.target, outside_target(leaf));
      std::vector<Parcel>().swap(slot);
    }
  }

  void post(Worklist& work, std::uint32_t from) {
    Leaf& leaf = leaves_[from];
    for (Parcel& parcel : work.outgoing()) {
      const std::uint32_t to = octree_.find(corner(parcel.at));
      const std::size_t slot = leaf.slot_of(to);
      if (slot < leaf.outbox.size()) {
        leaf.outbox[slot].push_back(std::move(parcel));
        leaves_[to].has_inbound().store(1, std::memory_order_relaxed);
      } else {
        leaf.far.emplace_back(to, std::move(parcel));
      }
    }
    work.outgoing().clear();
    work.release_memory();
  }

  void deliver_far() {
    const double begin = recorder_.now();
    for (const std::uint32_t i : runnable_) {
      auto far = std::move(leaves_[i].far);
      leaves_[i].far.clear();
      statistics_.far_parcels += far.size();
      for (auto& [to, parcel] : far) deliver(to, std::move(parcel));
    }
    recorder_.section("far parcels", false, begin);
  }

  void deliver(std::uint32_t to, Parcel&& parcel) {
    engine_.receive(leaves_[to].work, std::move(parcel), leaves_[to].target, outside_target(leaves_[to]));
  }

  /// What no leaf could do: missing pieces whose split points lie elsewhere.
  void settle(bool closing) {
    std::vector<Worklist*> torn;
    double target = infinity;
    for (Leaf& leaf : leaves_) {
      if (closing || leaf.work.is_torn()) torn.push_back(&leaf.work);
      target = std::min(target, outside_target(leaf));
    }
    if (torn.empty()) return;
    const double begin = recorder_.now();
    Worklist rest;
    const Drain_result result = engine_.settle(*workers_[0], torn, closing, target, rest, parameters_.cancel);
    vertices_ += result.inserted;
    statistics_.settled += result.inserted;
    statistics_.epochs.back().inserted += result.inserted;
    statistics_.epochs.back().inserted_alone += result.inserted;
    engine_.dispatch(*workers_[0], rest,
                     [&](Parcel&& parcel) { deliver(octree_.find(corner(parcel.at)), std::move(parcel)); });
    recorder_.section("settling", false, begin);
  }

  void close() {
    for (Leaf& leaf : leaves_) leaf.inbound = 0;
    settle(true);
  }

  /// How many points a leaf may insert in the next wave; stops where the budget is spent.
  std::size_t share_of_budget() {
    extra_ = 0;
    const std::size_t left = parameters_.vertex_limit() - std::min(parameters_.vertex_limit(), vertices_);
    if (left == 0) stopped_ = true;
    if (parameters_.max_vertices == 0) return unlimited;
    extra_ = left % runnable_.size();
    return left / runnable_.size();
  }

  void report() {
    if (!parameters_.progress) return;
    std::size_t pending = 0;
    for (const Leaf& leaf : leaves_) pending += leaf.work.size();
    parameters_.progress({"refinement", vertices_, pending});
  }

  Region_3 closed_box(std::uint32_t i) const {
    Region_3 r;
    const auto lo = octree_.lower(i), hi = octree_.upper(i);
    for (int k = 0; k < 3; ++k) {
      r.lower[k] = lo[static_cast<std::size_t>(k)];
      r.upper[k] = hi[static_cast<std::size_t>(k)];
    }
    return r;
  }

  Worker& worker() { return *workers_[thread_number()]; }

  // The octree of the paper.

  /// Refines alone until condition (18) and the zone condition hold on the octree of the given depth, then in
  /// parallel; leaves for which they never hold run alone.
  void run_on_fixed_octree() {
    const int level = parameters_.octree_depth - 1;
    start_epoch();
    Leaf& root = leaves_[0];
    root.target = level == 0 ? 0 : zone_target(2 * octree_.box().edge(level));
    if (level > 0) {
      refines_outside_ = true;
      outside_limit_ = root.target;
      engine_.add_outside(*workers_[0], root.work, root.target);
    }
    engine_.activate(root.work, root.target, outside_target(root));
    run_waves();
    if (stopped_ || level == 0) return;
    while (octree_[0].level < level) {
      const std::vector<std::uint8_t> all(octree_.size(), 1);
      split(all, octree_.split(all));
    }
    for (Leaf& leaf : leaves_) leaf.final = true;
    judge_fixed_leaves();
    start_epoch();
    run_waves();
  }

  void judge_fixed_leaves() {
    const double begin = recorder_.now();
    std::vector<std::uint8_t> buffered(leaves_.size(), 0);
    for_leaves(octree_.size(), [&](std::uint32_t i) {
      buffered[i] = engine_.has_smaller_circumballs(closed_box(i), octree_.edge(i) / 6, leaves_[i].work);
    });
    for_leaves(octree_.size(), [&](std::uint32_t i) {
      std::vector<std::uint32_t> around;
      octree_.buffer(i, around);
      bool good = std::all_of(around.begin(), around.end(), [&](std::uint32_t n) { return buffered[n]; });
      if (good)
        good = engine_.scan(grown(closed_box(i), 3 * leaves_[i].shortest / 8), closed_box(i),
                            leaves_[i].shortest / 8, leaves_[i].work).finer;
      leaves_[i].admissible = good;
    });
    recorder_.section("conditions", true, begin);
  }

  static constexpr std::uint32_t none = 0xffffffffu;
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

  Engine& engine_;
  const Parameters& parameters_;
  std::size_t vertices_;
  Linear_octree_3 octree_;
  std::vector<Leaf> leaves_;
  std::vector<std::unique_ptr<Worker>> workers_;
  Task_recorder recorder_;
  Divided_work<Engine> divided_;
  Schedule_statistics statistics_;
  std::vector<std::uint32_t> runnable_;
  std::vector<std::uint32_t> node_of_;
  std::vector<Drain_result> results_;
  std::size_t wave_ = 0;
  std::size_t limited_ = 0;
  std::size_t extra_ = 0;
  double epoch_start_ = -1;
  double epoch_serial_ = 0;
  double outside_limit_ = 0;
  bool refines_outside_ = false;
  bool stopped_ = false;
};

}  // namespace pgdr

#endif
