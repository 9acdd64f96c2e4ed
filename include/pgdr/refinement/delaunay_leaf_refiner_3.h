// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_DELAUNAY_LEAF_REFINER_3_H
#define PGDR_REFINEMENT_DELAUNAY_LEAF_REFINER_3_H

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <pgdr/acute/split_guard_3.h>
#include <pgdr/conforming/feature_refiner_3.h>
#include <pgdr/conforming/subdomains_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/refinement/box_scan_3.h>
#include <pgdr/refinement/cell_classifier_3.h>
#include <pgdr/refinement/divide_worklist_3.h>
#include <pgdr/refinement/inside_refiner_3.h>
#include <pgdr/refinement/leaf_refiner.h>
#include <pgdr/refinement/leaf_session_3.h>
#include <pgdr/refinement/leaf_worklist_3.h>
#include <pgdr/refinement/outside_cells_3.h>
#include <pgdr/refinement/outside_refiner_3.h>
#include <pgdr/refinement/point_placement.h>
#include <pgdr/refinement/quality_criteria_3.h>
#include <pgdr/refinement/room_maker_3.h>
#include <pgdr/refinement/steiner_point_3.h>

namespace pgdr {

/// Sequential Delaunay refinement of one leaf: splits poor tetrahedra at their circumcenters (Shewchuk, *Tetrahedral
/// mesh generation by Delaunay refinement*, 1998), or where else `Placement` says, until none is left. A model of
/// `LeafRefiner`.
///
/// A Steiner point that encroaches a subsegment or subfacet, or that would delete one, is not inserted; the feature
/// is split instead. A tetrahedron is given up only next to a small input angle, when every such split would make
/// an edge too short (`split_guard`). Outside the domain, tetrahedra are refined only as far as the zone
/// condition of the leaves needs it, and never at the expense of a feature.
template <class Tr, class Criteria, class Placement = Circumcenter_placement>
class Delaunay_leaf_refiner_3 {
  static_assert(PointPlacement<Placement>);

 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Features = Feature_refiner_3<Tr>;
  using Complex = Constraint_complex_3<Tr>;
  using Worklist = Leaf_worklist_3<Tr>;
  using Parcel = typename Worklist::Parcel;
  using Cell_id = typename Worklist::Cell_id;
  using Session = Leaf_session_3<Tr>;
  using Worker = Leaf_worker_3<Tr>;

  /// The active elements of a worklist, divided among territories.
  struct Division {
    std::vector<Worklist> parts;
    std::vector<Territory_id> territories;
  };

  Delaunay_leaf_refiner_3(Tr& tr, Complex& complex, const Acute_neighborhood_3& acute, const Criteria& criteria,
                          double min_edge_length, Placement placement = {})
      : tr_(tr), complex_(complex), acute_(acute), criteria_(criteria), min_edge_length_(min_edge_length),
        points_(tr, criteria, std::move(placement)), classifier_(tr, complex, criteria), room_(complex, acute, criteria, min_edge_length),
        inside_(tr, complex, acute, criteria, points_, room_, classifier_), outside_(tr, complex, criteria, room_, classifier_) {}

  // Its parts know each other.
  Delaunay_leaf_refiner_3(const Delaunay_leaf_refiner_3&) = delete;
  Delaunay_leaf_refiner_3& operator=(const Delaunay_leaf_refiner_3&) = delete;

  std::unique_ptr<Worker> make_worker() const {
    return std::make_unique<Worker>(tr_, complex_, acute_, min_edge_length_);
  }

  /// The convex hull of all that is refined.
  const Region_3& hull() const { return points_.hull().box(); }
  const Acute_neighborhood_3& acute() const { return acute_; }
  /// A vertex at a corner of the hull.
  Vertex_handle corner() const { return points_.hull().corner(); }

  /// A worklist with every poor tetrahedron of the domain, for a leaf that is everything. \pre no other thread works
  Worklist everything(Worker& w) {
    Worklist list;
    list.set_anchor(corner());
    Leaf_task task;
    task.target = std::numeric_limits<double>::infinity();
    Session s(tr_, w, task, list);
    for (auto c = tr_.finite_cells_begin(); c != tr_.finite_cells_end(); ++c) classifier_.classify(s, c);
    return list;
  }

  /// Adds the tetrahedra outside the domain. \pre no other thread works
  void add_outside(Worker& w, Worklist& list, double outside_target) {
    Leaf_task task;
    task.outside_target = outside_target;
    Session s(tr_, w, task, list);
    for (const Cell_handle c : outside_cells(tr_)) classifier_.classify(s, c);
  }

  Drain_result drain(Worker& w, const Leaf_task& task, Worklist& list) {
    Session s(tr_, w, task, list);
    Features& features = w.features;
    const std::size_t on_features = features.inserted();
    while (true) {
      const std::size_t done = s.result.inserted + features.inserted() - on_features;
      if (done >= task.quota || (task.cancel && task.cancel->load(std::memory_order_relaxed))) {
        s.result.stopped = true;
        break;
      }
      if (!features.is_idle()) {
        if (const Cell_id id = steep_before_feature(s); id.cell != Cell_handle())
          refine(s, id, {});
        else
          features.step();
        continue;
      }
      if (!list.errands_.empty()) {
        run_errand(s);
        continue;
      }
      if (task.features_only) break;
      if (!features.stranded().empty()) {
        if (task.territory.is_everything()) break;
        s.cede_unlabelled();
      }
      // Only now, with every facet whole, is it known again on which side of it a new tetrahedron is.
      mend_subdomains(features);
      if (!features.fresh_cells().empty()) {
        classifier_.take_fresh(s);
        continue;
      }
      if (done >= task.pause_after && !list.has_steep()) break;
      if (!task.territory.is_everything() && is_in_vain(s, done)) break;
      if (!list.retries_.empty()) {
        const auto errand = list.retries_.pop();
        if (errand->cell.is_live()) refine(s, errand->cell, {std::move(errand->refused), errand->guard.is_strict});
        continue;
      }
      if (!list.has_active()) break;
      const Cell_id id = list.pop_active();
      if (id.is_live()) refine(s, id, {});
    }
    s.result.inserted += features.inserted() - on_features;
    return s.result;
  }

  void receive(Worklist& list, Parcel&& parcel, double target, double outside_target) const {
    list.receive(std::move(parcel), target, outside_target);
  }
  void activate(Worklist& list, double target, double outside_target) const { list.activate(target, outside_target); }

  /// Divides the active elements of a worklist among territories that can be worked on at once, each by a `drain` with its
  /// position here plus 1 as territory; none if that is not worth while, or a facet is torn. What belongs to no
  /// territory stays; another `round` has other borders. \pre nobody else is at work
  Division divide(Worker& w, Worklist& list, const Leaf_task& task, std::size_t round, unsigned halvings) {
    constexpr std::array<double, 3> shares{0.5, 0.4, 0.6};
    constexpr std::size_t samples_for_part = 256;
    // A task that pauses after a thousand points leaves the others as they were.
    const std::size_t most_for_part = halvings > 0 ? 4096 : std::numeric_limits<std::size_t>::max();
    Division division;
    if (list.is_torn()) return division;
    {
      Session s(tr_, w, task, list);
      classifier_.take_fresh(s);
    }
    const std::size_t n = territory_count(list.active(), halvings);
    if (n == 0) return division;
    const std::size_t most_samples = samples_for_part * n;
    std::vector<Territory_map::Item> sample;
    list.sample_active(most_samples, [&](const Cell_id& id) { sample.push_back({points_.roughly(id.cell), box_of(id.cell)}); });
    const Territories_3<Tr> territories(tr_, {sample.empty() ? sample_vertices(tr_, most_samples) : std::move(sample), n, shares[round % shares.size()]});
    division.parts.resize(n);
    for (std::size_t k = 0; k < n; ++k) division.territories.push_back(territories[k]);
    list.divide(division.parts, Territory_of_3<Tr>(complex_, territories), most_for_part);
    return division;
  }

  /// Gives back what is left of them.
  void unite(Worklist& list, std::vector<Worklist>& parts, double target, double outside_target) const {
    for (Worklist& part : parts) {
      for (Parcel& parcel : part.outgoing_) list.receive(std::move(parcel), target, outside_target);
      part.outgoing_.clear();
      list.take_back(part);
    }
  }

  /// Empties a worklist into `sink(Parcel)`. \pre it has no outgoing parcels and no piece is stranded
  template <class Sink>
  void dispatch(Worker& w, Worklist& list, const Sink& sink) const {
    using Kind = typename Parcel::Kind;
    {
      const Session s(tr_, w, Leaf_task{}, list);
      w.features.hand_on_all();
    }
    for (Parcel& p : list.outgoing_) sink(std::move(p));
    list.outgoing_.clear();
    while (!list.errands_.empty()) {
      auto e = list.errands_.pop();
      const Vec_3 at = w.features.split_point(*e);
      sink(Parcel{at, Kind::errand, {}, std::move(e)});
    }
    while (!list.retries_.empty()) {
      auto e = list.retries_.pop();
      const Vec_3 home = e->home;
      sink(Parcel{home, Kind::retry, {}, std::move(e)});
    }
    const auto send = [&](const Cell_id& id) {
      if (id.is_live()) sink(Parcel{points_.roughly(id.cell), Kind::poor, id, nullptr});
    };
    while (list.has_steep()) send(list.pop_active());
    while (!list.active_.empty()) send(list.active_.pop());
    while (!list.active_outside_.empty()) send(list.active_outside_.pop());
    for (const Cell_id& id : list.deferred_) send(id);
    for (const Cell_id& id : list.outside_) send(id);
    for (const auto& [at, id] : list.refused_)
      if (id.is_live()) sink(Parcel{at, Kind::refused, id, nullptr});
    list.deferred_ = {};
    list.outside_ = {};
    list.refused_ = {};
    list.release_memory();
  }

  /// Splits, with nobody else at work, the missing pieces that no leaf could split, mends the subdomains, and leaves
  /// what follows from it in `list`, for `dispatch`. `closing` also recovers what is missing elsewhere and drops all
  /// other requests, so that a run that has to stop leaves every facet whole. \pre `list` is none of `torn`
  template <class Lists>
  Drain_result settle(Worker& w, Lists&& torn, bool closing, double outside_target, Worklist& list,
                      const std::atomic<bool>* cancel = nullptr) {
    for (Worklist* t : torn) list.take_torn(*t, closing);
    Leaf_task task;
    task.target = std::numeric_limits<double>::infinity();
    task.outside_target = outside_target;
    task.cancel = cancel;
    Drain_result result;
    {
      Session s(tr_, w, task, list);
      Features& features = w.features;
      const std::size_t before = features.inserted();
      if (!closing) features.recover_missing();
      if (closing || features.is_cancelled()) features.close(10000);
      features.queues().subsegments.release_if_empty();
      mend_subdomains(features);
      features.set_torn(false);
      s.collects_coarse = true;
      classifier_.take_fresh(s);
      result.inserted = features.inserted() - before;
    }
    list.torn_ = false;
    return result;
  }

  /// Puts a point on a piece of a feature, as `Feature_refiner_3::put_on_piece`, and refines what is missing or poor after that. Returns how
  /// many points were inserted. \pre as `split_piece`
  template <class Good>
  std::size_t put_on_piece(Worker& w, const Piece_id& piece, bool is_subsegment, const Vec_3& at, bool may_tear, const Good& is_good) {
    if (is_subsegment ? !complex_.is_live_subsegment(piece) : !complex_.is_live_subfacet(piece)) return 0;
    Worklist list;
    const Leaf_task task;
    bool is_put;
    {
      const Session s(tr_, w, task, list);
      is_put = w.features.put_on_piece(piece.slot, is_subsegment, at, may_tear, is_good);
    }
    return is_put ? 1 + drain(w, task, list).inserted : 0;
  }

  /// Looks at a point on a piece of a feature within a territory, as `Feature_refiner_3::look_at_piece`. \pre nothing is missing, and nobody
  /// changes the mesh
  template <class Look>
  bool look_at_piece(Worker& w, const Territory_id& territory, const Piece_id& piece, bool is_subsegment, const Vec_3& at, bool may_tear, const Look& look) {
    Worklist list;
    Leaf_task task;
    task.territory = territory;
    task.region = territory.region;
    const Session s(tr_, w, task, list);
    return w.features.look_at_piece(piece.slot, is_subsegment, at, may_tear, look);
  }

  /// Splits one piece of a feature, as far as the guard allows, and refines what is missing or poor after that. \pre no other thread
  /// works, and nothing is missing or poor
  Drain_result split_piece(Worker& w, const Piece_id& piece, bool is_subsegment, const Split_guard& guard, const std::atomic<bool>* cancel) {
    Worklist list;
    Leaf_task task;
    task.cancel = cancel;
    {
      const Session s(tr_, w, task, list);
      Features& features = w.features;
      if (is_subsegment ? complex_.is_live_subsegment(piece) : complex_.is_live_subfacet(piece))
        is_subsegment ? features.split_subsegment(piece.slot, Split_reason::encroached, guard)
                      : features.split_subfacet(piece.slot, Split_reason::encroached, guard);
      features.close(10000);
    }
    Drain_result result = drain(w, task, list);
    if (result.stopped) {
      Worklist left;
      settle(w, std::array{&list}, true, task.outside_target, left, cancel);
    }
    return result;
  }

  /// What the deferred elements ask for, from a sample of them; a point each at least.
  Work_estimate estimate(const Worklist& list) const {
    constexpr std::size_t samples = 1024;
    Work_estimate e;
    const std::size_t n = list.deferred_.size(), step = (n + samples - 1) / samples;
    for (std::size_t k = 0; k < n; k += step) {
      const Cell_id& id = list.deferred_[k];
      if (!id.is_live()) continue;
      const Tetrahedron_ball ball = tetrahedron_ball(tetrahedron_points(id.cell));
      const double size = criteria_.size_at(ball.center);
      e.insertions += static_cast<double>(std::min(step, n - k)) * std::max(1.0, expected_vertices(ball.volume, size));
      e.largest_size = std::max(e.largest_size, size);
    }
    return e;
  }

  /// What the elements of a worklist that are outside the domain ask for, to be refined to the target.
  double estimate_outside(const Worklist& list, double target) const {
    double insertions = 0;
    for (const Cell_id& id : list.outside_)
      if (static_cast<double>(id.radius) > target && id.is_live())
        insertions += expected_vertices(tetrahedron_ball(tetrahedron_points(id.cell)).volume, target);
    return insertions;
  }

  /// \pre no other thread works
  Volumes volumes() const {
    const Vec_3 edges = hull().upper - hull().lower;
    const double whole = edges.x * edges.y * edges.z, outside = outside_volume(tr_, whole);
    return {whole - outside, outside};
  }

  /// Whether every tetrahedron that meets the box, but is not inside the hole, has m < bound. Reads only.
  Scan_result scan(const Region_3& box, const Region_3& hole, double bound, const Worklist& list) const {
    return scan_box(tr_, box, hole, bound, points_.hull().nearest(box), list.anchor());
  }

  /// Whether every tetrahedron whose circumball meets the box has a circumradius < bound. Reads only.
  bool has_smaller_circumballs(const Region_3& box, double bound, const Worklist& list) const {
    return scan_circumballs(tr_, box, bound, points_.hull().nearest(box), list.anchor());
  }

 private:
  static Region_3 box_of(Cell_handle c) {
    const Tetrahedron_points corners = tetrahedron_points(c);
    Region_3 box{corners[0], corners[0]};
    for (const Vec_3& p : corners)
      for (int k = 0; k < 3; ++k) {
        box.lower[k] = std::min(box.lower[k], p[k]);
        box.upper[k] = std::max(box.upper[k], p[k]);
      }
    return box;
  }

  /// Whether a territory hands on so much of its work, compared with the points that it inserts, that the rest is better done in another
  /// one: each try searches a cavity (table in docs/performance.md).
  static bool is_in_vain(Session& s, std::size_t inserted) {
    constexpr std::size_t patience = 256, tries_for_a_point = 2;
    return s.list().outgoing_.size() + s.features().outgoing().size() > patience + tries_for_a_point * inserted;
  }

  void run_errand(Session& s) const {
    auto errand = s.list().errands_.pop();
    if (!s.features().run(errand)) return;
    const Vec_3 home = errand->home;
    s.list().outgoing_.push_back({home, Parcel::Kind::retry, {}, std::move(errand)});
  }

  /// A steep tetrahedron that is much larger than the piece of a feature that is next, or none: so that the mesh is graded as
  /// vertices get denser along the features, and points have small cavities.
  Cell_id steep_before_feature(Session& s) {
    constexpr std::size_t at_once = 64;  // new tetrahedra to be measured
    constexpr double much_larger = 4;  // than the ball of the piece
    if (s.task().features_only || !s.task().territory.is_everything()) return {};
    const bool takes_fresh = s.features().fresh_cells().size() > at_once;
    if (!takes_fresh && !s.list().has_steep()) return {};
    const double radius = s.features().next_radius();
    if (radius == std::numeric_limits<double>::infinity()) return {};
    if (takes_fresh) classifier_.take_fresh(s);
    return s.list().pop_steep(much_larger * radius);
  }

  /// Whether the cavity will hardly be within the territory: there are vertices around the Steiner point at about this distance.
  static bool is_near_border(const Session& s, const Steiner_attempt_3<Tr>& t) {
    if (s.task().territory.is_everything()) return false;
    const double r = std::sqrt(t.ball.squared_radius);
    const Vec_3 all{r, r, r};
    return !s.task().region.contains(t.at - all) || !s.task().region.contains(t.at + all);
  }

  /// Inserts the Steiner point of a tetrahedron, splits what is in the way, gives it up, or sends it to where its point is.
  void refine(Session& s, const Cell_id& id, Tried tried) {
    const bool is_skipped = id.cell->subdomain() == 0 && s.task().outside_target == std::numeric_limits<double>::infinity();
    if (is_skipped) return;
    auto t = points_.attempt(id, std::move(tried));
    s.features().has_met_minimum();  // what was refused for others' sake depends on what this thread did before
    s.star().clear();
    if (!s.task().region.contains(t.at) || is_near_border(s, t)) return room_.hand_on(s, t);
    if (t.is_outside()) return outside_.refine(s, t);
    if (!s.task().territory.is_everything() && is_steep(t.ball)) return room_.hand_on(s, t);
    inside_.refine(s, t);
  }

  void mend_subdomains(Features& features) const {
    if (features.unlabelled_cells().empty()) return;
    Subdomain_labeler_3<Tr>(tr_, complex_).mend(features.unlabelled_cells());
    features.note_mended();
  }

  Tr& tr_;
  Complex& complex_;
  const Acute_neighborhood_3& acute_;
  const Criteria& criteria_;
  double min_edge_length_;
  Steiner_points_3<Tr, Criteria, Placement> points_;
  Cell_classifier_3<Tr, Criteria> classifier_;
  Room_maker_3<Tr, Criteria> room_;
  Inside_refiner_3<Tr, Criteria, Placement> inside_;
  Outside_refiner_3<Tr, Criteria> outside_;
};

}  // namespace pgdr

#endif
