// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_IMAGES_3_H
#define PGDR_CONFORMING_IMAGES_3_H

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/conforming/cavity_features_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/conforming/feature_request.h>
#include <pgdr/conforming/sheet_walk_3.h>

namespace pgdr {

/// The mirror images of vertices on features close by that have yet to be put there.
template <class Tr>
class Images_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Point = typename Tr::Point;

  /// A point to be put on a feature for the sake of a vertex on another one.
  struct Image {
    Vertex_handle by;  ///< none: two segments cross each other there
    Feature_id on;
    Vec_3 at;
    double radius;  ///< the insertion radius of that vertex
    bool is_usual;  ///< not for the sake of a missing piece, see `Facet_wedges_3`
    bool inherits = true;  ///< that insertion radius
    int tries = 0;  ///< of putting it there
  };

  Images_3(const Complex& complex, const Acute_neighborhood_3& acute) : complex_(complex), acute_(acute) {}

  bool empty() const { return on_segments_.empty() && on_facets_.empty(); }
  void add(const Image& i) { (i.on.dimension == 1 ? on_segments_ : on_facets_).push_back(i); }
  /// Those on segments first, as subsegments come before subfacets: an image on a facet may be next to a segment, for which a point at the like place
  /// waits as well, and would have it split elsewhere.
  Image pop() {
    auto& images = on_segments_.empty() ? on_facets_ : on_segments_;
    const Image i = images.back();
    images.pop_back();
    return i;
  }

  /// Adds the images of v on features that are much closer to it than the vertices that it was inserted between.
  /// `around` are subfacets at v, those of one facet one after the other. `by`: what v is the image of, if it is one. That has no images of images
  /// beside it: bent facets meet in segments that are not on one line, and each of these would have a like place of its own for it, time after time.
  void add_of(Vertex_handle v, const std::vector<std::uint32_t>& around, bool is_usual, Vertex_handle by = {}) {
    Index facet = Tr::Vertex::none;
    const double radius = v->insertion_radius();
    for (const std::uint32_t t : around)
      if (std::exchange(facet, complex_.subfacet(t).facet) != complex_.subfacet(t).facet)
        for_each_image(facet, position(v), radius, (is_usual ? usual : 1) * radius, is_usual, add_on_facet(v, radius, is_usual, by));
    if (v->in_dimension() == 1) add_of_segment(v, v->index(), radius);
  }

  /// Adds the images of a domain vertex that one of its facets has on others.
  void add_of_corner(Vertex_handle v, Index facet, double radius) {
    for_each_image(facet, position(v), radius, usual * radius, true, add_on_facet(v, radius, true));
  }

  /// Adds the images of a vertex of a segment, which may be one of its ends, on segments close by and on facets below. On segments that meet it only for one that is alone
  /// at work: to conform to needles takes like points; when that is done refinement puts its own wherever it needs them, which images only add to.
  void add_of_segment(Vertex_handle v, Index segment, double radius) {
    const auto add_image = [&](const Mirror_image& i) { add({v, i.on, acute_.balls().outside(i.at), radius, true, i.inherits}); };
    if (is_alone()) acute_.segment_wedges().for_each_image(segment, position(v), close * radius, add_image);
    acute_.gaps().for_each_image_on_segments(segment, position(v), radius, is_alone(), add_image);
    acute_.vertex_wedges().for_each_image({1, segment}, position(v), radius, usual * radius, add_on_facet(v, radius, true));
  }

  /// Adds the points where segments cross each other, for one that is alone at work. Neither has a vertex there that could have an image.
  void add_crossings() {
    for (const auto* crossings : {&acute_.gaps().crossings(), &acute_.vertex_wedges().crossings()})
      for (const Crossing_3& c : *crossings)
        for (const std::size_t k : {0, 1}) add({{}, {1, c.segments[k]}, c.at[k], c.radius, true, false});
  }

  /// Whether a point m put on this facet, or segment, at this distance from other vertices would have images there, wherever these are.
  bool has_images(const Feature_id& on, const Vec_3& m, double radius) const {
    bool found = false;
    const auto note = [&](const Mirror_image&) { found = true; };
    if (on.dimension == 2) {
      for_each_image(on.index, m, radius, radius, true, note);
    } else {
      acute_.gaps().for_each_image_on_segments(on.index, m, radius, is_alone(), note);
      acute_.vertex_wedges().for_each_image(on, m, radius, usual * radius, note);
    }
    return found;
  }

  /// Keeps track of where each facet is from now on, for images on facets that are torn. Only for one that is alone at work,
  /// and tells of all subfacets that it makes.
  void find_facets() {
    some_subfacet_.assign(complex_.domain().facets.size(), Complex::none);
    for (std::uint32_t t = 0; t < complex_.subfacet_slots(); ++t)
      if (complex_.subfacet(t).alive()) some_subfacet_[complex_.subfacet(t).facet] = t;
  }
  void note_made(const std::vector<std::uint32_t>& subfacets) {
    if (!is_alone()) return;
    for (const std::uint32_t t : subfacets) some_subfacet_[complex_.subfacet(t).facet] = t;
  }

  /// Whether it was told of all subfacets.
  bool is_alone() const { return !some_subfacet_.empty(); }

  /// The subfacet that holds an image's point p: one of those on p's cavity, or a missing one that is at work, or waits. None if there is none.
  std::uint32_t subfacet_at(const Image& i, const Point& p, const Cavity_features_3<Tr>& cavity, const Piece_id& at_work,
                            const Fifo<Feature_request>& waiting) const {
    const auto holds = [&](std::uint32_t t) {
      return complex_.subfacet(t).facet == i.on.index && is_in_subfacet(complex_, complex_.subfacet(t), p);
    };
    for (const auto& f : cavity.subfacets())
      if (holds(f.slot)) return f.slot;
    if (is_alone()) {
      const Sheet_place at = walk_in_sheet(complex_, some_subfacet_[i.on.index], p);
      return at.subsegment == Complex::none ? at.subfacet : Complex::none;
    }
    if (at_work.slot != Complex::none && complex_.is_live_subfacet(at_work) && holds(at_work.slot)) return at_work.slot;
    for (const Feature_request& r : waiting)
      if (r.reason == Split_reason::missing && complex_.is_live_subfacet(r.piece) && holds(r.piece.slot))
        return r.piece.slot;
    return Complex::none;
  }

  /// The subsegment that holds an image, if its ends are about as far from there as the image's vertex was from others: found along the segment by one
  /// that is alone at work, else one of those on the image's cavity. None if there is none.
  std::uint32_t subsegment_at(const Image& i, const Cavity_features_3<Tr>& cavity) const {
    const std::uint32_t slot = is_alone() ? complex_.find_on_segment(i.on.index, i.at) : cavity_subsegment_at(i, cavity);
    if (slot == Complex::none) return slot;
    const auto is_near = [&](Vertex_handle v) { return length(position(v) - i.at) < least * i.radius; };
    return std::ranges::any_of(complex_.subsegment(slot).vertices, is_near) ? Complex::none : slot;
  }

  /// The subsegments that have to be split before an image's point p is put on the subfacet `at`. A segment's point does not mind
  /// what it encroaches; neither does its image, unless that is nearer than `near`.
  std::vector<Piece_id> in_the_way(const Image& i, const Point& p, double near, const Cavity_features_3<Tr>& cavity,
                                   std::uint32_t at) const {
    const auto is_on_line = [&](std::uint32_t slot, double distance) {
      const auto& s = complex_.subsegment(slot);
      return squared_distance_to_line(i.at, position(s.vertices[0]), position(s.vertices[1])) < distance * distance;
    };
    std::vector<Piece_id> way;
    for (const auto& f : cavity.subsegments())
      if (f.deleted || (is_encroached(complex_.subsegment(f.slot), p) && (i.by->in_dimension() == 2 || is_on_line(f.slot, near))))
        way.push_back(complex_.subsegment_id(f.slot));
    // A missing one is in no cavity. With the image where it has to be split it could never be recovered.
    for (const std::uint32_t side : complex_.subfacet(at).neighbors) {
      const std::uint32_t s = side & ~Complex::subsegment_bit;
      if (s != side && !complex_.subsegment(s).present && is_on_line(s, 0.1 * near)) way.push_back(complex_.subsegment_id(s));
    }
    return way;
  }

 private:
  /// How close the other segment has to be for an image, of the vertex's insertion radius. Table in docs/robustness.md.
  static constexpr double close = 0.01;
  /// And how close another facet.
  static constexpr double usual = 0.5;
  /// How far an image has to be from other vertices of its segment, of that radius: what a split may halve.
  static constexpr double least = 0.5;

  template <class Found>
  void for_each_image(Index facet, const Vec_3& m, double radius, double distance, bool is_usual, const Found& found) const {
    acute_.wedges().for_each_image(facet, m, radius, distance, is_usual, found);
    acute_.vertex_wedges().for_each_image({2, facet}, m, radius, distance, found);
    acute_.gaps().for_each_image_on_facets(facet, m, radius, is_alone(), found);
  }

  auto add_on_facet(Vertex_handle v, double radius, bool is_usual, Vertex_handle by = {}) {
    return [this, v, radius, is_usual, by](const Mirror_image& i) {
      const auto is_on_it = [&](Vertex_handle w) { return w != Vertex_handle() && complex_.is_on_facet(w, i.on.index); };
      if (!is_on_it(v) && !is_on_it(by)) add({v, i.on, complex_.on_plane(i.on.index, acute_.balls().outside(i.at)), radius, is_usual, i.inherits});
    };
  }

  std::uint32_t cavity_subsegment_at(const Image& i, const Cavity_features_3<Tr>& cavity) const {
    for (const auto& f : cavity.subsegments()) {
      const auto& s = complex_.subsegment(f.slot);
      if (s.segment == i.on.index && dot(position(s.vertices[0]) - i.at, position(s.vertices[1]) - i.at) < 0) return f.slot;
    }
    return Complex::none;
  }

  const Complex& complex_;
  const Acute_neighborhood_3& acute_;
  std::vector<Image> on_segments_, on_facets_;
  std::vector<std::uint32_t> some_subfacet_;  ///< of each facet, where that is known
};

}  // namespace pgdr

#endif
