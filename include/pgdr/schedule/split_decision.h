// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SCHEDULE_SPLIT_DECISION_H
#define PGDR_SCHEDULE_SPLIT_DECISION_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <pgdr/independence/zone_condition.h>
#include <pgdr/schedule/leaf_table.h>

namespace pgdr {

/// Circumradius to which a leaf is refined so that its own split is possible: its children are half as long, and the
/// zone condition allows them an eighth of that.
inline double zone_target(double shortest) { return shortest / 16 * (1 - 1e-5); }

/// Decides which leaves to split: those with enough left to do, as far as afterwards the octree is balanced and the
/// zone condition holds for every leaf, the new ones and those beside them.
template <class Engine>
class Split_decision {
 public:
  using Leaf = Scheduled_leaf<Engine>;
  using Worklist = typename Engine::Worklist;

  /// Below this number of expected insertions a leaf is not worth splitting; the first of all leaves is worth it
  /// later, since from then on the outside has to be refined as well.
  static constexpr double least_work = 4000, least_work_of_all = 10000;

  /// `outside_points`: see `Parameters`.
  Split_decision(const Engine& engine, const Linear_octree_3& octree, std::vector<Leaf>& leaves, double outside_points)
      : engine_(engine), octree_(octree), leaves_(leaves), outside_points_(outside_points), split_(octree.size(), 0), next_(octree), last_(octree) {}

  /// True if the octree changes: see `split`, `next` and `parents`. Leaves that will not be split become final; where
  /// only deferred elements are in the way, the leaves around are asked to refine these first.
  bool decide() {
    nominate();
    while (true) {
      close_under_balance();
      if (std::none_of(split_.begin(), split_.end(), [](std::uint8_t s) { return s; })) break;
      next_ = octree_.split(split_, &parents_);
      if (!check()) continue;
      if (pays()) return true;
      for (std::uint32_t i = 0; i < octree_.size(); ++i)
        if (split_[i]) veto(i, true);
    }
    next_ = octree_;
    parents_.clear();
    // Nothing can be split, and nobody was asked to make room: from here on every leaf finishes what it has.
    if (!progress_)
      for (Leaf& leaf : leaves_) leaf.final = leaf.final || leaf.work.deferred() > 0;
    return false;
  }

  const std::vector<std::uint8_t>& split() const { return split_; }
  const Linear_octree_3& next() const { return next_; }
  const std::vector<std::uint32_t>& parents() const { return parents_; }
  /// What a scan found to be the coarsest element near a new leaf; none where it was not needed.
  const std::optional<double>& measured(std::uint32_t j) const { return judged_[j].coarsest; }

 private:
  enum class Verdict : std::uint8_t {
    untouched,  ///< nothing changes for it
    good,       ///< its zone condition will hold
    pending,    ///< not before something deferred is refined
    coarse,     ///< it will not
    open        ///< only a scan can tell
  };
  struct Judgement {
    Verdict verdict = Verdict::untouched;
    double shortest = 0;  ///< ell* that it was made for
    std::optional<double> coarsest{};
  };

  void nominate() {
    std::vector<std::uint8_t> ended(octree_.size(), 0);
    gain_.assign(octree_.size(), 0);
    for_leaves(octree_.size(), [&](std::uint32_t i) {
      Leaf& leaf = leaves_[i];
      leaf.work.measure_deferred();
      if (leaf.final || leaf.work.deferred() == 0) return;
      const Work_estimate e = engine_.estimate(leaf.work);
      // Fine elements grow to about the sizing field, and children could not stand larger ones than the target.
      const bool small_enough = e.largest_size >= zone_target(leaf.shortest) && e.largest_size <= leaf.edge;
      if (e.insertions < (octree_.size() == 1 ? least_work_of_all : least_work) || small_enough || octree_[i].level + 1 >= Octree_key::max_level) {
        leaf.final = true;
        ended[i] = 1;
      } else {
        split_[i] = 1;
        gain_[i] = e.insertions;
      }
    });
    progress_ = std::any_of(ended.begin(), ended.end(), [](std::uint8_t e) { return e; });
    for (std::uint32_t i = 0; i < octree_.size(); ++i)
      if (leaves_[i].work.coarsest() >= 0.25 * leaves_[i].shortest) far_reaching_.push_back(i);
  }

  /// Larger leaves beside a candidate have to be split with it; where one is vetoed, so is the candidate.
  void close_under_balance() {
    if (vetoed_.empty()) {
      vetoed_.resize(octree_.size(), 0);
      nominated_ = split_;
    }
    while (!try_to_balance()) {
    }
  }

  /// Starts from the beginning, since what was added for the sake of a leaf that is vetoed by now is not needed any
  /// more. False if something else was vetoed.
  bool try_to_balance() {
    for (std::uint32_t i = 0; i < octree_.size(); ++i) split_[i] = nominated_[i] && !vetoed_[i];
    bool changed = true, good = true;
    while (changed) {
      changed = false;
      for (std::uint32_t i = 0; i < octree_.size(); ++i) {
        if (!split_[i]) continue;
        for (const std::uint32_t n : leaves_[i].touching) {
          if (octree_[n].level >= octree_[i].level || split_[n]) continue;
          if (vetoed_[n]) {
            veto(i, false);
            good = false;
            break;
          }
          split_[n] = 1;
          changed = true;
        }
      }
    }
    return good;
  }

  void veto(std::uint32_t i, bool for_good) {
    split_[i] = 0;
    vetoed_[i] = 1;
    if (for_good && leaves_[i].work.deferred() > 0 && !leaves_[i].final) {
      leaves_[i].final = true;
      progress_ = true;
    }
  }

  /// Whether what is left to do is worth what has to be refined outside the domain for the sake of smaller leaves.
  bool pays() const {
    double gains = 0;
    for (std::uint32_t i = 0; i < octree_.size(); ++i)
      if (split_[i]) gains += gain_[i];
    if (octree_.size() == 1) return root_pays(gains);
    std::vector<double> target(octree_.size(), std::numeric_limits<double>::infinity());
    for (std::uint32_t j = 0; j < next_.size(); ++j)
      target[parents_[j]] = std::min(target[parents_[j]], zone_target(next_.shortest_touching_edge(j)));
    std::vector<double> cost(octree_.size(), 0);
    for_leaves(octree_.size(), [&](std::uint32_t i) {
      if (target[i] < zone_target(leaves_[i].shortest)) cost[i] = engine_.estimate_outside(leaves_[i].work, target[i]);
    });
    return std::accumulate(cost.begin(), cost.end(), 0.0) <= outside_points_ * gains;
  }

  /// The first leaf's work can be divided without a split. Leaves are of more use only when many of them are in the domain: eight all
  /// touch, and are worked on one after the other. So the cost is that of leaves as small as that.
  bool root_pays(double gain) const {
    const Volumes volumes = engine_.volumes();
    // Rounding may leave nothing of a very thin domain.
    const double most_parts = std::ldexp(1.0, static_cast<int>(Octree_key::max_level));
    double parts = 4;
    while (parts < most_parts && volumes.inside * parts * parts * parts < 8 * leaves_[0].edge * leaves_[0].edge * leaves_[0].edge) parts *= 2;
    return expected_vertices(volumes.outside, zone_target(leaves_[0].shortest / parts)) <= outside_points_ * gain;
  }

  /// Evaluates the zone condition where the octree changes. False if something was vetoed.
  bool check() {
    std::vector<Judgement> before = std::move(judged_);
    judged_.assign(next_.size(), {});
    std::vector<std::uint32_t> first(octree_.size() + 1, 0);
    for (std::uint32_t i = 0; i < octree_.size(); ++i) first[i + 1] = first[i] + (split_[i] ? 8 : 1);
    for_leaves(octree_.size(), [&](std::uint32_t i) {
      judge_family(first[i], first[i + 1], before);
    });
    last_ = next_;
    bool good = true;
    const std::vector<std::uint8_t> were_split = split_;
    for (std::uint32_t j = 0; j < next_.size(); ++j) {
      const Verdict verdict = judged_[j].verdict;
      if (verdict != Verdict::pending && verdict != Verdict::coarse) continue;
      good = false;
      const bool for_good = verdict == Verdict::coarse;
      if (!for_good) make_room(j);
      const std::uint32_t p = parents_[j];
      if (were_split[p]) {
        veto(p, for_good);
        continue;
      }
      // It stays as it is: the smaller leaves beside it are what it cannot stand.
      for (const std::uint32_t n : leaves_[p].touching)
        if (were_split[n] && 0.5 * leaves_[n].edge < leaves_[p].shortest) veto(n, for_good);
    }
    return good;
  }

  /// Judges what becomes of one leaf: new leaves [first, last). One that cannot be is enough.
  void judge_family(std::uint32_t first, std::uint32_t last, const std::vector<Judgement>& before) {
    bool open = false;
    for (std::uint32_t j = first; j < last; ++j) {
      judged_[j] = judge_again(j, before);
      if (judged_[j].verdict == Verdict::pending || judged_[j].verdict == Verdict::coarse) return;
      open = open || judged_[j].verdict == Verdict::open;
    }
    if (!open) return;
    // What is known of the leaves around does not tell: look at the elements, for all of the family at once if
    // that is enough.
    Requirement all = requirement(first);
    all.hole_lower = all.hole_upper = all.lower;
    for (std::uint32_t j = first + 1; j < last; ++j) {
      const Requirement r = requirement(j);
      all.bound = std::min(all.bound, r.bound);
      for (std::size_t k = 0; k < 3; ++k) {
        all.lower[k] = std::min(all.lower[k], r.lower[k]);
        all.upper[k] = std::max(all.upper[k], r.upper[k]);
      }
    }
    const Worklist& work = leaves_[parents_[first]].work;
    Scan_result scan;
    if (last > first + 1) scan = engine_.scan(box_of(all), hole_of(all), all.bound, work);
    const bool together = scan.finer;
    for (std::uint32_t j = first; j < last; ++j) {
      if (judged_[j].verdict != Verdict::open) continue;
      const Requirement r = requirement(j);
      if (!together) scan = engine_.scan(box_of(r), hole_of(r), r.bound, work);
      judged_[j].verdict = scan.finer ? Verdict::good : Verdict::coarse;
      if (!scan.finer) return;
      if (!leaves_[parents_[j]].final) judged_[j].coarsest = scan.coarsest;
    }
  }

  Requirement requirement(std::uint32_t j) const {
    std::vector<Requirement> requirements;
    Zone_condition().requirements(next_, j, requirements);
    return requirements.front();
  }
  static Region_3 box_of(const Requirement& r) {
    return {{r.lower[0], r.lower[1], r.lower[2]}, {r.upper[0], r.upper[1], r.upper[2]}};
  }
  static Region_3 hole_of(const Requirement& r) {
    return {{r.hole_lower[0], r.hole_lower[1], r.hole_lower[2]}, {r.hole_upper[0], r.hole_upper[1], r.hole_upper[2]}};
  }

  /// Most leaves are the same as in the attempt before.
  Judgement judge_again(std::uint32_t j, const std::vector<Judgement>& before) const {
    if (!before.empty()) {
      const std::uint32_t i = last_.find(next_[j]);
      if (last_[i] == next_[j] && before[i].verdict != Verdict::untouched && before[i].verdict != Verdict::open &&
          before[i].shortest == next_.shortest_touching_edge(j))
        return before[i];
    }
    return judge(j);
  }

  Judgement judge(std::uint32_t j) const {
    const std::uint32_t p = parents_[j];
    Judgement result;
    result.shortest = next_.shortest_touching_edge(j);
    if (!split_[p] && result.shortest == leaves_[p].shortest) return result;
    const Requirement r = requirement(j);
    std::vector<std::uint32_t> around;
    next_.touching(j, around);
    around.push_back(j);
    double pending = 0, coarse = 0;
    for (const std::uint32_t n : around) {
      pending = std::max(pending, leaves_[parents_[n]].work.measured_deferred());
      coarse = std::max(coarse, leaves_[parents_[n]].work.coarsest());
    }
    result.verdict = Verdict::pending;
    if (pending >= r.bound) return result;
    const Region_3 box = box_of(r);
    const bool reached = std::any_of(far_reaching_.begin(), far_reaching_.end(), [&](std::uint32_t i) {
      const Region_3 leaf = grown(leaf_region(octree_, i), 2 * leaves_[i].work.coarsest());
      for (int k = 0; k < 3; ++k)
        if (leaf.upper[k] < box.lower[k] || box.upper[k] < leaf.lower[k]) return false;
      return true;
    });
    result.verdict = coarse < r.bound && !reached ? Verdict::good : Verdict::open;
    return result;
  }

  /// Asks the leaves around a new one to refine what only waits there.
  void make_room(std::uint32_t j) {
    const double bound = zone_target(2 * next_.shortest_touching_edge(j));
    std::vector<std::uint32_t> around;
    next_.touching(j, around);
    around.push_back(j);
    for (const std::uint32_t n : around) {
      Leaf& leaf = leaves_[parents_[n]];
      if (leaf.work.measured_deferred() <= bound || leaf.cap <= bound) continue;
      leaf.cap = bound;
      progress_ = true;
    }
  }

  const Engine& engine_;
  const Linear_octree_3& octree_;
  std::vector<Leaf>& leaves_;
  double outside_points_;
  std::vector<std::uint8_t> split_;
  std::vector<double> gain_;  ///< insertions that wait for the split
  std::vector<std::uint8_t> nominated_;
  std::vector<std::uint8_t> vetoed_;
  std::vector<std::uint32_t> far_reaching_;
  Linear_octree_3 next_;
  Linear_octree_3 last_;  ///< of the attempt before
  std::vector<Judgement> judged_;
  std::vector<std::uint32_t> parents_;
  bool progress_ = false;
};

}  // namespace pgdr

#endif
