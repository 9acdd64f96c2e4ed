// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_LEAF_WORKLIST_3_H
#define PGDR_REFINEMENT_LEAF_WORKLIST_3_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <pgdr/conforming/feature_request.h>
#include <pgdr/conforming/fifo.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mesh/prefetch.h>
#include <pgdr/refinement/radius_queue.h>

namespace pgdr {

/// Work on its way to the leaf that contains `at`.
template <class Tr>
struct Leaf_parcel_3 {
  using Cell_handle = typename Tr::Cell_handle;

  enum class Kind : std::uint8_t {
    poor,    ///< `cell`, with its Steiner point at `at`
    errand,  ///< a feature with its split point at `at`
    retry,   ///< a tetrahedron that comes home from an errand
    coarse,  ///< no work: an element of radius `cell.radius` that is fine as it is
    refused, ///< no work: one that was given up
    fresh    ///< a tetrahedron to be looked at anew
  };
  Vec_3 at;
  Kind kind = Kind::poor;
  Cell_id_3<Cell_handle> cell{};
  std::unique_ptr<Feature_errand_3<Cell_handle>> errand;
};

template <class Tr>
class Leaf_session_3;

/// What one leaf still has to do.
template <class Tr>
class Leaf_worklist_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Cell_id = Cell_id_3<Cell_handle>;
  using Errand = Feature_errand_3<Cell_handle>;
  using Parcel = Leaf_parcel_3<Tr>;

  static constexpr std::uint16_t dead = 0xffff;  ///< the number, in `divide`, of what is not needed any more

  bool has_work() const {
    return has_active() || !errands_.empty() || !retries_.empty() || !queues_.empty() || !fresh_.empty();
  }
  bool empty() const { return !has_work() && deferred_.empty(); }
  std::size_t active() const {
    return steep_.size() + active_.size() + active_outside_.size() + retries_.size() + errands_.size() + queues_.size();
  }
  std::size_t deferred() const { return deferred_.size(); }
  std::size_t size() const { return active() + deferred(); }

  /// A facet near by is torn, and only a run of `settle` can mend it.
  bool is_torn() const { return torn_; }

  /// Upper bound of m, over all elements near the leaf that are not waiting to be refined: fine ones, and those that
  /// were refused.
  double coarsest() const { return std::max(coarsest_, largest_refused_); }
  void note_coarse(double radius) { coarsest_ = std::max(coarsest_, radius); }
  /// An element that was given up, with its Steiner point and its m as radius.
  void note_refused(const Vec_3& at, const Cell_id& id) {
    // A leaf that is never split keeps them: those that are gone make room when there are as many as were there the last time.
    if (refused_.size() >= 2 * refused_kept_ + 1024) {
      std::erase_if(refused_, [](const auto& r) { return !r.second.is_live(); });
      refused_kept_ = refused_.size();
    }
    refused_.emplace_back(at, id);
    largest_refused_ = std::max(largest_refused_, static_cast<double>(id.radius));
  }
  /// After a scan has measured the fine ones.
  void reset_coarsest(double radius) { coarsest_ = radius; }
  /// The largest radius that is deferred, as of the last `measure_deferred`.
  double measured_deferred() const { return largest_deferred_; }
  void measure_deferred() {
    float r = 0;
    for (const Cell_id& id : deferred_) r = std::max(r, id.radius);
    for (const Cell_id& id : outside_) r = std::max(r, id.radius);
    largest_deferred_ = static_cast<double>(r);
  }

  /// Calls `found` with some of the active tetrahedra, about `most`, spread evenly over the queues.
  template <class Found>
  void sample_active(std::size_t most, const Found& found) const {
    const std::size_t step = 1 + (active_.size() + active_outside_.size()) / most;
    for (const Radius_queue<Cell_id>* queue : {&active_, &active_outside_})
      queue->sample(step, [&](const Cell_id& id) {
        if (id.is_live()) found(id);
      });
  }

  std::vector<Parcel>& outgoing() { return outgoing_; }

  /// A vertex in or near the leaf, to start a walk from.
  Vertex_handle anchor() const { return anchor_; }
  void set_anchor(Vertex_handle v) { anchor_ = v; }

  void add_poor(const Cell_id& id, double target, bool is_steep = false) {
    if (is_steep) {
      steep_.push_back({id, ++steep_count_});
      std::push_heap(steep_.begin(), steep_.end());
    } else if (static_cast<double>(id.radius) > target) {
      active_.push(id);
    } else {
      deferred_.push_back(id);
    }
  }

  /// A tetrahedron outside the domain; one that is not active waits for smaller leaves.
  void add_outside(const Cell_id& id, bool is_active) {
    if (is_active)
      active_outside_.push(id);
    else
      outside_.push_back(id);
  }
  /// A tetrahedron that what is in its way was split for.
  void try_again(const Cell_id& id, bool is_outside) { (is_outside ? active_outside_ : active_).push(id); }

  void receive(Parcel&& parcel, double target, double outside_target) {
    using Kind = typename Parcel::Kind;
    switch (parcel.kind) {
      case Kind::poor:
        if (!parcel.cell.is_live()) break;
        if (parcel.cell.cell->subdomain() != 0)
          add_poor(parcel.cell, target);
        else
          add_outside(parcel.cell, static_cast<double>(parcel.cell.radius) > outside_target);
        break;
      case Kind::errand: errands_.push(std::move(parcel.errand)); break;
      case Kind::retry: retries_.push(std::move(parcel.errand)); break;
      case Kind::coarse: note_coarse(static_cast<double>(parcel.cell.radius)); break;
      case Kind::refused: note_refused(parcel.at, parcel.cell); break;
      case Kind::fresh: fresh_.push_back(parcel.cell); break;
    }
  }

  /// Deferred elements that are above the target become active.
  void activate(double target, double outside_target) {
    const auto sift = [](std::vector<Cell_id>& from, double above, Radius_queue<Cell_id>& to) {
      std::size_t kept = 0;
      for (const Cell_id& id : from) {
        if (!id.is_live()) continue;
        if (static_cast<double>(id.radius) > above)
          to.push(id);
        else
          from[kept++] = id;
      }
      from.resize(kept);
      if (kept == 0) from.shrink_to_fit();
    };
    sift(deferred_, target, active_);
    sift(outside_, outside_target, active_outside_);
  }

  /// What a child of this leaf starts from.
  void inherit(const Leaf_worklist_3& parent) {
    coarsest_ = parent.coarsest_;
    anchor_ = parent.anchor_;
  }

  /// Takes over what is stranded or unlabelled in another worklist; `all` its other features, too.
  void take_torn(Leaf_worklist_3& from, bool all) {
    queues_.take_all(from.stranded_);
    if (all) queues_.take_all(from.queues_);
    unlabelled_.insert(unlabelled_.end(), from.unlabelled_.begin(), from.unlabelled_.end());
    from.unlabelled_.clear();
    from.torn_ = false;
    torn_ = true;
    if (anchor_ == Vertex_handle()) anchor_ = from.anchor_;
  }

  /// Hands live active elements out: `number_of` tells for a tetrahedron, an errand or a request, and whether that is for a
  /// subsegment, the number of a part, from 1 on, 0 for what stays, or `dead` for what is not needed any more. `most`: tetrahedra for a part.
  /// \pre nothing is torn or fresh
  template <class Number_of>
  void divide(std::vector<Leaf_worklist_3>& parts, const Number_of& number_of, std::size_t most) {
    const auto hand_out = [&](const auto& queue_of, const auto&... more) {
      auto queue = std::exchange(queue_of(*this), {});
      while (!queue.empty()) {
        auto item = queue.pop();
        const std::uint16_t k = number_of(item, more...);
        if (k != dead) queue_of(k == 0 ? *this : parts[k - 1u]).push(std::move(item));
      }
    };
    // Where large ones stay, smaller ones around them are not handed out either: they would come first then, with all the large cavities that
    // `Radius_queue` is to spare (a15: 30 seconds instead of 22).
    std::vector<std::size_t> counts(parts.size(), 0);
    std::size_t full = 0;
    const auto hand_out_largest = [&](Radius_queue<Cell_id> Leaf_worklist_3::*queue) {
      for (bool stays = false; !stays && !(this->*queue).empty();) {
        Fifo<Cell_id> items = (this->*queue).pop_class(), kept;
        while (!items.empty() && full < parts.size()) {
          prefetch_from(items);
          Cell_id item = items.pop();
          const std::uint16_t k = number_of(item);
          if (k == dead) continue;
          const bool is_handed_out = k != 0 && counts[k - 1u] < most;
          if (is_handed_out)
            (parts[k - 1u].*queue).push(item);
          else
            kept.push(item);
          if (is_handed_out && ++counts[k - 1u] == most) ++full;
        }
        items.take_all(kept);
        stays = !items.empty();
        (this->*queue).push_class(std::move(items));
      }
    };
    hand_out_largest(&Leaf_worklist_3::active_);
    hand_out_largest(&Leaf_worklist_3::active_outside_);
    hand_out([](auto& list) -> auto& { return list.errands_; });
    hand_out([](auto& list) -> auto& { return list.retries_; }, true);
    hand_out([](auto& list) -> auto& { return list.queues_.subsegments; }, true);
    hand_out([](auto& list) -> auto& { return list.queues_.subfacets; }, false);
    for (Leaf_worklist_3& part : parts) part.anchor_ = anchor_;
  }

  /// Takes over all that another worklist has left. \pre it has no outgoing parcels
  void take_back(Leaf_worklist_3& part) {
    const auto append = [](auto& to, auto& from) {
      to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
      from = {};
    };
    for (const Steep& s : part.steep_) add_poor(s.id, 0, true);
    part.steep_.clear();
    active_.take_all(part.active_);
    active_outside_.take_all(part.active_outside_);
    append(deferred_, part.deferred_);
    append(outside_, part.outside_);
    errands_.take_all(part.errands_);
    retries_.take_all(part.retries_);
    queues_.take_all(part.queues_);
    stranded_.take_all(part.stranded_);
    append(fresh_, part.fresh_);
    append(unlabelled_, part.unlabelled_);
    append(refused_, part.refused_);
    coarsest_ = std::max(coarsest_, part.coarsest_);
    largest_refused_ = std::max(largest_refused_, part.largest_refused_);
    torn_ |= part.torn_;
  }

  void release_memory() {
    errands_.release_if_empty();
    retries_.release_if_empty();
    queues_.subsegments.release_if_empty();
    queues_.subfacets.release_if_empty();
    if (outgoing_.empty()) std::vector<Parcel>().swap(outgoing_);
  }

  /// What to look at next: first what is inside the domain. \pre one of them is active
  Cell_id pop_active() {
    if (has_steep()) {
      std::pop_heap(steep_.begin(), steep_.end());
      const Cell_id id = steep_.back().id;
      steep_.pop_back();
      return id;
    }
    Radius_queue<Cell_id>& queue = active_.empty() ? active_outside_ : active_;
    prefetch_from(queue.next());
    return queue.pop();
  }
  bool has_active() const { return has_steep() || !active_.empty() || !active_outside_.empty(); }
  /// The largest of the steep ones, if its radius is above this; else none.
  Cell_id pop_steep(double above) {
    while (has_steep() && (static_cast<double>(steep_.front().id.radius) > above || !steep_.front().id.is_live()))
      if (const Cell_id id = pop_active(); id.is_live()) return id;
    return {};
  }
  bool has_steep() const { return !steep_.empty(); }

 private:
  template <class, class, class>
  friend class Delaunay_leaf_refiner_3;
  friend class Leaf_session_3<Tr>;

  /// Neighbors in a queue lie anywhere in memory: asks for what is needed soon.
  static void prefetch_from(const Fifo<Cell_id>& queue) {
    constexpr std::size_t far = 16, near = 8;
    if (queue.size() <= far) return;
    prefetch(queue[far].cell);
    if (!queue[near].is_live()) return;
    for (int i = 0; i < 4; ++i) {
      prefetch(queue[near].cell->vertex(i));
      prefetch(queue[near].cell->neighbor(i));
    }
  }
  template <class Queue>
  static void prefetch_from(const Queue&) {}

  /// The largest first, then the oldest.
  struct Steep {
    Cell_id id;
    std::size_t number;
    bool operator<(const Steep& o) const { return id.radius != o.id.radius ? id.radius < o.id.radius : number > o.number; }
  };

  std::vector<Steep> steep_;  ///< a heap of those that are far larger than their shortest edge
  std::size_t steep_count_ = 0;
  Radius_queue<Cell_id> active_;
  Radius_queue<Cell_id> active_outside_;  ///< when nothing else is left: these yield to every feature
  std::vector<Cell_id> deferred_;
  std::vector<Cell_id> outside_;  ///< deferred tetrahedra outside the domain
  Fifo<std::unique_ptr<Errand>> errands_;
  Fifo<std::unique_ptr<Errand>> retries_;  ///< their clients are looked at again
  Feature_queues queues_;
  Feature_queues stranded_;
  std::vector<Cell_id> fresh_;
  std::vector<Cell_id> unlabelled_;
  std::vector<Parcel> outgoing_;
  Vertex_handle anchor_;
  double coarsest_ = 0;
  std::vector<std::pair<Vec_3, Cell_id>> refused_;
  std::size_t refused_kept_ = 0;
  double largest_refused_ = 0;
  double largest_deferred_ = 0;
  bool torn_ = false;
};

}  // namespace pgdr

#endif
