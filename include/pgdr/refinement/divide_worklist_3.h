// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_DIVIDE_WORKLIST_3_H
#define PGDR_REFINEMENT_DIVIDE_WORKLIST_3_H

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/mesh/territory_3.h>
#include <pgdr/refinement/leaf_worklist_3.h>
#include <pgdr/refinement/territory_map.h>

namespace pgdr {

/// How many territories are worth their while for a number of active elements, a power of two; 0: none. Each of `halvings` makes
/// them larger, for elements whose cavities are large.
inline std::size_t territory_count(std::size_t active, unsigned halvings) {
  constexpr std::size_t least = 256, usual = 4096, most = 64;
  const unsigned shift = std::min<unsigned>(halvings, std::bit_width(most));  // hundreds are possible where cavities stay large
  const std::size_t n = std::bit_floor(std::clamp<std::size_t>(active / usual, 4, most)) >> shift;
  return active < 2 * least ? 0 : std::clamp<std::size_t>(n, 2, std::bit_floor(active / least));
}

/// The vertices of a mesh, or a sample of about `most` of them that does not depend on their order, which timing decides; without those
/// that only make the hull.
template <class Tr>
std::vector<Territory_map::Item> sample_vertices(const Tr& tr, std::size_t most) {
  const std::uint64_t step = 1 + tr.number_of_vertices() / most;
  std::vector<Territory_map::Item> sample;
  for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v) {
    if (v->in_dimension() == 4) continue;
    const Vec_3 p = position(typename Tr::Vertex_handle(v));
    std::uint64_t hash = 0;
    for (int i = 0; i < 3; ++i) hash = (hash ^ std::bit_cast<std::uint64_t>(p[i])) * 0x9e3779b97f4a7c15u;
    if ((hash >> 32) % step == 0) sample.push_back({p, {p, p}});
  }
  return sample;
}

/// A division of space among territories. It ends when there is another one of the triangulation.
template <class Tr>
class Territories_3 {
 public:
  Territories_3(Tr& tr, Territory_map map) : map_(std::move(map)), first_(tr.reserve_territories(map_.parts() + 1)) {}

  std::size_t size() const { return map_.parts(); }
  Territory_3<Tr> operator[](std::size_t k) const { return {{first_ + 1 + static_cast<std::uint32_t>(k), first_, map_.region(k)}}; }
  /// The one that a point is in.
  std::size_t of(const Vec_3& p) const { return map_(p); }

 private:
  Territory_map map_;
  std::uint32_t first_;
};

/// Tells to which territory, from 1 on, or to none, 0, the items of a worklist belong. \pre no task is at work, or was, in any of them
template <class Tr>
class Territory_of_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Worklist = Leaf_worklist_3<Tr>;
  using Errand = typename Worklist::Errand;

  Territory_of_3(const Complex& complex, const Territories_3<Tr>& territories) : complex_(complex), territories_(territories) {
    for (std::size_t k = 0; k < territories.size(); ++k) regions_.push_back(territories[k].region);
  }

  std::uint16_t operator()(const typename Worklist::Cell_id& id) const {
    if (!id.is_live()) return Worklist::dead;
    return common(std::array{id.cell->vertex(0), id.cell->vertex(1), id.cell->vertex(2), id.cell->vertex(3)});
  }
  std::uint16_t operator()(const Feature_request& r, bool is_subsegment) const { return of_piece(r.piece, is_subsegment); }
  /// An errand is run where its piece is.
  std::uint16_t operator()(const std::unique_ptr<Errand>& e) const {
    if (e->is_image()) return common(std::array{e->by});
    const std::uint16_t t = of_piece(e->piece, e->is_subsegment);
    if (t == Worklist::dead) return 0;  // its client has to be told
    if (e->client != Errand::Client::subfacet) return t;
    const std::uint16_t u = of_piece(e->request.piece, false);
    return u == t || u == Worklist::dead ? t : std::uint16_t{0};
  }
  /// One that comes home is looked at where its tetrahedron is.
  std::uint16_t operator()(const std::unique_ptr<Errand>& e, bool) const { return (*this)(e->cell); }

 private:
  std::uint16_t of_piece(const Piece_id& piece, bool is_subsegment) const {
    if (is_subsegment)
      return complex_.is_live_subsegment(piece) ? common(complex_.subsegment(piece.slot).vertices) : Worklist::dead;
    return complex_.is_live_subfacet(piece) ? common(complex_.subfacet(piece.slot).vertices) : Worklist::dead;
  }

  /// That of all of the vertices, or 0; the infinite vertex does not count.
  template <std::size_t n>
  std::uint16_t common(const std::array<Vertex_handle, n>& vertices) const {
    std::size_t t = regions_.size();
    for (const Vertex_handle v : vertices) {
      if (v->territory() == Territory_id::everybody) continue;
      const Vec_3 p = position(v);
      if (t == regions_.size())
        t = territories_.of(p);
      else if (!regions_[t].contains(p))
        return 0;
    }
    return static_cast<std::uint16_t>(t + 1);
  }

  const Complex& complex_;
  const Territories_3<Tr>& territories_;
  std::vector<Region_3> regions_;
};

}  // namespace pgdr

#endif
