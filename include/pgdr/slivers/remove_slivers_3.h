// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_REMOVE_SLIVERS_3_H
#define PGDR_SLIVERS_REMOVE_SLIVERS_3_H

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_walk.h>
#include <pgdr/refinement/divide_worklist_3.h>
#include <pgdr/refinement/territory_map.h>
#include <pgdr/report/run_statistics.h>
#include <pgdr/slivers/sliver_remover_3.h>

namespace pgdr {

/// Removes tetrahedra with a dihedral angle below the wanted one, with all threads of the caller's arena, in rounds each of which divides
/// them among territories; the mesh is the same for every number of threads.
template <class Tr, class Criteria>
class Sliver_removal_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;
  using Sliver = Sliver_3<Tr>;
  using Remover = Sliver_remover_3<Tr, Criteria>;

  /// `wanted`: the cosine of the angle.
  Sliver_removal_3(Tr& tr, Complex& complex, const Criteria& criteria, double min_edge_length, double wanted, const std::atomic<bool>* cancel)
      : tr_(tr), complex_(complex), judge_(criteria, min_edge_length), wanted_(wanted), cancel_(cancel) {}

  Sliver_statistics run() {
    std::vector<Sliver> slivers = find_slivers();
    statistics_.found = slivers.size();
    for (std::size_t round = 0; !slivers.empty() && !is_cancelled(); ++round) {
      const std::size_t n = round < most_rounds ? territory_count(slivers.size(), 0) : 0;
      slivers = n == 0 ? alone(std::move(slivers)) : divided(std::move(slivers), n, round);
      if (n == 0) break;
    }
    statistics_.left = hopeless_ + slivers.size();
    return statistics_;
  }

 private:
  static constexpr std::size_t most_rounds = 3;

  bool is_cancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }

  std::vector<Sliver> find_slivers() const {
    std::vector<Sliver> all;
    const auto look = [this](std::size_t, auto it, std::size_t count) {
      std::vector<Sliver> part;
      for (; count > 0; --count, ++it) {
        const Cell_handle c = it;
        if (c->subdomain() == 0 || tr_.is_infinite(c)) continue;
        if (const double cosine = largest_dihedral_cosine(tetrahedron_points(c)); cosine > wanted_) part.push_back(Sliver::of(c, cosine));
      }
      return part;
    };
    for (const auto& part : parallel_walk(tr_.all_cells_begin(), tr_.all_cells_end(), default_grain, look))
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  std::vector<Sliver> alone(std::vector<Sliver> slivers) {
    for (auto v = tr_.finite_vertices_begin(); v != tr_.finite_vertices_end(); ++v) v->set_territory(0);
    return take(Remover(tr_, complex_, judge_, wanted_, {}).run(std::move(slivers)));
  }

  std::vector<Sliver> divided(std::vector<Sliver> slivers, std::size_t n, std::size_t round) {
    constexpr std::array<double, 3> shares{0.5, 0.4, 0.6};
    std::vector<Territory_map::Item> sample;
    for (const Sliver& s : slivers) {
      const Tetrahedron_points p = tetrahedron_points(s.cell);
      const Vec_3 center = 0.25 * (p[0] + p[1] + p[2] + p[3]);
      sample.push_back({center, {center, center}});
    }
    mark_territories(tr_, Territory_map(std::move(sample), n, shares[round % shares.size()]));
    std::vector<std::vector<Sliver>> parts(n);
    std::vector<Sliver> left;
    for (const Sliver& s : slivers) {
      const std::uint16_t t = s.cell->vertex(0)->territory();
      bool is_own = true;
      for (int i = 1; i < 4; ++i) is_own &= s.cell->vertex(i)->territory() == t;
      (is_own ? parts[t - 1] : left).push_back(s);
    }
    std::vector<typename Remover::Result> results(n);
    parallel_for(0, n, [&](std::size_t k) {
      results[k] = Remover(tr_, complex_, judge_, wanted_, {static_cast<std::uint16_t>(k + 1)}).run(std::move(parts[k]));
    });
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
    hopeless_ += result.hopeless.size();
    return std::move(result.foreign);
  }

  Tr& tr_;
  Complex& complex_;
  Tetrahedron_judge<Criteria> judge_;
  double wanted_;
  const std::atomic<bool>* cancel_;
  Sliver_statistics statistics_;
  std::size_t hopeless_ = 0;
};

}  // namespace pgdr

#endif
