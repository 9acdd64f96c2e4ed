// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_FEATURE_REFINER_3_H
#define PGDR_CONFORMING_FEATURE_REFINER_3_H

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/acute/protected_balls_3.h>
#include <pgdr/acute/split_spacing_3.h>
#include <pgdr/conforming/cavity_features_3.h>
#include <pgdr/conforming/cavity_search_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/encroached_features_3.h>
#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/conforming/facet_star_3.h>
#include <pgdr/conforming/feature_request.h>
#include <pgdr/conforming/images_3.h>
#include <pgdr/conforming/presence_3.h>
#include <pgdr/conforming/sheet_repair_3.h>
#include <pgdr/conforming/sheet_walk_3.h>
#include <pgdr/conforming/split_points_3.h>
#include <pgdr/conforming/torn_features_3.h>
#include <pgdr/domain/region_3.h>
#include <pgdr/mesh/cavity_3.h>

namespace pgdr {

// Length: splits, images and errands call each other; images and their wedges are to become part of a room for small angles.

/// Splits subsegments and subfacets until none is missing and none encroached: the one place that puts points on
/// features. Subsegments come first; a facet's point yields to the subsegments that it encroaches, a segment's
/// point yields to nothing; what a point deletes of another feature is missing from then on and queued.
///
/// Next to small input angles a piece that is merely encroached is not split if that would make an edge shorter
/// than its `Split_guard` allows; nothing is ever split below the minimum edge length.
///
/// One object serves one thread. It inserts only points of its *region*; what has to be split elsewhere is handed
/// out as errands. Where the split of a missing piece lies elsewhere the piece is *stranded*: it waits until nobody
/// else is at work, since nothing is known of what the triangulation shows in its place.
template <class Tr>
class Feature_refiner_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Cell_handle = typename Tr::Cell_handle;
  using Point = typename Tr::Point;

  using Pool = typename Complex::Pool;
  using Cell_id = Cell_id_3<Cell_handle>;
  using Errand = Feature_errand_3<Cell_handle>;

  Feature_refiner_3(Tr& tr, Complex& complex, const Acute_neighborhood_3& acute, double min_edge_length)
      : tr_(tr), complex_(complex), acute_(acute), split_points_(complex, acute), spacing_(acute, min_edge_length),
        cavity_(tr), search_(tr, complex, cavity_), images_(complex, acute) {}

  /// The cavity that this refiner works with, shared with whoever inserts volume points on the same thread.
  Cavity_3<Tr>& cavity() { return cavity_; }
  Cavity_features_3<Tr>& features() { return features_; }
  Complex& complex() { return complex_; }
  const Acute_neighborhood_3& acute() const { return acute_; }

  Pool& pool() { return pool_; }

  void request_subfacet(std::uint32_t t, Split_reason reason) {
    queues_.subfacets.push({complex_.subfacet_id(t), reason});
  }
  /// Queues a piece that v encroaches.
  void note_encroached_subsegment(std::uint32_t s, Vertex_handle v) {
    const Feature_id on{1, complex_.subsegment(s).segment};
    request(true, Feature_request::encroached(complex_.subsegment_id(s), spacing_.guard(on, split_points_.of_subsegment(s), v)));
  }
  void note_encroached_subfacet(std::uint32_t t, Vertex_handle v) {
    const Feature_id on{2, complex_.subfacet(t).facet};
    const Vec_3 m = split_points_.of_subfacet(t, Split_reason::encroached);
    request(false, Feature_request::encroached(complex_.subfacet_id(t), spacing_.guard(on, m, v)));
  }
  /// Queues the subfacet of c opposite to its i-th vertex if one of its two opposite vertices encroaches it. From both sides the same.
  void request_if_encroached(Cell_handle c, int i) {
    const std::uint32_t slot = c->subfacet(i);
    Vertex_handle by{};
    for (const Vertex_handle v : {c->vertex(i), tr_.mirror_vertex(c, i)})
      if (!tr_.is_infinite(v) && encroaches(complex_, complex_.subfacet(slot), v) && (by == Vertex_handle() || v->point() < by->point())) by = v;
    if (by != Vertex_handle()) note_encroached_subfacet(slot, by);
  }
  void request(bool is_subsegment, const Feature_request& r) {
    queues_.push(is_subsegment, r);
  }

  Images_3<Tr>& images() { return images_; }

  /// Where points may be inserted, and where the vertices of a missing piece must be: all of space to begin with.
  void set_region(const Region_3& region, const Region_3& near) {
    region_ = region;
    search_.set_zone(near);
    last_way_ = {};
  }
  const Zone_reach_3<Tr>& zone() const { return search_.zone(); }
  /// What may be changed, beside other tasks: everything to begin with. Requests must be for own pieces. A split that
  /// would change more, or look farther, is `elsewhere`.
  void set_territory(const Territory_3<Tr>& territory) { cavity_.set_territory(territory); }
  /// Set from any thread when nothing further is wanted; may be null. Nothing goes on for long then.
  void set_cancel(const std::atomic<bool>* cancel) { cancel_ = cancel; }
  bool is_cancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }
  Feature_queues& queues() { return queues_; }
  bool has_subsegments() const { return !queues_.subsegments.empty(); }
  bool is_idle() const { return queues_.empty(); }
  std::size_t pending() const { return queues_.size(); }
  std::size_t inserted() const { return inserted_; }

  /// Errands for other leaves, with the split point. The caller empties it.
  std::vector<std::pair<Vec_3, std::unique_ptr<Errand>>>& outgoing() { return outgoing_; }
  /// Missing pieces that cannot be split in this region. The caller empties it.
  Feature_queues& stranded() { return stranded_; }
  const Split_elsewhere& elsewhere() const { return elsewhere_; }
  /// Whether a split was refused for the minimum edge length since this was asked last.
  bool has_met_minimum() { return std::exchange(met_minimum_, false); }
  const Split_spacing_3<Tr>& spacing() const { return spacing_; }

  /// Radius of the piece that `step` would split, 0 if it is gone; infinite if it is missing, or anything is torn, so that nothing else
  /// may come first. \pre not idle
  double next_radius() const {
    const bool segment = has_subsegments();
    const Feature_request& r = queues_.next(segment);
    if (torn_ || !unlabelled_cells_.empty() || r.reason == Split_reason::missing) return std::numeric_limits<double>::infinity();
    if (segment ? !complex_.is_live_subsegment(r.piece) : !complex_.is_live_subfacet(r.piece)) return 0;
    return segment ? complex_.subsegment_radius(r.piece.slot) : complex_.subfacet_radius(r.piece.slot);
  }

  /// Puts the images of the domain's own vertices, and points where segments cross each other. A vertex's insertion radius is for that its shortest segment.
  void mirror_corners() {
    const auto& domain = complex_.domain();
    std::vector<double> radius(domain.vertices.size(), std::numeric_limits<double>::infinity());
    std::vector<Vertex_handle> vertex(domain.vertices.size());
    const auto for_each_end = [&](const auto& call) {
      for (std::uint32_t s = 0; s < complex_.subsegment_slots(); ++s)
        if (complex_.subsegment(s).alive())
          for (const Vertex_handle v : complex_.subsegment(s).vertices) call(s, v);
    };
    for_each_end([&](std::uint32_t s, Vertex_handle v) {
      vertex[v->index()] = v;
      radius[v->index()] = std::min(radius[v->index()], 2 * complex_.subsegment_radius(s));
    });
    for_each_end([&](std::uint32_t s, Vertex_handle v) { images_.add_of_segment(v, complex_.subsegment(s).segment, radius[v->index()]); });
    for (Index f = 0; f < domain.facets.size(); ++f)
      for (const Index v : domain.facets[f].vertices)
        if (vertex[v] != Vertex_handle()) images_.add_of_corner(vertex[v], f, radius[v]);
    images_.add_crossings();
    put_images();
  }

  /// Handles one request, subsegments before subfacets. \pre not idle.
  void step() { handle(false); }

  /// Recovers what is missing and forgets all other requests, so that a run that has to stop leaves every facet
  /// whole; gives up after `limit` requests, and where somebody waits for it after a second.
  void close(std::size_t limit) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::seconds(1);
    while (!is_idle() && limit-- > 0 && !(is_cancelled() && Clock::now() > end)) handle(true);
  }

  /// Splits a subsegment.
  Split_outcome split_subsegment(std::uint32_t slot, Split_reason reason, const Split_guard& guard) {
    return split_subsegment_at(slot, split_points_.of_subsegment(slot), reason, guard, always);
  }

  /// Puts a point on a piece at m where that deletes no piece but those that it replaces, or, if it `may_tear`, where it encroaches none in a protected ball,
  /// and `is_good(cavity, at)`. What it encroaches stays so.
  template <class Good>
  bool put_on_piece(std::uint32_t slot, bool is_subsegment, const Vec_3& m, bool may_tear, const Good& is_good) {
    const Split_outcome outcome = split_flat(slot, is_subsegment, m, may_tear, is_good);
    close(most_images);
    return outcome == Split_outcome::inserted;
  }

  /// Looks at a point instead: changes nothing, and calls `look(cavity, at)` where `put_on_piece` asks whether it is good. False if that cannot be
  /// told within the territory.
  template <class Look>
  bool look_at_piece(std::uint32_t slot, bool is_subsegment, const Vec_3& m, bool may_tear, const Look& look) {
    is_looking_ = true;
    const Split_outcome outcome = split_flat(slot, is_subsegment, m, may_tear, [&](const Cavity_3<Tr>& cavity, const Vec_3& at) { return look(cavity, at), false; });
    is_looking_ = false;
    return outcome != Split_outcome::elsewhere;
  }

  /// Splits a subfacet at its circumcenter, or the subsegment that this point encroaches or lies beyond.
  Split_outcome split_subfacet(std::uint32_t slot, Split_reason reason, const Split_guard& guard) {
    at_work_ = complex_.subfacet_id(slot);
    Split_outcome outcome = split_subfacet_at(slot, split_points_.of_subfacet(slot, reason), reason, guard, always);
    if (reason == Split_reason::missing && outcome == Split_outcome::refused) {
      // In a bent facet, the circumcenter of a flat one may be taken already. One that is missing has to be split all the same.
      const auto [at, subsegment] = split_points_.on_longest_edge(slot);
      outcome = subsegment != Complex::none ? split_subsegment(subsegment, reason, guard) : split_subfacet_at(slot, at, reason, guard, always);
    }
    at_work_ = {};
    return outcome;
  }

  /// Tetrahedra made since the last call, some of them gone again. The caller empties it.
  std::vector<Cell_id>& fresh_cells() { return fresh_cells_; }
  /// Whether `fresh_cells` is kept; off until there are subdomains.
  void keep_fresh_cells(bool on) { keep_fresh_ = on; }

  /// Tetrahedra made where a facet was torn, or moved, whose subdomain is therefore unknown. The caller empties it.
  std::vector<Cell_id>& unlabelled_cells() { return unlabelled_cells_; }

  /// Queues a piece that the triangulation lacks.
  void note_missing_subfacet(std::uint32_t t) {
    complex_.subfacet(t).present = false;
    torn_ = true;
    request_subfacet(t, Split_reason::missing);
  }
  void note_missing_subsegment(std::uint32_t s) {
    complex_.subsegment(s).present = false;
    queues_.subsegments.push({complex_.subsegment_id(s), Split_reason::missing});
  }
  /// Called when every piece is present (again).
  void note_mended() { torn_ = false; }
  void set_torn(bool torn) { torn_ = torn; }

  /// Where an errand's split point is; for a piece that is gone, anywhere.
  Vec_3 split_point(const Errand& e) const {
    if (e.is_image()) return e.home;
    if (e.is_subsegment)
      return complex_.is_live_subsegment(e.piece) ? split_points_.of_subsegment(e.piece.slot) : e.home;
    return complex_.is_live_subfacet(e.piece) ? split_points_.of_subfacet(e.piece.slot, e.reason) : e.home;
  }

  /// Turns every queued request into an errand; missing pieces become stranded.
  void hand_on_all() {
    while (!is_idle()) {
      const bool segment = has_subsegments();
      const Feature_request r = queues_.pop(segment);
      if (segment ? !complex_.is_live_subsegment(r.piece) : !complex_.is_live_subfacet(r.piece)) continue;
      elsewhere_ = {segment ? split_points_.of_subsegment(r.piece.slot) : split_points_.of_subfacet(r.piece.slot, r.reason),
                    r.piece, segment};
      hand_on(r, segment);
    }
  }

  /// Recovers what is missing, subsegments before subfacets, while other requests wait.
  void recover_missing() {
    Feature_queues others;
    while (!is_idle() && !is_cancelled()) {
      const bool segment = has_subsegments();
      const Feature_request r = queues_.pop(segment);
      if (r.reason == Split_reason::missing)
        split(r, segment);
      else
        others.push(segment, r);
    }
    others.take_all(queues_);
    std::swap(queues_, others);
  }

  /// Does an errand that arrived here; appends what goes on from here to `outgoing`. True if the client, a
  /// tetrahedron, is to be sent home.
  bool run(std::unique_ptr<Errand>& errand) {
    using Client = typename Errand::Client;
    Errand& e = *errand;
    if (e.is_image()) {
      if (!zone().is_near(e.by)) return false;
      images_.add({e.by, e.on, e.home, e.by->insertion_radius(), e.reason != Split_reason::missing});
      put_images();
      return false;
    }
    const bool live = e.is_subsegment ? complex_.is_live_subsegment(e.piece) : complex_.is_live_subfacet(e.piece);
    Split_outcome outcome = Split_outcome::inserted;
    if (live)
      outcome = e.is_subsegment ? split_subsegment(e.piece.slot, e.reason, e.guard)
                                : split_subfacet(e.piece.slot, e.reason, e.guard);
    if (outcome == Split_outcome::elsewhere) {
      if (elsewhere_.is_subsegment != e.is_subsegment) e.reason = reason_for_redirect(e.reason);
      e.piece = elsewhere_.piece;
      e.is_subsegment = elsewhere_.is_subsegment;
      outgoing_.emplace_back(elsewhere_.at, std::move(errand));
      return false;
    }
    if (e.client == Client::subfacet && outcome == Split_outcome::inserted &&
        complex_.is_live_subfacet(e.request.piece))
      queues_.subfacets.push(e.request);
    if (e.client != Client::tetrahedron) return false;
    if (outcome == Split_outcome::refused) e.refused.push_back(e.obstacle);
    return true;
  }

 private:
  using Image = typename Images_3<Tr>::Image;
  static constexpr auto always = [](std::uint32_t, const Vec_3&) { return true; };
  static constexpr std::size_t most_images = 10000;  ///< and pieces that they delete, of one point

  template <class Good>
  Split_outcome split_flat(std::uint32_t slot, bool is_subsegment, const Vec_3& m, bool may_tear, const Good& is_good) {
    const auto accept = [&](std::uint32_t split, const Vec_3& at) {
      const bool is_allowed = !tears_others(split) || (may_tear && !encroaches_protected(complex_, features_, &acute_, Point(at.x, at.y, at.z)));
      return is_allowed && acute_.balls().find(at) == Protected_balls_3::none && is_good(std::as_const(cavity_), at);
    };
    return is_subsegment ? split_subsegment_at(slot, m, Split_reason::flat, {}, accept) : split_subfacet_at(slot, m, Split_reason::flat, {}, accept);
  }

  /// Splits a subsegment at m, unless `accept(slot, m)` says no when the cavity is found, and the stars in the facets are planned.
  template <class Accept>
  Split_outcome split_subsegment_at(std::uint32_t slot, const Vec_3& m, Split_reason reason, const Split_guard& guard, const Accept& accept) {
    auto& s = complex_.subsegment(slot);
    const double radius = complex_.subsegment_radius(slot);
    const auto is_to_be_alone = [&](std::uint32_t t) { return needs_to_be_alone({2, complex_.subfacet(t).facet}, m, radius); };
    if (!region_.contains(m) || !territory().owns(s.vertices) || needs_to_be_alone({1, s.segment}, m, radius) ||
        std::ranges::any_of(s.subfacets, is_to_be_alone))
      return point_elsewhere(m, complex_.subsegment_id(slot), true);
    if (!s.present && !is_near(s.vertices)) return unsafe(m, complex_.subsegment_id(slot), true, reason);
    if (split_points_.is_subsegment_protected(slot)) return Split_outcome::refused;
    const bool is_plain = reason == Split_reason::encroached && guard.count == 0;
    if ((is_plain && guard.floor >= s.refused_floor) || spacing_.is_too_close(m, s.vertices, reason, guard, radius))
      return Split_outcome::refused;
    const Point p(m.x, m.y, m.z);
    if (const auto r = search_.from_subsegment(p, s); r != Search_result::found)
      return blocked(r == Search_result::foreign, m, complex_.subsegment_id(slot), true);
    if (!is_wide_enough(m, {1, s.segment}, s.vertices, reason, guard, radius)) {
      if (is_plain && guard.reach == 0) s.refused_floor = std::min(s.refused_floor, guard.floor);
      return abandon();
    }

    features_.gather(complex_, cavity_);
    if (reason == Split_reason::encroached && tears_protected(complex_, features_, acute_, m, {1, s.segment}, slot))
      return abandon();
    features_.mark_deleted(complex_, true);
    stars_.resize(s.subfacets.size());
    for (std::size_t k = 0; k < s.subfacets.size(); ++k)
      if (!stars_[k].plan(complex_, s.subfacets[k], p, slot, territory())) {
        features_.mark_deleted(complex_, false);
        cavity_.abandon();
        return blocked(stars_[k].is_foreign(), m, complex_.subsegment_id(slot), true);
      }
    if (!accept(slot, m)) {
      features_.mark_deleted(complex_, false);
      return abandon();
    }
    const Vertex_handle v = commit(p, m, {1, s.segment});
    // Vertices on the shell of one acute corner come as close to each other as the angles there make them; what
    // counts as their insertion radius is the shell's.
    for (const Vertex_handle end : s.vertices)
      if (split_points_.is_acute(end))
        v->set_insertion_radius(std::max<double>(v->insertion_radius(), length(m - position(end))));
    inherit(v, guard);
    finish(v, complex_.halve_subsegment(pool_, slot, v), slot);
    complex_.remove_subsegment(pool_, slot);
    mirror(v, reason);
    return Split_outcome::inserted;
  }

  static constexpr int most_tries = 3;  ///< of putting an image, with subsegments in the way

  void handle(bool only_missing) {
    const bool segment = has_subsegments();
    const Feature_request r = queues_.pop(segment);
    if (!only_missing || r.reason == Split_reason::missing) split(r, segment);
  }

  void split(const Feature_request& r, bool segment) {
    if (segment ? !complex_.is_live_subsegment(r.piece) : !complex_.is_live_subfacet(r.piece)) return;
    const std::uint32_t slot = r.piece.slot;
    const bool present = segment ? complex_.subsegment(slot).present : complex_.subfacet(slot).present;
    if (r.reason == Split_reason::missing && present) return;
    const auto outcome = segment ? split_subsegment(slot, r.reason, r.guard()) : split_subfacet(slot, r.reason, r.guard());
    if (outcome == Split_outcome::elsewhere)
      hand_on(r, segment);
    else if (outcome == Split_outcome::inserted && !segment && complex_.is_live_subfacet(r.piece))
      queues_.subfacets.push(r);  // still there: a subsegment was split instead
  }

  Split_outcome point_elsewhere(const Vec_3& at, Piece_id piece, bool is_subsegment) {
    elsewhere_ = {at, piece, is_subsegment};
    return Split_outcome::elsewhere;
  }

  Split_outcome blocked(bool is_foreign, const Vec_3& at, Piece_id piece, bool is_subsegment) {
    return is_foreign ? point_elsewhere(at, piece, is_subsegment) : Split_outcome::refused;
  }

  /// Whether a point has images that may lie in another territory. They have to be there before anything else is: facets that
  /// meet at a small angle and get points at unlike places give each other ever more of them.
  bool needs_to_be_alone(const Feature_id& on, const Vec_3& m, double radius) const {
    return !is_looking_ && !territory().is_everything() && images_.has_images(on, m, radius);
  }

  /// Flips an edge of a missing subfacet where the sheet is not Delaunay, if there is one.
  bool flip_missing(std::uint32_t slot) {
    // Once there are subdomains a piece that is there must not move: it separates them.
    const std::uint32_t n = neighbor_to_flip(complex_, slot, territory(), !keep_fresh_);
    if (n == Complex::none) return false;
    unmark_survivors(complex_, search_.star(), {n});
    complex_.flip(slot, n);
    for (const std::uint32_t t : {slot, n}) {
      complex_.subfacet(t).present = false;
      if (const Cell_handle c = mark_subfacet(complex_, search_.star(), t); c != Cell_handle())
        request_if_encroached(c, index_of_fourth<Tr>(c, complex_.subfacet(t).vertices));
      else
        note_missing_subfacet(t);
    }
    return true;
  }

  template <class Accept>
  Split_outcome split_subfacet_at(std::uint32_t slot, Vec_3 m, Split_reason reason, const Split_guard& guard, const Accept& accept) {
    const auto& t = complex_.subfacet(slot);
    if (!std::isfinite(m.x + m.y + m.z)) return Split_outcome::refused;
    if (reason == Split_reason::encroached && split_points_.is_subfacet_protected(slot)) return Split_outcome::refused;
    if (!region_.contains(m) || needs_to_be_alone({2, t.facet}, m, length(m - position(t.vertices[0]))))
      return point_elsewhere(m, complex_.subfacet_id(slot), false);
    if (!t.present && !is_near(t.vertices)) return unsafe(m, complex_.subfacet_id(slot), false, reason);
    if (reason == Split_reason::missing && flip_missing(slot)) return Split_outcome::inserted;
    Sheet_place at = walk_in_sheet(complex_, slot, Point(m.x, m.y, m.z), territory());
    const auto is_beside = [&] {
      return at.subsegment != Complex::none && !is_in_the_way(complex_.subsegment(at.subsegment), t, Point(m.x, m.y, m.z));
    };
    if (is_beside()) {
      m = complex_.on_plane(t.facet, point_before(complex_.subsegment(at.subsegment), t, m));
      at = walk_in_sheet(complex_, slot, Point(m.x, m.y, m.z), territory());
      if (is_beside()) return Split_outcome::refused;
    }
    if (at.is_foreign) return point_elsewhere(m, complex_.subfacet_id(slot), false);
    // Shells around a corner make cocircular trapezoids: for their sake alone no further shell is made.
    const bool yields = reason != Split_reason::flat;
    const auto give_way = [&](std::uint32_t s) {
      last_way_ = complex_.subsegment_id(s);
      return yields ? split_subsegment(s, reason_for_redirect(reason), guard) : Split_outcome::refused;
    };
    if (at.subsegment != Complex::none) return give_way(at.subsegment);
    if (const Vec_3 q = complex_.on_sheet(at.subfacet, m); region_.contains(q)) m = q;
    const double radius = complex_.subfacet_radius(slot);
    if (guard.count == 0 && spacing_.is_too_close(m, t.vertices, reason, guard, radius)) return Split_outcome::refused;
    const Point p(m.x, m.y, m.z);
    // One long subsegment may be in the way of thousands of thin subfacets whose points have large cavities.
    if (yields && last_way_.slot != Complex::none && complex_.is_live_subsegment(last_way_) &&
        is_encroached(complex_.subsegment(last_way_.slot), p))
      return give_way(last_way_.slot);
    if (const auto r = search_.from_subfacet(p, at.subfacet, slot); r != Search_result::found)
      return blocked(r == Search_result::foreign, m, complex_.subfacet_id(slot), false);
    features_.gather(complex_, cavity_);
    for (const auto& f : features_.subsegments())
      if (f.deleted || (yields && is_encroached(complex_.subsegment(f.slot), p))) {
        cavity_.abandon();
        return give_way(f.slot);
      }
    if (!is_wide_enough(m, {2, t.facet}, t.vertices, reason, guard, radius)) return abandon();
    if (reason == Split_reason::encroached && tears_protected(complex_, features_, acute_, m, {2, t.facet}, Complex::none))
      return abandon();
    const Vertex_handle v = insert_on_facet(at.subfacet, p, m, guard, accept);
    if (v == Vertex_handle()) return blocked(stars_[0].is_foreign(), m, complex_.subfacet_id(slot), false);
    mirror(v, reason);
    return Split_outcome::inserted;
  }

  /// Whether the point whose cavity is found, and whose stars are planned, would delete pieces that it does not replace.
  bool tears_others(std::uint32_t split) const {
    const auto is_replaced = [this](std::uint32_t t) {
      return std::ranges::any_of(stars_, [t](const auto& star) { return std::ranges::find(star.removed(), t) != star.removed().end(); });
    };
    return std::ranges::any_of(features_.subsegments(), [split](const auto& f) { return f.deleted && f.slot != split; }) ||
           std::ranges::any_of(features_.subfacets(), [&](const auto& f) { return f.deleted && !is_replaced(f.slot); });
  }

  bool is_near(const auto& vertices) const {
    return std::ranges::all_of(vertices, [this](Vertex_handle v) { return zone().is_near(v); });
  }

  /// Of a missing piece nothing is known but its vertices; where these are far away, nobody else may be at work.
  Split_outcome unsafe(const Vec_3& at, Piece_id piece, bool is_subsegment, Split_reason reason) {
    return reason == Split_reason::missing ? point_elsewhere(at, piece, is_subsegment) : Split_outcome::refused;
  }

  /// Sends a request to where its point is; what is missing waits for quieter times.
  void hand_on(const Feature_request& r, bool segment) {
    if (r.reason == Split_reason::missing) {
      stranded_.push(segment, r);
      return;
    }
    auto errand = std::make_unique<Errand>();
    errand->piece = elsewhere_.piece;
    errand->is_subsegment = elsewhere_.is_subsegment;
    errand->guard = r.guard();
    const bool redirected = elsewhere_.is_subsegment != segment;
    errand->reason = redirected ? reason_for_redirect(r.reason) : r.reason;
    if (redirected) {
      errand->client = Errand::Client::subfacet;
      errand->request = r;
    }
    outgoing_.emplace_back(elsewhere_.at, std::move(errand));
  }

  /// A subsegment in the way of a missing subfacet has to go as much as the subfacet itself has to come.
  static Split_reason reason_for_redirect(Split_reason reason) {
    return reason == Split_reason::missing ? Split_reason::missing : Split_reason::encroached;
  }

  const Territory_3<Tr>& territory() const { return cavity_.territory(); }

  bool is_wide_enough(const Vec_3& m, const Feature_id& on, const auto& vertices, Split_reason reason, const Split_guard& guard, double radius) {
    const double bend = on.dimension == 2 ? complex_.bend(on.index) : 0;
    const Spacing spacing = spacing_.spacing(cavity_, m, on, vertices, reason, guard, radius, bend);
    met_minimum_ = met_minimum_ || spacing == Spacing::below_minimum;
    return spacing == Spacing::wide_enough;
  }

  Split_outcome abandon() {
    cavity_.abandon();
    return Split_outcome::refused;
  }

  /// Gives the features that meet v's at a small angle, and pass closer to v than other vertices are, a point at the
  /// like place (see `Facet_wedges_3`, `Segment_wedges_3`, `Vertex_wedges_3`).
  void mirror(Vertex_handle v, Split_reason reason) {
    images_.add_of(v, made_, reason != Split_reason::missing);
    put_images();
  }

  void put_images() {
    if (std::exchange(is_putting_images_, true)) return;
    while (!images_.empty())
      if (const Image i = images_.pop(); !is_cancelled()) put_image(i);
    is_putting_images_ = false;
  }

  /// Puts an image on its feature, or sends an errand there. Not where the feature is not, or has a vertex as near as v itself
  /// is, or subsegments are in the way.
  void put_image(Image i) {
    if (i.on.dimension == 1) return put_on_segment(i);
    const std::uint32_t at = find_place(i);
    if (at == Complex::none) return;
    const Point p(i.at.x, i.at.y, i.at.z);
    const double near = 0.5 * std::min(i.radius, length(i.at - position(i.by)));
    const auto is_elsewhere = [&](Vertex_handle w) { return !complex_.is_on_facet(w, i.on.index); };
    if (cavity_.squared_insertion_radius(i.at, is_elsewhere) < near * near ||
        spacing_.is_below_minimum(cavity_.squared_insertion_radius(i.at)))
      return cavity_.abandon();
    const std::vector<Piece_id> way = images_.in_the_way(i, p, near, features_, at);
    if (!way.empty()) return make_way(i, way);
    if (const Vertex_handle v = insert_on_facet(at, p, i.at, guard_of(i)); v != Vertex_handle()) {
      images_.add_of(v, made_, i.is_usual, i.by);
    } else if (stars_[0].is_foreign()) {
      hand_on(i);
    }
  }

  void put_on_segment(const Image& i) {
    if (!images_.is_alone()) {
      if (!find_cavity(i)) return;
      cavity_.abandon();
    }
    const std::uint32_t slot = images_.subsegment_at(i, features_);
    if (slot == Complex::none) return;
    const Split_outcome outcome = split_subsegment_at(slot, i.at, Split_reason::missing, guard_of(i), always);
    if (outcome == Split_outcome::elsewhere) hand_on(i);
    if (outcome != Split_outcome::inserted || i.by != Vertex_handle()) return;
    for (const Vertex_handle v : complex_.subsegment(complex_.find_on_segment(i.on.index, i.at)).vertices)
      if (position(v) == i.at) v->set_crossing();
  }

  /// Finds the subfacet that holds an image, and the image's cavity, with the image moved onto it: on the plane of a bent facet it could be beyond
  /// another facet. None, and no cavity, if there is none; or the image is handed on.
  std::uint32_t find_place(Image& i) {
    for (bool is_moved = false; find_cavity(i); is_moved = true) {
      const std::uint32_t at = images_.subfacet_at(i, Point(i.at.x, i.at.y, i.at.z), features_, at_work_, queues_.subfacets);
      const Vec_3 q = at == Complex::none ? i.at : complex_.on_sheet(at, i.at);
      if (at != Complex::none && (is_moved || q == i.at || !region_.contains(q))) return at;
      cavity_.abandon();
      if (at == Complex::none) break;
      i.at = q;
    }
    return Complex::none;
  }

  /// Finds an image's cavity and the features on it. If that is elsewhere, the image is handed on.
  bool find_cavity(const Image& i) {
    const Search_result r = region_.contains(i.at) ? search_.from_vertex(Point(i.at.x, i.at.y, i.at.z), i.by) : Search_result::foreign;
    if (r == Search_result::foreign) hand_on(i);
    if (r != Search_result::found) return false;
    features_.gather(complex_, cavity_);
    return true;
  }

  static Split_guard guard_of(const Image& i) {
    return i.inherits ? Split_guard{.relaxed = i.by->relaxed_radius(), .inherited = i.radius} : Split_guard{};
  }

  void hand_on(const Image& i) {
    auto errand = std::make_unique<Errand>();
    errand->by = i.by;
    errand->on = i.on;
    errand->home = i.at;
    errand->reason = i.is_usual ? Split_reason::encroached : Split_reason::missing;
    outgoing_.emplace_back(i.at, std::move(errand));
  }

  /// Splits the subsegments in the way of an image, which has another try then.
  void make_way(Image i, const std::vector<Piece_id>& way) {
    cavity_.abandon();
    if (i.tries++ == most_tries) return;
    bool is_split = false, is_elsewhere = false;
    for (const Piece_id& s : way) {
      if (!complex_.is_live_subsegment(s)) continue;
      const Feature_id on{1, complex_.subsegment(s.slot).segment};
      const Split_guard guard = spacing_.guard(on, split_points_.of_subsegment(s.slot), i.by);
      const Split_outcome outcome = split_subsegment(s.slot, Split_reason::encroached, guard);
      is_split |= outcome == Split_outcome::inserted;
      is_elsewhere |= outcome == Split_outcome::elsewhere && !territory().is_everything();
    }
    if (is_elsewhere)
      hand_on(i);
    else if (is_split)
      images_.add(i);
  }

  /// Inserts p into the subfacet that holds it. None, with the cavity abandoned, if the sheet would not stay whole.
  /// \pre p's cavity is found and its features are gathered
  template <class Accept = decltype(always)>
  Vertex_handle insert_on_facet(std::uint32_t at, const Point& p, const Vec_3& m, const Split_guard& guard = {}, const Accept& accept = always) {
    features_.mark_deleted(complex_, true);
    stars_.resize(1);
    if (!stars_[0].plan(complex_, at, p, Complex::none, territory()) || !accept(Complex::none, m)) {
      features_.mark_deleted(complex_, false);
      cavity_.abandon();
      return {};
    }
    const Vertex_handle v = commit(p, m, {2, complex_.subfacet(at).facet});
    inherit(v, guard);
    finish(v, {Complex::none, Complex::none}, Complex::none);
    return v;
  }

  Vertex_handle commit(const Point& p, const Vec_3& m, const Feature_id& on) {
    const double radius = std::sqrt(spacing_.squared_distance(cavity_, m, on));
    const Vertex_handle v = cavity_.commit(p);
    v->set_feature(on.dimension, on.index);
    v->set_insertion_radius(radius);
    tr_.tell(v);
    ++inserted_;
    return v;
  }

  /// The relaxed insertion radius of its cause, and part of it as its own where it was let closer to others for its cause's sake
  /// (`floor_apart`): a chain of causes does not go down by the same factor time after time.
  static void inherit(Vertex_handle v, const Split_guard& guard) {
    constexpr double part = 0.75;  // table in docs/robustness.md
    const double radius = std::max(guard.inherited, guard.floor_apart > 0 ? part * guard.floor : 0);
    if (radius > 0) v->set_insertion_radius(std::max<double>(v->insertion_radius(), radius));
    v->relax_radius(guard.relaxed);
  }

  /// After a point was inserted: replaces the planned stars, marks what is present, queues what is missing or encroached.
  void finish(Vertex_handle v, const std::array<std::uint32_t, 2>& halves, std::uint32_t split) {
    made_.clear();
    bool has_moved = false;
    for (const auto& star : stars_) {
      has_moved |= unmark_survivors(complex_, search_.star(), star.removed());
      star.apply(complex_, pool_, v, halves, made_);
    }
    images_.note_made(made_);
    for (const auto& f : features_.subfacets())
      if (f.deleted && complex_.subfacet(f.slot).alive() && complex_.subfacet(f.slot).scratch)
        note_missing_subfacet(f.slot);
    features_.mark_deleted(complex_, false);
    for (const auto& f : features_.subsegments())
      if (f.deleted && f.slot != split) note_missing_subsegment(f.slot);

    for (const std::uint32_t h : halves)
      if (h != Complex::none && !mark_subsegment(complex_, h, cavity_)) note_missing_subsegment(h);
    mark_subfacets(complex_, v, made_, cavity_);
    for (const std::uint32_t t : made_)
      if (!complex_.subfacet(t).present) note_missing_subfacet(t);

    for_each_encroached(
        tr_, complex_, cavity_, v, halves, made_,
        [this](std::uint32_t s, Vertex_handle w) { note_encroached_subsegment(s, w); },
        [this](std::uint32_t t, Vertex_handle w) { note_encroached_subfacet(t, w); });
    for (const Cell_handle c : cavity_.star()) {
      if (keep_fresh_) fresh_cells_.push_back({c, c->generation(), 0});
      if (keep_fresh_ && (torn_ || has_moved)) unlabelled_cells_.push_back({c, c->generation(), 0});
    }
  }

  Tr& tr_;
  Complex& complex_;
  const Acute_neighborhood_3& acute_;
  Split_points_3<Tr> split_points_;
  Split_spacing_3<Tr> spacing_;
  Cavity_3<Tr> cavity_;
  Cavity_search_3<Tr> search_;
  Cavity_features_3<Tr> features_;
  std::vector<Facet_star_3<Tr>> stars_;
  std::vector<std::uint32_t> made_;
  Images_3<Tr> images_;
  Pool pool_;
  Region_3 region_;
  Feature_queues queues_;
  Feature_queues stranded_;
  std::vector<std::pair<Vec_3, std::unique_ptr<Errand>>> outgoing_;
  Split_elsewhere elsewhere_;
  bool met_minimum_ = false;
  std::vector<Cell_id> fresh_cells_;
  std::vector<Cell_id> unlabelled_cells_;
  Piece_id at_work_;   ///< the subfacet that is being split: if it is missing it waits no more, but images belong on it as well
  Piece_id last_way_;  ///< the subsegment that was split, or refused, in the place of a subfacet, within the same task
  std::size_t inserted_ = 0;
  bool keep_fresh_ = false;
  bool torn_ = false;
  bool is_looking_ = false;  ///< no point is inserted, so that none needs images
  bool is_putting_images_ = false;
  const std::atomic<bool>* cancel_ = nullptr;
};

}  // namespace pgdr

#endif
