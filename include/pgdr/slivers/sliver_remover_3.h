// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_SLIVER_REMOVER_3_H
#define PGDR_SLIVERS_SLIVER_REMOVER_3_H

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <pgdr/mesh/prefetch.h>
#include <pgdr/slivers/sliver_3.h>
#include <pgdr/slivers/sliver_inserter_3.h>
#include <pgdr/slivers/vertex_mover_3.h>

namespace pgdr {

/// Removes slivers within a territory, one after the other: moves vertices, then adds some, then moves again.
///
/// What it does is a function of the mesh within the territory and of the slivers that it is given.
template <class Tr, class Criteria>
class Sliver_remover_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Sliver = Sliver_3<Tr>;

  struct Result {
    std::size_t moved = 0, added = 0;
    std::vector<Sliver> foreign;   ///< those for which other borders might help
    std::vector<Sliver> hopeless;  ///< the other ones that are left
  };

  /// `wanted`: the cosine of the angle below which a tetrahedron is a sliver.
  /// `quota`: vertices that may be added.
  Sliver_remover_3(Tr& tr, Complex& complex, const Tetrahedron_judge<Criteria>& judge, double wanted, const Territory_3<Tr>& territory,
                   std::size_t quota, const std::atomic<bool>* cancel)
      : wanted_(wanted), quota_(quota), cancel_(cancel), mover_(tr, complex, judge, territory), inserter_(tr, complex, judge, territory) {}

  Result run(std::vector<Sliver> slivers) {
    sort_along_curve(slivers);
    known_ = std::move(slivers);
    for (int pass = 0; pass < 2; ++pass) {
      move_all();
      insert_all();
    }
    move_all();
    for (const Sliver& s : known_)
      if (s.is_live()) (!s.is_pinched && is_foreign(s) ? result_.foreign : result_.hopeless).push_back(s);
    return std::move(result_);
  }

 private:
  /// Moves vertices of the slivers that are known, those made by moves included, a vertex only once for all that are known at the time.
  void move_all() {
    using Outcome = typename Vertex_mover_3<Tr, Criteria>::Outcome;
    for (; next_ < known_.size() && !is_cancelled(); ++next_) {
      prefetch_from(next_);
      for (int i = 0; i < 4 && is_to_be_removed(known_[next_]); ++i) {
        const Vertex_handle v = known_[next_].cell->vertex(i);
        if (v->in_dimension() != 3) continue;
        const auto at = tried_.find(&*v);
        if (at != tried_.end() && next_ < at->second) continue;
        const Outcome outcome = mover_.improve(v, wanted_);
        if (outcome != Outcome::moved) {
          tried_[&*v] = known_.size();
          if (outcome == Outcome::foreign) foreign_.insert(&*v);
          continue;
        }
        ++result_.moved;
        if (!mover_.is_cured()) mover_.for_made([this](Cell_handle c) { note(c); });
      }
    }
  }

  /// Neighbors among the slivers lie anywhere in memory.
  void prefetch_from(std::size_t k) const {
    constexpr std::size_t far = 6, near = 4, next = 2;
    if (k + far >= known_.size()) return;
    prefetch(known_[k + far].cell);
    if (known_[k + near].is_live())
      for (int i = 0; i < 4; ++i) prefetch(known_[k + near].cell->vertex(i));
    if (known_[k + next].is_live())
      for (int i = 0; i < 4; ++i) prefetch(known_[k + next].cell->vertex(i)->cell());
  }

  void insert_all() {
    for (; filled_ < known_.size() && result_.added < quota_ && !is_cancelled(); ++filled_) {
      const Sliver s = known_[filled_];
      if (!is_to_be_removed(s) || !inserter_.insert(s.cell, s.cosine, wanted_)) continue;
      ++result_.added;
      for (const Cell_handle c : inserter_.star()) note(c);
    }
  }

  bool is_cancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }

  static bool is_to_be_removed(const Sliver& s) { return s.is_live() && !s.is_pinched; }

  void note(Cell_handle c) { Sliver::add_if_below(c, wanted_, known_); }

  bool is_foreign(const Sliver& s) const {
    for (int i = 0; i < 4; ++i)
      if (foreign_.contains(&*s.cell->vertex(i))) return true;
    return false;
  }

  double wanted_;
  std::size_t quota_;
  const std::atomic<bool>* cancel_;
  Vertex_mover_3<Tr, Criteria> mover_;
  Sliver_inserter_3<Tr, Criteria> inserter_;
  std::vector<Sliver> known_;  ///< all that there were, gone or not
  std::size_t next_ = 0;       ///< of these, to be looked at for moves
  std::size_t filled_ = 0;     ///< of these, to be looked at for insertions
  // Asked, never walked through.
  std::unordered_map<const void*, std::size_t> tried_;  ///< vertices that stayed, and how many slivers were known
  std::unordered_set<const void*> foreign_;
  Result result_;
};

}  // namespace pgdr

#endif
