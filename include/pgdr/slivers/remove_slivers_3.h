// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_REMOVE_SLIVERS_3_H
#define PGDR_SLIVERS_REMOVE_SLIVERS_3_H

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_walk.h>
#include <pgdr/report/run_statistics.h>
#include <pgdr/slivers/divide_slivers_3.h>
#include <pgdr/slivers/feature_sliver_remover_3.h>
#include <pgdr/slivers/sliver_remover_3.h>

namespace pgdr {

/// Removes tetrahedra with a dihedral angle below the wanted one, with all threads of the caller's arena: by moves and new vertices inside,
/// in rounds each of which divides the slivers among territories; then, alone, by new vertices on features; and so on, until that
/// makes no difference. The mesh is the same for every number of threads.
template <class Tr, class Criteria, class Engine>
class Sliver_removal_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Sliver = Sliver_3<Tr>;
  using Remover = Sliver_remover_3<Tr, Criteria>;

  /// `wanted`: the cosine of the angle. `engine` refines what is split. `most_vertices`: of the triangulation.
  Sliver_removal_3(Tr& tr, Complex& complex, const Criteria& criteria, double min_edge_length, double wanted, Engine& engine,
                   std::size_t most_vertices, const std::atomic<bool>* cancel)
      : tr_(tr), known_before_(tr.reserve_territories(1)), complex_(complex), judge_(criteria, min_edge_length, &engine.acute()), wanted_(wanted), engine_(engine), most_vertices_(most_vertices),
        cancel_(cancel) {}

  /// `notify`: told before every round how many slivers are to be looked at.
  Sliver_statistics run(const std::function<void(std::size_t)>& notify = {}) {
    std::vector<Sliver> slivers = find_slivers();
    statistics_.found = slivers.size();
    give_up_pinched(slivers);
    Feature_sliver_remover_3<Tr, Criteria, Engine> on_features(tr_, complex_, judge_, wanted_, engine_, most_vertices_, cancel_);
    for (int pass = 0; pass < most_passes; ++pass) {
      for (std::size_t round = 0; !slivers.empty() && !is_cancelled(); ++round) {
        if (notify) notify(slivers.size());
        const std::size_t n = round < most_rounds ? territory_count(slivers.size(), 0) : 0;
        slivers = n == 0 ? alone(std::move(slivers)) : divided(std::move(slivers), n, round);
        if (n == 0) break;
      }
      if (!remove_on_features(on_features)) break;
      slivers = find_new_slivers();
      give_up_pinched(slivers);
    }
    is_limited_ = on_features.is_limited();
    // What is left of them all was given up, or not looked at.
    statistics_.left = slivers.empty() && !is_any_given_up_ ? 0 : find_slivers().size();
    return statistics_;
  }

  /// Whether the last run ended near the limit of vertices.
  bool is_limited() const { return is_limited_; }

 private:
  static constexpr std::size_t most_rounds = 3;  ///< with territories
  static constexpr int most_passes = 6;          ///< three are enough for most models

  /// Books the time until it is destroyed.
  class Side_by_side {
   public:
    explicit Side_by_side(Sliver_statistics& statistics) : statistics_(statistics) {}
    ~Side_by_side() { statistics_.parallel_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

   private:
    Sliver_statistics& statistics_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  };

  bool is_cancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }

  /// Vertices that may still be added.
  std::size_t quota() const { return most_vertices_ - std::min(most_vertices_, tr_.number_of_vertices()); }

  std::vector<Sliver> find_slivers() {
    const Side_by_side timer(statistics_);
    std::vector<Sliver> all;
    const auto look = [this](std::size_t, auto it, std::size_t count) {
      std::vector<Sliver> part;
      for (; count > 0; --count, ++it) add_if_sliver(it, part);
      return part;
    };
    for (const auto& part : parallel_walk(tr_.all_cells_begin(), tr_.all_cells_end(), default_grain, look))
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  /// Those at vertices that were inserted since all others were numbered. Others were given up, or have been looked at.
  std::vector<Sliver> find_new_slivers() {
    const auto is_new = [](Vertex_handle v) { return v->territory() == 0; };
    std::vector<Sliver> found;
    std::vector<Cell_handle> around;
    for (auto v = tr_.finite_vertices_begin(); v != tr_.finite_vertices_end(); ++v) {
      if (!is_new(v)) continue;
      around.clear();
      tr_.tds().incident_cells(v, std::back_inserter(around));
      for (const Cell_handle c : around) {
        // With more than one, it is the first one's.
        bool is_first = true;
        for (int i = 0; c->vertex(i) != Vertex_handle(v); ++i) is_first &= !is_new(c->vertex(i));
        if (is_first) add_if_sliver(c, found);
      }
    }
    return found;
  }

  void add_if_sliver(Cell_handle c, std::vector<Sliver>& to) const {
    if (c->subdomain() != 0 && !tr_.is_infinite(c)) Sliver::add_if_below(c, wanted_, to);
  }

  void give_up_pinched(std::vector<Sliver>& slivers) {
    is_any_given_up_ |= std::erase_if(slivers, [](const Sliver& s) { return s.is_pinched; }) > 0;
  }

  std::vector<Sliver> alone(std::vector<Sliver> slivers) {
    return take(Remover(tr_, complex_, judge_, wanted_, {}, quota(), cancel_).run(std::move(slivers)));
  }

  std::vector<Sliver> divided(std::vector<Sliver> slivers, std::size_t n, std::size_t round) {
    constexpr std::array<double, most_rounds> shares{0.5, 0.4, 0.6};
    const Divided_slivers_3<Tr> divided = divide_slivers(tr_, complex_, slivers, n, shares[round]);
    const auto at = [&slivers](const std::vector<std::size_t>& positions) {
      std::vector<Sliver> list;
      list.reserve(positions.size());
      for (const std::size_t k : positions) list.push_back(slivers[k]);
      return list;
    };
    std::vector<Sliver> left = at(divided.left);
    std::vector<typename Remover::Result> results(n);
    const std::size_t share = quota() / n;
    {
      const Side_by_side timer(statistics_);
      parallel_for(0, n, [&](std::size_t k) {
        results[k] = Remover(tr_, complex_, judge_, wanted_, divided.territories[k], share, cancel_).run(at(divided.parts[k]));
      });
    }
    for (auto& r : results) {
      const std::vector<Sliver> foreign = take(std::move(r));
      left.insert(left.end(), foreign.begin(), foreign.end());
    }
    std::erase_if(left, [](const Sliver& s) { return !s.is_live(); });
    return left;
  }

  std::vector<Sliver> take(typename Remover::Result&& result) {
    statistics_.moved += result.moved;
    statistics_.added += result.added;
    give_up_pinched(result.hopeless);
    hopeless_.insert(hopeless_.end(), result.hopeless.begin(), result.hopeless.end());
    return std::move(result.foreign);
  }

  /// Of what nothing inside can cure. False if that adds nothing.
  bool remove_on_features(Feature_sliver_remover_3<Tr, Criteria, Engine>& remover) {
    std::erase_if(hopeless_, [](const Sliver& s) { return !s.is_live(); });
    if (hopeless_.empty()) return false;
    std::sort(hopeless_.begin(), hopeless_.end());
    parallel_for_each(tr_.finite_vertices_begin(), tr_.finite_vertices_end(), default_grain, [this](auto v) { v->set_territory(known_before_); });
    const std::size_t inserted = remover.remove(hopeless_);
    is_any_given_up_ |= std::ranges::any_of(hopeless_, &Sliver::is_live);
    hopeless_.clear();
    statistics_.added += inserted;
    return inserted > 0;
  }

  Tr& tr_;
  const std::uint32_t known_before_;  ///< number for the vertices that there are; new ones, with nobody else at work, have 0
  Complex& complex_;
  Tetrahedron_judge<Criteria> judge_;
  double wanted_;
  Engine& engine_;
  std::size_t most_vertices_;
  const std::atomic<bool>* cancel_;
  Sliver_statistics statistics_;
  std::vector<Sliver> hopeless_;  ///< what is left inside
  bool is_any_given_up_ = false, is_limited_ = false;
};

}  // namespace pgdr

#endif
