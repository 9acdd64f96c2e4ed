// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_CONSTRAINT_COMPLEX_3_H
#define PGDR_CONFORMING_CONSTRAINT_COMPLEX_3_H

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <vector>

#include <boost/container/small_vector.hpp>

#include <pgdr/conforming/facet_plane_3.h>
#include <pgdr/conforming/slot_array.h>
#include <pgdr/domain/bend.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/mesh/mesh_triangulation_3.h>
#include <pgdr/mesh/triangle_ball.h>

namespace pgdr {

/// Names a piece by its slot and the use of that slot; a reference to a piece that was split since is recognised.
struct Piece_id {
  std::uint32_t slot = 0xffffffffu;
  std::uint32_t version = 0;

  friend bool operator==(const Piece_id&, const Piece_id&) = default;
};

/// Counts the uses of a slot, odd while it is in use. Atomic, since a distant task may reuse the slot while somebody
/// else looks whether the piece is still there.
class Piece_version {
 public:
  std::uint32_t get() const { return count_.load(std::memory_order_relaxed); }
  bool is_odd() const { return get() & 1u; }
  void advance(std::uint32_t by = 1) { count_.store(get() + by, std::memory_order_relaxed); }

 private:
  std::atomic<std::uint32_t> count_{0};
};

/// The segments and facets of the domain as the mesh has to show them: subsegments and subfacets, each *present*
/// in the 3D triangulation (and then marked on its cells) or still missing.
///
/// Every facet is a 2D triangulation of its own, one sheet of subfacets joined across common edges, that exists
/// whether or not its triangles exist in 3D. A constraint is recovered by splitting what is missing.
///
/// Several threads may change it at once, each with a `Pool` of its own, as long as no two of them are at work on
/// pieces with a vertex in common; only the versions of pieces may be asked for from anywhere.
template <class Tr>
class Constraint_complex_3 {
 public:
  using Kernel = typename Tr::Geom_traits;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Cell_handle = typename Tr::Cell_handle;
  using Domain = Domain_3<Kernel>;

  static constexpr std::uint32_t none = 0xffffffffu;
  /// Set in a neighbour code when what lies across the edge is a subsegment.
  static constexpr std::uint32_t subsegment_bit = 0x80000000u;

  struct Subsegment {
    std::array<Vertex_handle, 2> vertices;
    Index segment = 0;
    Piece_version version;
    bool present = false;
    std::uint8_t scratch = 0;
    /// A split for the sake of a vertex with this insertion radius was refused, so that with larger ones it will be, too: distances only
    /// become smaller.
    double refused_floor = std::numeric_limits<double>::infinity();
    /// One entry for every subfacet with this edge, in the order in which they came.
    boost::container::small_vector<std::uint32_t, 2> subfacets;

    bool alive() const { return version.is_odd(); }
  };

  struct Subfacet {
    std::array<Vertex_handle, 3> vertices;  ///< counterclockwise about the facet's normal
    /// Across the edge opposite to each vertex: a subfacet of the same facet, or a subsegment with `subsegment_bit`.
    std::array<std::uint32_t, 3> neighbors{none, none, none};
    Index facet = 0;
    Piece_version version;
    bool present = false;
    std::uint8_t scratch = 0;

    bool alive() const { return version.is_odd(); }
  };

  /// The slots that one thread may use.
  struct Pool {
    typename Slot_array<Subsegment>::Pool subsegments;
    typename Slot_array<Subfacet>::Pool subfacets;
  };

  explicit Constraint_complex_3(const Domain& domain) : domain_(&domain) {
    planes_.reserve(domain.facets.size());
    for (Index f = 0; f < domain.facets.size(); ++f) {
      planes_.emplace_back(domain.facets[f].origin, domain.facets[f].normal);
      bends_.push_back(pgdr::bend(domain, f));
    }
    corner_subsegments_.resize(domain.vertices.size());
    sides_.resize(domain.facets.size(), {unknown_side, unknown_side});
  }

  const Domain& domain() const { return *domain_; }
  const Facet_plane_3& plane(Index facet) const { return planes_[facet]; }

  /// Whether vertices of a facet are off its plane, since it was fused of near-coplanar ones.
  bool is_bent(Index facet) const { return bends_[facet] > 0; }
  /// How far they are off it at most; 0 if that is rounding only.
  double bend(Index facet) const { return bends_[facet]; }

  /// Moves a point next to a facet onto its plane. A bent facet may be narrower than it is off the plane: across that distance nothing may move sideways, or what is in
  /// the facet comes out of it.
  Vec_3 on_plane(Index facet, const Vec_3& p) const { return is_bent(facet) ? planes_[facet].project_along_axis(p) : planes_[facet].project(p); }

  /// Where a point next to a facet's plane that is in a subfacet, seen along the plane's dominant axis, goes: onto the subfacet, where the vertices
  /// of a fused facet are off its plane. If all points were in the plane there would be a step along its segments, as high as these are off.
  Vec_3 on_sheet(std::uint32_t i, const Vec_3& m) const {
    const Subfacet& t = subfacets_[i];
    return is_bent(t.facet) ? planes_[t.facet].lift(on_plane(t.facet, m), position(t.vertices[0]), position(t.vertices[1]), position(t.vertices[2])) : m;
  }

  Subsegment& subsegment(std::uint32_t i) { return subsegments_[i]; }
  const Subsegment& subsegment(std::uint32_t i) const { return subsegments_[i]; }
  Subfacet& subfacet(std::uint32_t i) { return subfacets_[i]; }
  const Subfacet& subfacet(std::uint32_t i) const { return subfacets_[i]; }
  std::size_t subsegment_slots() const { return subsegments_.size(); }
  std::size_t subfacet_slots() const { return subfacets_.size(); }

  Piece_id subsegment_id(std::uint32_t i) const { return {i, subsegments_[i].version.get()}; }
  Piece_id subfacet_id(std::uint32_t i) const { return {i, subfacets_[i].version.get()}; }
  bool is_live_subsegment(Piece_id p) const { return subsegments_[p.slot].version.get() == p.version; }
  bool is_live_subfacet(Piece_id p) const { return subfacets_[p.slot].version.get() == p.version; }

  /// Makes a subsegment and links it to its ends.
  std::uint32_t add_subsegment(Pool& pool, Vertex_handle a, Vertex_handle b, Index segment) {
    const std::uint32_t i = take(subsegments_, pool.subsegments);
    Subsegment& s = subsegments_[i];
    s.vertices = {a, b};
    s.segment = segment;
    s.present = false;
    s.refused_floor = std::numeric_limits<double>::infinity();
    s.subfacets.clear();
    link(a, i);
    link(b, i);
    return i;
  }

  /// Makes the two halves of a subsegment at v, its new inner vertex. The old one leaves its ends, but keeps its
  /// slot until `remove_subsegment`, so that the subfacets on it can still be told apart.
  std::array<std::uint32_t, 2> halve_subsegment(Pool& pool, std::uint32_t i, Vertex_handle v) {
    const auto ends = subsegments_[i].vertices;
    const Index segment = subsegments_[i].segment;
    for (const Vertex_handle end : ends) unlink(end, i);
    const std::uint32_t first = add_subsegment(pool, ends[0], v, segment);
    return {first, add_subsegment(pool, v, ends[1], segment)};
  }

  /// Gives back the slot of a halved subsegment.
  void remove_subsegment(Pool& pool, std::uint32_t i) { release(subsegments_[i], pool.subsegments, i); }

  std::uint32_t add_subfacet(Pool& pool, Vertex_handle a, Vertex_handle b, Vertex_handle c, Index facet) {
    const std::uint32_t i = take(subfacets_, pool.subfacets);
    Subfacet& t = subfacets_[i];
    t.vertices = {a, b, c};
    t.neighbors = {none, none, none};
    t.facet = facet;
    t.present = false;
    return i;
  }

  /// Also takes it off the lists of the subsegments on its edges.
  void remove_subfacet(Pool& pool, std::uint32_t i) {
    for (const std::uint32_t n : subfacets_[i].neighbors) {
      if (n == none || !(n & subsegment_bit)) continue;
      auto& list = subsegments_[n & ~subsegment_bit].subfacets;
      const auto at = std::find(list.begin(), list.end(), i);
      if (at != list.end()) list.erase(at);
    }
    release(subfacets_[i], pool.subfacets, i);
  }

  /// Exchanges the common edge of two subfacets for the other diagonal; both keep their slots.
  void flip(std::uint32_t first, std::uint32_t second) {
    Subfacet& t = subfacets_[first];
    Subfacet& u = subfacets_[second];
    const auto a = static_cast<std::size_t>(edge_with_neighbor(first, second));
    const auto b = static_cast<std::size_t>(edge_with_neighbor(second, first));
    const Vertex_handle j = t.vertices[a], k = t.vertices[(a + 1) % 3], l = t.vertices[(a + 2) % 3];
    const Vertex_handle i = u.vertices[b];
    const std::uint32_t jk = t.neighbors[(a + 2) % 3], lj = t.neighbors[(a + 1) % 3];
    const std::uint32_t il = u.neighbors[(b + 2) % 3], ki = u.neighbors[(b + 1) % 3];
    t.vertices = {j, k, i};
    t.neighbors = {ki, second, jk};
    u.vertices = {i, l, j};
    u.neighbors = {lj, first, il};
    replace_neighbor(ki, second, first);
    replace_neighbor(lj, first, second);
    t.version.advance(2);
    u.version.advance(2);
  }

  /// The subsegment between two vertices; `none` if there is none.
  std::uint32_t find_subsegment(Vertex_handle a, Vertex_handle b) const {
    if (a->in_dimension() != 1) std::swap(a, b);
    if (a->in_dimension() == 1) {
      for (const std::uint32_t i : a->subsegments())
        if (i != none && joins(i, a, b)) return i;
      return none;
    }
    if (a->in_dimension() != 0) return none;
    for (const std::uint32_t i : corner_subsegments_[a->index()])
      if (joins(i, a, b)) return i;
    return none;
  }

  /// The subsegment of a segment that holds a point between the segment's ends. Looks at all from the nearer end on.
  std::uint32_t find_on_segment(Index segment, const Vec_3& m) const {
    const auto ends = domain_->segments[segment].vertices;
    const Vec_3 a = to_vec(domain_->vertices[ends[0]]), b = to_vec(domain_->vertices[ends[1]]);
    const bool is_first = squared_distance(a, m) < squared_distance(b, m);
    const Index corner = ends[is_first ? 0 : 1];
    const Vec_3& origin = is_first ? a : b;
    const auto& list = corner_subsegments_[corner];
    const auto first = std::ranges::find_if(list, [&](std::uint32_t i) { return subsegments_[i].segment == segment; });
    if (first == list.end()) return none;
    std::uint32_t i = *first;
    const auto is_corner = [&](Vertex_handle v) { return v->in_dimension() == 0 && v->index() == corner; };
    for (Vertex_handle behind = *std::ranges::find_if(subsegments_[i].vertices, is_corner);;) {
      const auto& v = subsegments_[i].vertices;
      const Vertex_handle ahead = v[v[0] == behind ? 1 : 0];
      if (squared_distance(position(ahead), origin) >= squared_distance(m, origin)) return i;
      if (ahead->in_dimension() != 1) return none;
      const auto& both = ahead->subsegments();
      i = both[0] == i ? both[1] : both[0];
      behind = ahead;
    }
  }

  /// Whether a vertex lies on a facet, as a matter of record, not of coordinates.
  bool is_on_facet(Vertex_handle v, Index facet) const {
    switch (v->in_dimension()) {
      case 0: return contains(domain_->facets[facet].vertices, v->index());
      case 1: return contains(domain_->segments[v->index()].facets, facet);
      case 2: return v->index() == facet;
      default: return false;
    }
  }

  /// Whether a vertex lies on a segment, as a matter of record.
  bool is_on_segment(Vertex_handle v, Index segment) const {
    if (v->in_dimension() == 1) return v->index() == segment;
    const auto& ends = domain_->segments[segment].vertices;
    return v->in_dimension() == 0 && (ends[0] == v->index() || ends[1] == v->index());
  }

  /// Sign of the area of (a, b, c) projected along the facet's dominant axis, positive when counterclockwise
  /// about its normal. Exact.
  CGAL::Orientation orientation(Index facet, const typename Tr::Point& a, const typename Tr::Point& b,
                                const typename Tr::Point& c) const {
    return planes_[facet].template orientation<Kernel>(a, b, c);
  }

  /// Whether cell c lies on the side of its facet i that the facet's normal points to. \pre facet i is a subfacet
  bool is_in_front(Cell_handle c, int i) const {
    // Seen from inside a cell, the vertex triple of its facet is counterclockwise, and so is a subfacet from its front.
    const auto& t = subfacets_[c->subfacet(i)].vertices;
    const auto at = std::find(t.begin(), t.end(), c->vertex(Tr::vertex_triple_index(i, 0))) - t.begin();
    return t[static_cast<std::size_t>(at + 1) % 3] == c->vertex(Tr::vertex_triple_index(i, 1));
  }

  /// The subdomain in front of a facet (`front`) or behind it, if it is the same all over the facet.
  static constexpr std::int32_t unknown_side = -1, mixed_side = -2;
  std::int32_t side(Index facet, bool front) const { return sides_[facet][front]; }
  void note_side(Index facet, bool front, std::int32_t subdomain) {
    std::int32_t& s = sides_[facet][front];
    s = s == unknown_side || s == subdomain ? subdomain : mixed_side;
  }

  /// Of the diametral ball of a subsegment, and of the equatorial ball of a subfacet.
  double subsegment_radius(std::uint32_t i) const {
    const auto& v = subsegments_[i].vertices;
    return 0.5 * length(position(v[1]) - position(v[0]));
  }
  double subfacet_radius(std::uint32_t i) const {
    const auto& v = subfacets_[i].vertices;
    return triangle_circumradius(position(v[0]), position(v[1]), position(v[2]));
  }

  /// Position of the edge of subfacet i whose neighbour code is `code`.
  int edge_with_neighbor(std::uint32_t i, std::uint32_t code) const {
    const auto& n = subfacets_[i].neighbors;
    return n[0] == code ? 0 : n[1] == code ? 1 : n[2] == code ? 2 : -1;
  }

 private:
  /// What lies across an edge gets another subfacet on this side of it.
  void replace_neighbor(std::uint32_t code, std::uint32_t from, std::uint32_t to) {
    if (code & subsegment_bit) {
      auto& list = subsegments_[code & ~subsegment_bit].subfacets;
      *std::find(list.begin(), list.end(), from) = to;
    } else {
      auto& n = subfacets_[code].neighbors;
      *std::find(n.begin(), n.end(), from) = to;
    }
  }

  template <class Slots>
  static std::uint32_t take(Slots& slots, typename Slots::Pool& pool) {
    const std::uint32_t i = slots.take(pool);
    slots[i].version.advance();
    slots[i].scratch = 0;
    return i;
  }

  template <class Piece, class Slots_pool>
  static void release(Piece& piece, Slots_pool& pool, std::uint32_t i) {
    piece.version.advance();
    piece.present = false;
    pool.free.push_back(i);
  }

  static bool contains(const std::vector<Index>& sorted, Index i) {
    return std::binary_search(sorted.begin(), sorted.end(), i);
  }

  bool joins(std::uint32_t i, Vertex_handle a, Vertex_handle b) const {
    const auto& v = subsegments_[i].vertices;
    return (v[0] == a && v[1] == b) || (v[0] == b && v[1] == a);
  }

  void link(Vertex_handle v, std::uint32_t i) { replace_link(v, none, i); }
  void unlink(Vertex_handle v, std::uint32_t i) { replace_link(v, i, none); }
  void replace_link(Vertex_handle v, std::uint32_t from, std::uint32_t to) {
    if (v->in_dimension() == 1) {
      auto& s = v->subsegments();
      (s[0] == from ? s[0] : s[1]) = to;
    } else {
      auto& list = corner_subsegments_[v->index()];
      if (from == none)
        list.push_back(to);
      else
        list.erase(std::find(list.begin(), list.end(), from));
    }
  }

  const Domain* domain_;
  std::vector<Facet_plane_3> planes_;
  std::vector<double> bends_;
  Slot_array<Subsegment> subsegments_;
  Slot_array<Subfacet> subfacets_;
  std::vector<std::array<std::int32_t, 2>> sides_;
  std::vector<boost::container::small_vector<std::uint32_t, 4>> corner_subsegments_;
};

}  // namespace pgdr

#endif
