// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_OPTIMIZE_MESH_3_H
#define PGDR_SLIVERS_OPTIMIZE_MESH_3_H

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/refinement/canonical_order.h>
#include <pgdr/refinement/divide_worklist_3.h>
#include <pgdr/report/run_statistics.h>
#include <pgdr/slivers/vertex_mover_3.h>

namespace pgdr {

/// Makes tetrahedra better on average, by moves of the vertices inside of volumes, with all threads of the caller's arena: in rounds, each of
/// which divides the vertices among territories and tries to move each one once that is not at a border. The mesh is the same for every number of threads.
template <class Tr, class Criteria>
class Mesh_optimizer_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Vertex_handle = typename Tr::Vertex_handle;

  /// `wanted`: the cosine of an angle. No tetrahedron is made with a smaller one, unless one as small is there already.
  Mesh_optimizer_3(Tr& tr, Complex& complex, const Criteria& criteria, double min_edge_length, double wanted, const std::atomic<bool>* cancel)
      : tr_(tr), complex_(complex), judge_(criteria, min_edge_length), wanted_(wanted), cancel_(cancel) {}

  /// `notify`: told before every round how many vertices are to be looked at.
  Optimization_statistics run(std::size_t rounds, const std::function<void(std::size_t)>& notify = {}) {
    Optimization_statistics statistics;
    std::size_t still = 0;  // rounds in a row that moved nothing
    for (; statistics.rounds < rounds && !is_cancelled(); ++statistics.rounds) {
      const std::vector<Vertex_handle> vertices = inner_vertices();
      if (notify) notify(vertices.size());
      const std::size_t n = territory_count(vertices.size(), 0);
      const std::size_t moved = n == 0 ? alone(vertices) : divided(vertices, n, statistics.rounds);
      statistics.moved += moved;
      still = moved == 0 ? still + 1 : 0;
      if (still == (n == 0 ? 1 : shares.size())) break;  // the borders come again
    }
    return statistics;
  }

 private:
  using Mover = Vertex_mover_3<Tr, Criteria>;

  static constexpr std::array<double, 3> shares{0.5, 0.4, 0.6};  ///< where borders are, by turns

  bool is_cancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }

  /// Neighbors in space are neighbors in the list, which does not depend on the order of the triangulation's: timing decides that one.
  std::vector<Vertex_handle> inner_vertices() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<Vertex_handle> vertices;
    std::vector<std::array<double, 3>> points;
    std::array<double, 3> lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
    for (auto it = tr_.finite_vertices_begin(); it != tr_.finite_vertices_end(); ++it) {
      const Vertex_handle v = it;
      if (v->in_dimension() != 3 || v->cell()->subdomain() == 0) continue;
      const Vec_3 p = position(v);
      vertices.push_back(v);
      points.push_back({p.x, p.y, p.z});
      for (std::size_t k = 0; k < 3; ++k) {
        lower[k] = std::min(lower[k], points.back()[k]);
        upper[k] = std::max(upper[k], points.back()[k]);
      }
    }
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    internal::sort_along_curve(order, points, lower, upper);
    std::vector<Vertex_handle> sorted;
    sorted.reserve(order.size());
    for (const std::uint32_t i : order) sorted.push_back(vertices[i]);
    return sorted;
  }

  std::size_t alone(const std::vector<Vertex_handle>& vertices) { return move_all(vertices, {}); }

  /// With other borders in every round.
  std::size_t divided(const std::vector<Vertex_handle>& vertices, std::size_t n, std::size_t round) {
    constexpr std::size_t most_samples = 100'000;
    const Territories_3<Tr> territories(tr_, {sample_vertices(tr_, most_samples), n, shares[round % shares.size()]});
    std::vector<std::vector<Vertex_handle>> parts(n);
    for (const Vertex_handle v : vertices) parts[territories.of(position(v))].push_back(v);
    std::vector<std::size_t> moved(n);
    parallel_for(0, n, [&](std::size_t k) { moved[k] = move_all(parts[k], territories[k]); });
    return std::accumulate(moved.begin(), moved.end(), std::size_t{0});
  }

  std::size_t move_all(const std::vector<Vertex_handle>& vertices, const Territory_3<Tr>& territory) {
    Mover mover(tr_, complex_, judge_, territory);
    std::size_t moved = 0;
    for (const Vertex_handle v : vertices) {
      if (is_cancelled()) break;
      moved += mover.smooth(v, wanted_) == Mover::Outcome::moved;
    }
    return moved;
  }

  Tr& tr_;
  Complex& complex_;
  Tetrahedron_judge<Criteria> judge_;
  double wanted_;
  const std::atomic<bool>* cancel_;
};

}  // namespace pgdr

#endif
