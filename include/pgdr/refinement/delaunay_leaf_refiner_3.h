// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_DELAUNAY_LEAF_REFINER_3_H
#define PGDR_REFINEMENT_DELAUNAY_LEAF_REFINER_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <pgdr/acute/split_guard_3.h>
#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/conforming/feature_refiner_3.h>
#include <pgdr/conforming/flat_cell_3.h>
#include <pgdr/conforming/subdomains_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/mesh/triangle_ball.h>
#include <pgdr/refinement/box_scan_3.h>
#include <pgdr/refinement/divide_worklist_3.h>
#include <pgdr/refinement/enclosing_ball.h>
#include <pgdr/refinement/hull_box_3.h>
#include <pgdr/refinement/leaf_refiner.h>
#include <pgdr/refinement/leaf_worklist_3.h>
#include <pgdr/refinement/measured_star_3.h>
#include <pgdr/refinement/obstacles_3.h>
#include <pgdr/refinement/outside_cells_3.h>
#include <pgdr/refinement/point_placement.h>
#include <pgdr/refinement/quality_criteria_3.h>
#include <pgdr/refinement/separating_subfacet_3.h>

namespace pgdr {

// Length: the engine in one piece; what stands on its own is in obstacles_3.h, hull_box_3.h, box_scan_3.h, leaf_worklist_3.h.

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
  using Point = typename Tr::Point;
  using Features = Feature_refiner_3<Tr>;
  using Complex = Constraint_complex_3<Tr>;
  using Worklist = Leaf_worklist_3<Tr>;
  using Parcel = typename Worklist::Parcel;
  using Cell_id = typename Worklist::Cell_id;
  using Errand = typename Worklist::Errand;

  /// The active elements of a worklist, divided among territories.
  struct Division {
    std::vector<Worklist> parts;
    std::vector<Region_3> regions;
  };

  /// The scratch memory of one thread.
  class Worker {
   public:
    Worker(Tr& tr, Complex& complex, const Acute_neighborhood_3& acute, double min_edge_length)
        : features_(tr, complex, acute, min_edge_length) {
      features_.keep_fresh_cells(true);
    }

   private:
    friend Delaunay_leaf_refiner_3;
    Features features_;
    Zone_guard_3<Tr> guard_;
    Leaf_task task_;
    Obstacles_3<Tr> obstacles_;
    Measured_star_3<Tr> star_;    ///< of the point whose cavity is found, where several are compared
    std::vector<Cell_id> ceded_;  ///< unlabelled tetrahedra that are not own any more
    std::size_t stranded_ = 0;    ///< pieces, as of the last time that some were ceded
  };

  Delaunay_leaf_refiner_3(Tr& tr, Complex& complex, const Acute_neighborhood_3& acute, const Criteria& criteria,
                          double min_edge_length, Placement placement = {})
      : tr_(tr), complex_(complex), acute_(acute), criteria_(criteria), min_edge_length_(min_edge_length),
        placement_(std::move(placement)), hull_(tr) {}

  std::unique_ptr<Worker> make_worker() const {
    return std::make_unique<Worker>(tr_, complex_, acute_, min_edge_length_);
  }

  /// The convex hull of all that is refined.
  const Region_3& hull() const { return hull_.box(); }
  const Acute_neighborhood_3& acute() const { return acute_; }
  /// A vertex at a corner of the hull.
  Vertex_handle corner() const { return hull_.corner(); }

  /// A worklist with every poor tetrahedron of the domain, for a leaf that is everything. \pre no other thread works
  Worklist everything(Worker& w) {
    Worklist list;
    open(w, Leaf_task{}, list);
    list.set_anchor(hull_.corner());
    w.task_.target = std::numeric_limits<double>::infinity();
    for (auto c = tr_.finite_cells_begin(); c != tr_.finite_cells_end(); ++c) classify(w, c, list);
    close(w, list);
    return list;
  }

  /// Adds the tetrahedra outside the domain. \pre no other thread works
  void add_outside(Worker& w, Worklist& list, double outside_target) {
    Leaf_task task;
    task.outside_target = outside_target;
    open(w, task, list);
    for (const Cell_handle c : outside_cells(tr_)) classify(w, c, list);
    close(w, list);
  }

  Drain_result drain(Worker& w, const Leaf_task& task, Worklist& list) {
    open(w, task, list);
    Features& features = w.features_;
    const std::size_t on_features = features.inserted();
    Drain_result result;
    while (true) {
      if (result.inserted + features.inserted() - on_features >= task.quota ||
          (task.cancel && task.cancel->load(std::memory_order_relaxed))) {
        result.stopped = true;
        break;
      }
      if (!features.is_idle()) {
        if (const Cell_id id = steep_before_feature(w, list); id.cell != Cell_handle())
          refine(w, id, {}, list, result);
        else
          features.step();
        continue;
      }
      if (!list.errands_.empty()) {
        run_errand(w, list);
        continue;
      }
      if (task.features_only) break;
      if (!features.stranded().empty()) {
        if (task.territory == 0) break;
        cede_unlabelled(w);
      }
      // Only now, with every facet whole, is it known again on which side of it a new tetrahedron is.
      mend_subdomains(features);
      if (!features.fresh_cells().empty()) {
        take_fresh_cells(w, list);
        continue;
      }
      if (result.inserted + features.inserted() - on_features >= task.pause_after && !list.has_steep()) break;
      if (!list.retries_.empty()) {
        const auto errand = list.retries_.pop();
        if (errand->cell.is_live()) refine(w, errand->cell, {std::move(errand->refused), errand->guard.is_strict}, list, result);
        continue;
      }
      if (!list.has_active()) break;
      const Cell_id id = list.pop_active();
      if (id.is_live()) refine(w, id, {}, list, result);
    }
    result.inserted += features.inserted() - on_features;
    close(w, list);
    return result;
  }

  void receive(Worklist& list, Parcel&& parcel, double target, double outside_target) const {
    using Kind = typename Parcel::Kind;
    switch (parcel.kind) {
      case Kind::poor:
        if (!parcel.cell.is_live()) break;
        if (parcel.cell.cell->subdomain() != 0)
          list.add_poor(parcel.cell, target);
        else if (static_cast<double>(parcel.cell.radius) > outside_target)
          list.active_outside_.push(parcel.cell);
        else
          list.outside_.push_back(parcel.cell);
        break;
      case Kind::errand: list.errands_.push(std::move(parcel.errand)); break;
      case Kind::retry: list.retries_.push(std::move(parcel.errand)); break;
      case Kind::coarse: list.note_coarse(static_cast<double>(parcel.cell.radius)); break;
      case Kind::refused: list.note_refused(parcel.at, parcel.cell); break;
      case Kind::fresh: list.fresh_.push_back(parcel.cell); break;
    }
  }

  /// Divides the active elements of a worklist among territories that can be worked on at once, each by a `drain` with its
  /// position here plus 1 as territory; none if that is not worth while, or a facet is torn. What belongs to no
  /// territory stays; another `round` has other borders. \pre nobody else is at work
  Division divide(Worker& w, Worklist& list, const Leaf_task& task, std::size_t round, unsigned halvings) {
    constexpr std::array<double, 3> shares{0.5, 0.4, 0.6};
    constexpr std::size_t most_samples = 16384;
    Division division;
    if (list.is_torn()) return division;
    open(w, task, list);
    take_fresh_cells(w, list);
    close(w, list);
    const std::size_t n = territory_count(list.active(), halvings);
    if (n == 0) return division;
    std::vector<Territory_map::Item> sample;
    list.sample_active(most_samples, [&](const Cell_id& id) { sample.push_back({rough_steiner_point(id.cell), box_of(id.cell)}); });
    const Territory_map map(sample.empty() ? sample_vertices(tr_, most_samples) : std::move(sample), n, shares[round % shares.size()]);
    mark_territories(tr_, map);
    division.parts.resize(n);
    for (std::size_t k = 0; k < n; ++k) division.regions.push_back(map.region(k));
    list.divide(division.parts, Territory_of_3<Tr>(complex_));
    return division;
  }

  /// Gives back what is left of them.
  void unite(Worklist& list, std::vector<Worklist>& parts, double target, double outside_target) const {
    for (Worklist& part : parts) {
      for (Parcel& parcel : part.outgoing_) receive(list, std::move(parcel), target, outside_target);
      part.outgoing_.clear();
      list.take_back(part);
    }
  }

  /// Deferred elements that are above the target become active.
  void activate(Worklist& list, double target, double outside_target) const {
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
    sift(list.deferred_, target, list.active_);
    sift(list.outside_, outside_target, list.active_outside_);
  }

  /// Empties a worklist into `sink(Parcel)`. \pre it has no outgoing parcels and no piece is stranded
  template <class Sink>
  void dispatch(Worker& w, Worklist& list, const Sink& sink) const {
    using Kind = typename Parcel::Kind;
    open(w, Leaf_task{}, list);
    w.features_.hand_on_all();
    close(w, list);
    for (Parcel& p : list.outgoing_) sink(std::move(p));
    list.outgoing_.clear();
    while (!list.errands_.empty()) {
      auto e = list.errands_.pop();
      const Vec_3 at = w.features_.split_point(*e);
      sink(Parcel{at, Kind::errand, {}, std::move(e)});
    }
    while (!list.retries_.empty()) {
      auto e = list.retries_.pop();
      const Vec_3 home = e->home;
      sink(Parcel{home, Kind::retry, {}, std::move(e)});
    }
    const auto send = [&](const Cell_id& id) {
      if (id.is_live()) sink(Parcel{rough_steiner_point(id.cell), Kind::poor, id, nullptr});
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
  /// other requests, so that a run that has to stop leaves every facet whole.
  template <class Lists>
  Drain_result settle(Worker& w, Lists&& torn, bool closing, double outside_target, Worklist& list,
                      const std::atomic<bool>* cancel = nullptr) {
    for (Worklist* t : torn) list.take_torn(*t, closing);
    Leaf_task task;
    task.target = std::numeric_limits<double>::infinity();
    task.outside_target = outside_target;
    task.cancel = cancel;
    open(w, task, list);
    Features& features = w.features_;
    const std::size_t before = features.inserted();
    if (!closing) features.recover_missing();
    if (closing || features.is_cancelled()) features.close(10000);
    features.queues().subsegments.release_if_empty();
    mend_subdomains(features);
    features.set_torn(false);
    collect_coarse_ = true;
    take_fresh_cells(w, list);
    collect_coarse_ = false;
    Drain_result result;
    result.inserted = features.inserted() - before;
    close(w, list);
    list.torn_ = false;
    return result;
  }

  /// Puts a point on a piece of a feature at a share of its length, or of the way from circumcenter to centroid, as
  /// `Feature_refiner_3::put_on_piece`, and refines what is missing or poor after that. Returns how many points were inserted. \pre as `split_piece`
  template <class Good>
  std::size_t put_on_piece(Worker& w, const Piece_id& piece, bool is_subsegment, double share, const Good& is_good) {
    if (is_subsegment ? !complex_.is_live_subsegment(piece) : !complex_.is_live_subfacet(piece)) return 0;
    Worklist list;
    const Leaf_task task;
    open(w, task, list);
    Features& features = w.features_;
    const Vec_3 m = is_subsegment ? features.point_on_subsegment(piece.slot, share) : features.point_on_subfacet(piece.slot, share);
    const bool is_put = features.put_on_piece(piece.slot, is_subsegment, m, is_good);
    close(w, list);
    return is_put ? 1 + drain(w, task, list).inserted : 0;
  }

  /// Splits one piece of a feature, as far as the guard allows, and refines what is missing or poor after that. \pre no other thread
  /// works, and nothing is missing or poor
  Drain_result split_piece(Worker& w, const Piece_id& piece, bool is_subsegment, const Split_guard& guard, const std::atomic<bool>* cancel) {
    Worklist list;
    Leaf_task task;
    task.cancel = cancel;
    open(w, task, list);
    Features& features = w.features_;
    if (is_subsegment ? complex_.is_live_subsegment(piece) : complex_.is_live_subfacet(piece))
      is_subsegment ? features.split_subsegment(piece.slot, Split_reason::encroached, guard)
                    : features.split_subfacet(piece.slot, Split_reason::encroached, guard);
    features.close(10000);
    close(w, list);
    Drain_result result = drain(w, task, list);
    if (result.stopped) settle(w, std::array{&list}, true, task.outside_target, list, cancel);
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
    const Vec_3 edges = hull_.box().upper - hull_.box().lower;
    const double whole = edges.x * edges.y * edges.z, outside = outside_volume(tr_, whole);
    return {whole - outside, outside};
  }

  /// Whether every tetrahedron that meets the box, but is not inside the hole, has m < bound. Reads only.
  Scan_result scan(const Region_3& box, const Region_3& hole, double bound, const Worklist& list) const {
    return scan_box(tr_, box, hole, bound, hull_.nearest(box), list.anchor());
  }

  /// Whether every tetrahedron whose circumball meets the box has a circumradius < bound. Reads only.
  bool has_smaller_circumballs(const Region_3& box, double bound, const Worklist& list) const {
    return scan_circumballs(tr_, box, bound, hull_.nearest(box), list.anchor());
  }

 private:
  static constexpr float upwards = 1.000001f;
  static constexpr std::size_t most_looks = 64;  ///< for a subsegment in the way, while a cavity is searched

  /// Lends the queues of a leaf to a thread, and takes them back.
  void open(Worker& w, const Leaf_task& task, Worklist& list) const {
    w.task_ = task;
    w.stranded_ = 0;
    Features& f = w.features_;
    f.set_region(task.region, task.near);
    f.set_territory({task.territory});
    f.set_cancel(task.cancel);
    std::swap(f.queues(), list.queues_);
    std::swap(f.stranded(), list.stranded_);
    std::swap(f.fresh_cells(), list.fresh_);
    std::swap(f.unlabelled_cells(), list.unlabelled_);
    // Beside a torn facet of another leaf, labels are as unknown as beside one of its own.
    f.set_torn(list.torn_ || task.features_only);
    if (task.tag) {
      w.guard_.open(tr_, task.reach, task.tag);
      f.cavity().set_guard(&w.guard_);
    }
  }

  void close(Worker& w, Worklist& list) const {
    Features& f = w.features_;
    for (auto& [at, errand] : f.outgoing())
      list.outgoing_.push_back({at, Parcel::Kind::errand, {}, std::move(errand)});
    f.outgoing().clear();
    // Torn beyond this task: what is stranded, and what could not be mended because a neighbour is torn.
    list.torn_ = !f.stranded().empty() || !f.unlabelled_cells().empty() || !w.ceded_.empty();
    std::swap(f.queues(), list.queues_);
    std::swap(f.stranded(), list.stranded_);
    std::swap(f.fresh_cells(), list.fresh_);
    std::swap(f.unlabelled_cells(), list.unlabelled_);
    list.unlabelled_.insert(list.unlabelled_.end(), w.ceded_.begin(), w.ceded_.end());
    w.ceded_.clear();
    if (w.task_.tag) {
      f.cavity().set_guard(nullptr);
      w.guard_.close();
    }
    list.release_memory();
  }

  void run_errand(Worker& w, Worklist& list) const {
    auto errand = list.errands_.pop();
    if (!w.features_.run(errand)) return;
    const Vec_3 home = errand->home;
    list.outgoing_.push_back({home, Parcel::Kind::retry, {}, std::move(errand)});
  }

  /// Puts a tetrahedron on the worklist if it is poor; flat ones on a facet become requests to split that facet.
  void classify(Worker& w, Cell_handle c, Worklist& list) {
    if (c->subdomain() == 0) return classify_outside(w, c, list);
    if (c->has_subfacet() && is_handed_over(w, c, list)) return classify_outside(w, c, list);
    const Tetrahedron_ball ball = tetrahedron_ball(position(c->vertex(0)), position(c->vertex(1)),
                                                   position(c->vertex(2)), position(c->vertex(3)));
    classify(w, c, ball, criteria_.is_poor(ball, c->subdomain()), list);
  }

  /// The same for a tetrahedron of the domain that was measured.
  void classify(Worker& w, Cell_handle c, const Tetrahedron_ball& ball, bool is_poor, Worklist& list) {
    const double r = std::sqrt(ball.squared_radius);
    c->ball().set(ball.center, r, ball_error);
    const float radius = upwards * static_cast<float>(r);
    c->set_state(is_poor ? Cell_state::poor : Cell_state::good);
    if (is_poor)
      list.add_poor({c, c->generation(), radius}, w.task_.target, is_steep(ball));
    else
      note_coarse(c, static_cast<double>(radius), list);
  }

  void classify_outside(Worker& w, Cell_handle c, Worklist& list) {
    const double target = w.task_.outside_target;
    if (target == std::numeric_limits<double>::infinity() || tr_.is_infinite(c)) return;
    const Tetrahedron_points p = tetrahedron_points(c);
    const Tetrahedron_ball ball = tetrahedron_ball(p);
    const double r = std::sqrt(ball.squared_radius);
    c->ball().set(ball.center, r, ball_error);
    const double m = r <= target ? r : enclosing_radius(p);
    const Cell_id id{c, c->generation(), upwards * static_cast<float>(m)};
    if (m > target)
      list.active_outside_.push(id);
    else if (!w.task_.last)
      list.outside_.push_back(id);  // smaller leaves may come
    else
      note_coarse(c, m * static_cast<double>(upwards), list);
  }

  void note_coarse(Cell_handle c, double radius, Worklist& list) const {
    list.note_coarse(radius);
    if (collect_coarse_)
      list.outgoing_.push_back({position(c->vertex(0)), Parcel::Kind::coarse,
                                {c, c->generation(), upwards * static_cast<float>(radius)}, nullptr});
  }

  /// Where vertices are dense along a segment and the mesh around them is not graded yet, thousands of tetrahedra join them to the same
  /// vertex far away, with Steiner points next to each other, and the cavity of each holds all the others. One point removes
  /// them: the largest comes first, and no task looks at them while others are at work, who could not insert it. Inside of a body by
  /// quality alone, ratios of some tens are what it begins with, and order does not matter. Seconds of a bracket with steps of a
  /// 40,000th of its size, and of a ball of 14,000 facets: 12: 8, 34; 32: 9, 38; 64: 9, 12; 100: 9, 18; 256: 17, 15; never: no end, 16.
  static bool is_steep(const Tetrahedron_ball& ball) {
    constexpr double steepness = 64;
    return ball.squared_radius > steepness * steepness * ball.squared_shortest;
  }

  /// A steep tetrahedron that is much larger than the piece of a feature that is next, or none: so that the mesh is graded as
  /// vertices get denser along the features, and points have small cavities.
  Cell_id steep_before_feature(Worker& w, Worklist& list) {
    constexpr std::size_t at_once = 64;  // new tetrahedra to be measured
    constexpr double much_larger = 4;  // than the ball of the piece
    Features& features = w.features_;
    if (w.task_.features_only || w.task_.territory != 0) return {};
    const bool takes_fresh = features.fresh_cells().size() > at_once;
    if (!takes_fresh && !list.has_steep()) return {};
    const double radius = features.next_radius();
    if (radius == std::numeric_limits<double>::infinity()) return {};
    if (takes_fresh) take_fresh_cells(w, list);
    return list.pop_steep(much_larger * radius);
  }

  /// What came of the attempts before to make room for a tetrahedron.
  struct Tried {
    std::vector<Piece_id> refused;  ///< what is in the way, and may not be split for its sake
    bool is_strict = true;          ///< with the floor everywhere
  };

  /// A tetrahedron that is looked at, and its Steiner point.
  struct Attempt {
    Cell_id id;
    Tetrahedron_points corners;
    Tetrahedron_ball ball;
    Vec_3 at;
    Tried tried;

    Point point() const { return Point(at.x, at.y, at.z); }
    bool is_outside() const { return id.cell->subdomain() == 0; }
  };

  Attempt attempt(const Cell_id& id, Tried tried) const {
    Attempt t{id, tetrahedron_points(id.cell), {}, {}, std::move(tried)};
    t.ball = tetrahedron_ball(t.corners);
    t.at = steiner_point(t.is_outside(), t.ball, t.corners);
    return t;
  }

  void give_up(Worker& w, const Attempt& t, Worklist& list, Drain_result& result) const {
    const float m = upwards * static_cast<float>(enclosing_radius(t.corners));
    list.note_refused(t.at, {t.id.cell, t.id.generation, m});
    ++result.refused;
    const bool met_minimum = w.features_.has_met_minimum();
    if (t.is_outside()) return;
    const bool limited = is_limited(t, met_minimum);
    t.id.cell->set_state(limited ? Cell_state::limited : Cell_state::exempt);
    result.limited += limited;
  }

  /// Whether it is the minimum edge length that a tetrahedron is given up for, and no small angle: because that was noticed, or, since of
  /// an errand only the refusal comes back, because it is as small as one next to such pieces (docs/theory.md, section 11).
  bool is_limited(const Attempt& t, bool met_minimum) const {
    if (!met_minimum && t.ball.squared_radius >= 4 * min_edge_length_ * min_edge_length_) return false;
    return !acute_.contains(t.at, 4 * std::sqrt(t.ball.squared_radius));
  }

  /// To whom the Steiner point belongs.
  static void hand_on(const Attempt& t, Worklist& list) {
    list.outgoing_.push_back({t.at, Parcel::Kind::poor, t.id, nullptr});
  }

  /// Whether the cavity will hardly be within the territory: there are vertices around the Steiner point at about this distance.
  static bool is_near_border(const Worker& w, const Attempt& t) {
    if (w.task_.territory == 0) return false;
    const double r = std::sqrt(t.ball.squared_radius);
    const Vec_3 all{r, r, r};
    return !w.task_.region.contains(t.at - all) || !w.task_.region.contains(t.at + all);
  }

  /// Inserts the Steiner point of a tetrahedron, or splits what is in the way.
  void refine(Worker& w, const Cell_id& id, Tried tried, Worklist& list, Drain_result& result) {
    const bool is_skipped = id.cell->subdomain() == 0 && w.task_.outside_target == std::numeric_limits<double>::infinity();
    if (is_skipped) return;
    Attempt t = attempt(id, std::move(tried));
    w.features_.has_met_minimum();  // what was refused for others' sake depends on what this thread did before
    if (!w.task_.region.contains(t.at) || is_near_border(w, t)) return hand_on(t, list);
    if (t.is_outside()) {
      w.star_.clear();
      return refine_outside(w, t, list, result);
    }
    if (w.task_.territory != 0 && is_steep(t.ball)) return hand_on(t, list);
    const bool is_too_large = criteria_.is_over_size(t.ball, t.id.cell->subdomain());
    if (!is_too_large && is_hopeless(t.id.cell, t.ball, t.corners, criteria_.radius_edge_ratio(), acute_.narrow()))
      return give_up(w, t, list, result);
    Trial trial = try_point(w, t, list, result);
    if (trial == Trial::no_room && criteria_.is_over_ratio(t.ball)) {
      // What may not be split can be far away, where large tetrahedra next to an angle have to stay. No vertex is closer to this
      // point than the shortest edge is long, either, and less is in its way.
      t.at = hull_.pull_in(Type_1_placement()(poor_tetrahedron(t.ball, t.corners)), t.corners);
      trial = w.task_.region.contains(t.at) ? try_point(w, t, list, result) : Trial::no_room;
    } else if (trial == Trial::clear) {
      if constexpr (ChoosingPlacement<Placement>) choose_point(w, t);
    }
    if (trial == Trial::clear && !keeps_minimum(w, t)) {
      // No point of the ball is farther from all vertices than its center.
      t.at = hull_.pull_in(t.ball.center, t.corners);
      trial = w.task_.region.contains(t.at) ? try_point(w, t, list, result) : Trial::no_room;
      if (trial == Trial::clear && !keeps_minimum(w, t)) trial = Trial::no_room;
    }
    if (trial == Trial::clear) insert(w, t, list, result);
    if (trial == Trial::no_room) give_up(w, t, list, result);
  }

  /// Whether the Steiner point, whose cavity is found, comes no closer to a vertex than the minimum edge length; abandons the cavity if not.
  bool keeps_minimum(Worker& w, const Attempt& t) const {
    const Split_spacing_3<Tr>& spacing = w.features_.spacing();
    Cavity_3<Tr>& cavity = w.features_.cavity();
    const double distance = least_distance(t);
    if (!spacing.is_below_minimum(distance * distance) || !spacing.is_below_minimum(cavity.squared_insertion_radius(t.at))) return true;
    cavity.abandon();
    return false;
  }

  /// A bound of the distance from the Steiner point to all vertices: the circumball is empty.
  static double least_distance(const Attempt& t) { return std::sqrt(t.ball.squared_radius) - length(t.at - t.ball.center); }

  enum class Trial : std::uint8_t {
    clear,   ///< the Steiner point's cavity is found, and may be filled
    done,    ///< nothing is left to do for now
    no_room  ///< none of what is in the way may be split
  };

  /// Looks for the cavity of a Steiner point in the domain, and makes room if something is in the way.
  Trial try_point(Worker& w, Attempt& t, Worklist& list, Drain_result& result) {
    Cavity_3<Tr>& cavity = w.features_.cavity();
    w.star_.clear();
    const Cell_handle c = t.id.cell;
    const auto hand_on_or_give_up = [&] {
      cavity.is_foreign() ? hand_on(t, list) : give_up(w, t, list, result);
      return Trial::done;
    };
    // What lies behind a facet need not be searched at all. The way to the point is within its cavity, so that where nothing of a
    // feature is there it need not be walked.
    std::optional<Separation> between;
    const auto is_behind = [&] {
      if (!between) between = first_subfacet_towards(tr_, cavity.territory(), c, t.point());
      return between->is_foreign || between->subfacet != Complex::none;
    };
    // Cavities can be large, and what is in the way is close, mostly, so that most of the search can be spared.
    std::size_t looks = 0;
    std::uint32_t in_the_way = Complex::none;
    const auto is_clear = [&](Cell_handle d) {
      ++looks;
      if (!d->has_subfacet() && d->subsegment_edges() == 0) return true;
      if (is_behind()) return false;
      in_the_way = subsegment_in_the_way(d, t.point(), looks <= most_looks);
      return in_the_way == Complex::none;
    };
    bool is_found = cavity.find(t.point(), c, is_clear);
    if (!is_found && is_behind()) {
      if (between->is_foreign) {
        hand_on(t, list);
        return Trial::done;
      }
      w.obstacles_.set_subfacet(complex_, between->subfacet);
      return make_room(w, t, list, result) ? Trial::done : Trial::no_room;
    }
    if (!is_found && in_the_way != Complex::none) {
      w.obstacles_.set_subsegment(complex_, in_the_way);
      if (make_room(w, t, list, result)) return Trial::done;
      if (is_steep(t.ball)) return Trial::no_room;
      is_found = cavity.find(t.point(), c);
    }
    if (!is_found) {
      if (cavity.is_foreign()) return hand_on_or_give_up();
      // Rounding can put the center of a flat tetrahedron outside of its own ball.
      t.at = hull_.pull_in(exact_tetrahedron_ball(t.corners).center, t.corners);
      if (!w.task_.region.contains(t.at) || !cavity.find(t.point(), c)) return hand_on_or_give_up();
    }
    w.features_.features().gather(complex_, cavity);
    if (!w.obstacles_.collect(complex_, w.features_.features(), t.point())) return Trial::clear;
    cavity.abandon();
    return make_room(w, t, list, result) ? Trial::done : Trial::no_room;
  }

  /// Where the first choice leaves an angle that is too small: takes the first other point that leaves none, if there is one. Its cavity
  /// is the one that is found then.
  /// \pre that of the first choice is found, and nothing is in its way
  void choose_point(Worker& w, Attempt& t) const {
    const Poor_tetrahedron poor = poor_tetrahedron(t.ball, t.corners);
    const double enough = placement_.enough(poor);
    if (enough >= 1) return;
    Cavity_3<Tr>& cavity = w.features_.cavity();
    if (w.star_.measure(cavity, t.at, criteria_, enough)) return;
    cavity.abandon();
    Point_choice choice;
    placement_.alternatives(poor, choice);
    for (const Vec_3& q : choice) {
      if (!w.task_.region.contains(q) || !hull_.box().contains_closed(q) || w.star_.is_as_bad(q, criteria_, enough)) continue;
      const Point at(q.x, q.y, q.z);
      if (!cavity.find(at, t.id.cell)) continue;
      w.features_.features().gather(complex_, cavity);
      if (!w.obstacles_.collect(complex_, w.features_.features(), at) && w.star_.measure(cavity, q, criteria_, enough)) {
        t.at = q;
        return;
      }
      cavity.abandon();
    }
    cavity.find(t.point(), t.id.cell);
    w.features_.features().gather(complex_, cavity);
    w.star_.clear();
  }

  void refine_outside(Worker& w, Attempt& t, Worklist& list, Drain_result& result) {
    switch (find_outside(w, t)) {
      case Obstruction::none: insert(w, t, list, result); break;
      case Obstruction::splits_anyway:
        if (!make_room(w, t, list, result)) give_up(w, t, list, result);
        break;
      case Obstruction::stays: give_up(w, t, list, result); break;
      case Obstruction::foreign: hand_on(t, list); break;
    }
  }

  enum class Obstruction : std::uint8_t { none, splits_anyway, stays, foreign };

  /// Looks for the cavity of a point outside the domain, and leaves it marked if there is no obstruction.
  Obstruction find_outside(Worker& w, const Attempt& t) const {
    Cavity_3<Tr>& cavity = w.features_.cavity();
    const Point p = t.point();
    // A point outside has a large cavity, more often than not with a feature in the way: better to know at the first of its cells.
    std::optional<typename Tr::Facet> subfacet;
    std::uint32_t subsegment = Complex::none;
    const auto is_clear = [&](Cell_handle d) {
      subfacet = encroached_subfacet_of(d, p);
      if (!subfacet) subsegment = subsegment_in_the_way(d, p);
      return !subfacet && subsegment == Complex::none;
    };
    if (!cavity.find(p, t.id.cell, is_clear)) {
      if (cavity.is_foreign()) return Obstruction::foreign;
      if (subfacet && is_split_anyway(*subfacet))
        w.obstacles_.set_subfacet(complex_, subfacet->first->subfacet(subfacet->second));
      else if (subsegment != Complex::none && is_split_anyway(subsegment))
        w.obstacles_.set_subsegment(complex_, subsegment);
      else
        return Obstruction::stays;
      return Obstruction::splits_anyway;
    }
    w.features_.features().gather(complex_, cavity);
    const bool blocked = w.obstacles_.collect(complex_, w.features_.features(), p);
    if (!blocked && !is_crowded(w, t.at)) return Obstruction::none;
    cavity.abandon();
    return blocked && w.obstacles_.keep_subsegments([this](std::uint32_t s) { return is_split_anyway(s); })
               ? Obstruction::splits_anyway
               : Obstruction::stays;
  }

  /// Inserts the Steiner point. \pre its cavity is found
  void insert(Worker& w, const Attempt& t, Worklist& list, Drain_result& result) {
    Cavity_3<Tr>& cavity = w.features_.cavity();
    const double radius = std::max(least_distance(t), inherited_radius(t.id.cell, t.ball, t.corners));
    const Vertex_handle v = cavity.commit(t.point());
    v->set_feature(3, Tr::Vertex::none);
    v->set_insertion_radius(radius);
    list.set_anchor(v);
    ++result.inserted;
    for (std::size_t k = 0; k < cavity.star().size(); ++k) classify_new(w, k, list);
  }

  /// The k-th tetrahedron around a new Steiner point.
  void classify_new(Worker& w, std::size_t k, Worklist& list) {
    const Cell_handle c = w.features_.cavity().star()[k];
    if (w.star_.is_empty() || c->subdomain() == 0 || c->has_subfacet()) return classify(w, c, list);
    classify(w, c, w.star_[k].ball, w.star_[k].is_poor, list);
  }

  Vec_3 steiner_point(bool outside, const Tetrahedron_ball& ball, const Tetrahedron_points& corners) const {
    if (outside) return hull_.attract(ball);
    return hull_.pull_in(placement_(poor_tetrahedron(ball, corners)), corners);
  }

  Poor_tetrahedron poor_tetrahedron(const Tetrahedron_ball& ball, const Tetrahedron_points& corners) const {
    return {corners, ball, criteria_.is_over_ratio(ball), criteria_.radius_edge_ratio()};
  }

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

  /// Good enough to find the leaf that will look at it; that one computes the point itself.
  Vec_3 rough_steiner_point(Cell_handle c) const {
    const Certified_ball& b = c->ball();
    if (b.is_known()) {
      const Vec_3 p{static_cast<double>(b.center[0]), static_cast<double>(b.center[1]),
                    static_cast<double>(b.center[2])};
      if (hull_.box().contains_closed(p)) return p;
    }
    const Tetrahedron_points corners = tetrahedron_points(c);
    return steiner_point(c->subdomain() == 0, tetrahedron_ball(corners), corners);
  }

  /// Whether p would delete an edge of c, which is in conflict with it: all cells around the edge are.
  bool deletes_edge(Cell_handle c, int i, int j, const Point& p) const {
    auto around = tr_.incident_cells(c, i, j);
    const auto done = around;
    while (++around != done)
      if (!tr_.in_conflict(around, p)) return false;
    return true;
  }

  /// A subsegment on the cell, in conflict with p, that p encroaches or, if that is asked for, would delete; or none.
  std::uint32_t subsegment_in_the_way(Cell_handle c, const Point& p, bool or_deletes = true) const {
    if (c->subsegment_edges() == 0) return Complex::none;
    const Vec_3 at = to_vec(p);
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        if (!(c->subsegment_edges() & edge_bit(i, j))) continue;
        // Where p does not see it at more than a right angle it does not encroach it; but for rounding, for which the cavity
        // is looked through again in the end.
        const bool may_encroach = dot(position(c->vertex(i)) - at, position(c->vertex(j)) - at) <= 0;
        const auto is_deleted = [&] { return or_deletes && deletes_edge(c, i, j, p); };
        if (!may_encroach && !is_deleted()) continue;
        const std::uint32_t s = complex_.find_subsegment(c->vertex(i), c->vertex(j));
        if (s != Complex::none && (!may_encroach || is_encroached(complex_.subsegment(s), p) || is_deleted())) return s;
      }
    return Complex::none;
  }

  /// A subfacet on the cell in whose equatorial ball p lies.
  std::optional<typename Tr::Facet> encroached_subfacet_of(Cell_handle c, const Point& p) const {
    if (c->has_subfacet())
      for (int i = 0; i < 4; ++i)
        if (c->subfacet(i) != Complex::none && is_encroached(complex_.subfacet(c->subfacet(i)), p))
          return typename Tr::Facet(c, i);
    return std::nullopt;
  }

  /// Whether the sizing field asks for smaller subfacets than this one, seen from outside: then a point outside may
  /// split it, which the points inside have yet to do.
  bool is_split_anyway(const typename Tr::Facet& f) const {
    const Cell_handle inside = f.first->neighbor(f.second);
    if (inside->subdomain() == 0 ||
        !criteria_.is_over_size(tetrahedron_ball(tetrahedron_points(inside)), inside->subdomain()))
      return false;
    const auto& t = complex_.subfacet(f.first->subfacet(f.second));
    const Vec_3 a = position(t.vertices[0]), b = position(t.vertices[1]), c = position(t.vertices[2]);
    const Vec_3 center = triangle_circumcenter(a, b, c);
    return length(center - a) > criteria_.size_at(center);
  }

  /// The same of a subsegment.
  bool is_split_anyway(std::uint32_t subsegment) const {
    const auto& s = complex_.subsegment(subsegment);
    const Vec_3 a = position(s.vertices[0]), b = position(s.vertices[1]);
    return 0.5 * length(b - a) > criteria_.size_at(0.5 * (a + b));
  }

  /// Whether a point outside the domain would come closer to a vertex than the refinement out there needs.
  bool is_crowded(Worker& w, const Vec_3& p) const {
    const double least = 0.3 * w.task_.outside_target;
    return w.features_.cavity().squared_insertion_radius(p) < least * least;
  }

  /// The bound of size that a tetrahedron is over, if it is; outside, where the octree wants it smaller, its radius, unless the ratio does as well.
  std::optional<double> size_over(const Attempt& t) const {
    if (t.is_outside()) return criteria_.is_over_ratio(t.ball) ? std::nullopt : std::optional(std::sqrt(t.ball.squared_radius));
    const std::int32_t subdomain = t.id.cell->subdomain();
    return criteria_.is_over_size(t.ball, subdomain) ? std::optional(criteria_.size_bound(t.ball, subdomain)) : std::nullopt;
  }

  /// Splits an obstacle for a tetrahedron's sake: with the floor of its guard everywhere if one lets itself be split like that, else,
  /// away from small angles, without. False if no obstacle is left.
  bool make_room(Worker& w, Attempt& t, Worklist& list, Drain_result& result) const {
    Split_guard guard = split_guard(t.id.cell, t.ball, t.corners, size_over(t), acute_);
    if (t.is_outside()) guard.size = 0;
    guard.is_strict = t.tried.is_strict;
    if (splits_obstacle(w, t, guard, list, result)) return true;
    if (!t.tried.is_strict || guard.is_near(acute_)) return false;
    t.tried.is_strict = guard.is_strict = false;
    t.tried.refused.clear();
    return splits_obstacle(w, t, guard, list, result);
  }

  /// Splits the first obstacle that lets itself be split, but for those that are known not to; the tetrahedron has another try
  /// if it is still there. An obstacle whose split point lies elsewhere takes the tetrahedron along. Some are
  /// given up at the first refusal (`Split_guard::gives_up_at_once`): there is no room then, whatever becomes of the others. Trying
  /// the others all the same pays where an edge is so short that hardly anything may be split for its sake. False if no obstacle is left.
  bool splits_obstacle(Worker& w, Attempt& t, const Split_guard& guard, Worklist& list, Drain_result& result) const {
    Features& features = w.features_;
    const bool outside = t.is_outside(), segments = w.obstacles_.are_subsegments();
    for (const Piece_id& piece : w.obstacles_.to_split()) {
      const bool is_known = std::ranges::find(t.tried.refused, piece) != t.tried.refused.end();
      const Split_guard of_piece = guard.for_piece(segments ? complex_.subsegment_radius(piece.slot) : complex_.subfacet_radius(piece.slot));
      const Split_outcome outcome = is_known   ? Split_outcome::refused
                                    : segments ? features.split_subsegment(piece.slot, Split_reason::encroached, of_piece)
                                               : features.split_subfacet(piece.slot, Split_reason::encroached, of_piece);
      if (outcome == Split_outcome::inserted) {
        if (t.id.is_live()) (outside ? list.active_outside_ : list.active_).push(t.id);
        return true;
      }
      if (outcome == Split_outcome::elsewhere) {
        features.outgoing().emplace_back(features.elsewhere().at, errand_for(t, of_piece, piece, features.elsewhere()));
        return true;
      }
      if (guard.gives_up_at_once()) {
        give_up(w, t, list, result);
        return true;
      }
      if (!is_known) t.tried.refused.push_back(piece);
      if (is_steep(t.ball)) break;
    }
    return false;
  }

  /// To split what is elsewhere, for the sake of a tetrahedron that `obstacle` is in the way of.
  static std::unique_ptr<Errand> errand_for(Attempt& t, const Split_guard& guard, const Piece_id& obstacle, const Split_elsewhere& split) {
    auto errand = std::make_unique<Errand>();
    errand->piece = split.piece;
    errand->is_subsegment = split.is_subsegment;
    errand->guard = guard;
    errand->client = Errand::Client::tetrahedron;
    errand->cell = t.id;
    errand->home = t.at;
    errand->obstacle = obstacle;
    errand->refused = std::move(t.tried.refused);
    return errand;
  }

  /// Where a facet cannot be mended within the territory, gives away the vertices of the tetrahedra made since it was torn:
  /// nobody touches these then, and the territory goes on around them.
  void cede_unlabelled(Worker& w) const {
    Features& f = w.features_;
    if (f.stranded().size() == std::exchange(w.stranded_, f.stranded().size())) return;
    for (const Cell_id& id : f.unlabelled_cells())
      if (id.is_live())
        for (int i = 0; i < 4; ++i)
          if (f.cavity().territory().leads_on(id.cell->vertex(i))) id.cell->vertex(i)->set_territory(0);
    w.ceded_.insert(w.ceded_.end(), f.unlabelled_cells().begin(), f.unlabelled_cells().end());
    f.unlabelled_cells().clear();
    f.note_mended();
  }

  /// A tetrahedron of another territory is looked at when that is at work.
  static void hand_on_fresh(const Cell_id& id, Worklist& list) {
    list.outgoing_.push_back({position(id.cell->vertex(0)), Parcel::Kind::fresh, id, nullptr});
  }

  void take_fresh_cells(Worker& w, Worklist& list) {
    for (const Cell_id& id : w.features_.fresh_cells())
      if (id.is_live()) {
        if (w.features_.cavity().territory().owns(id.cell))
          classify(w, id.cell, list);
        else
          hand_on_fresh(id, list);
      }
    w.features_.fresh_cells().clear();
  }

  void mend_subdomains(Features& features) const {
    if (features.unlabelled_cells().empty()) return;
    Subdomain_labeler_3<Tr>(tr_, complex_).mend(features.unlabelled_cells());
    features.note_mended();
  }

  /// Gives a flat tetrahedron to the outside if that is what lies beyond its facet; else a point on the facet has to
  /// remove it.
  bool is_handed_over(Worker& w, Cell_handle c, Worklist& list) const {
    std::vector<Cell_handle> flat{c};
    while (!flat.empty()) {
      const Cell_handle d = flat.back();
      flat.pop_back();
      const std::uint32_t t = subfacet_of_flat_cell(complex_, d);
      if (t == Complex::none) continue;
      if (!hand_to_outside(complex_, d)) {
        // In a bent facet any four vertices may be off one plane by what they are apart, and another point makes other such four.
        if (!complex_.is_bent(complex_.subfacet(t).facet)) w.features_.request_subfacet(t, Split_reason::flat);
        continue;
      }
      for (int i = 0; i < 4; ++i) {
        const Cell_handle n = d->neighbor(i);
        if (d->subfacet(i) == Complex::none || n->subdomain() == 0) continue;
        // What changes with it are its neighbors, too.
        if (w.features_.cavity().territory().owns(n) && w.features_.zone().leads_on(n))
          flat.push_back(n);
        else
          hand_on_fresh({n, n->generation(), 0}, list);
      }
    }
    return c->subdomain() == 0;
  }

  Tr& tr_;
  Complex& complex_;
  const Acute_neighborhood_3& acute_;
  const Criteria& criteria_;
  double min_edge_length_;
  Placement placement_;
  Hull_box_3<Tr> hull_;
  bool collect_coarse_ = false;
};

}  // namespace pgdr

#endif
