// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_MESH_CELL_BASE_3_H
#define PGDR_MESH_MESH_CELL_BASE_3_H

#include <array>
#include <atomic>
#include <cstdint>

#include <CGAL/Triangulation_cell_base_3.h>

#include <pgdr/mesh/certified_ball.h>

namespace pgdr {

/// Bit of the edge between the vertices i != j of a cell.
constexpr std::uint8_t edge_bit(int i, int j) {
  constexpr std::uint8_t bits[4][4] = {{0, 1, 2, 4}, {1, 0, 8, 16}, {2, 8, 0, 32}, {4, 16, 32, 0}};
  return bits[i][j];
}
/// Bits of the three edges at vertex i of a cell.
constexpr std::uint8_t edges_at(int i) {
  constexpr std::uint8_t bits[4] = {1 | 2 | 4, 1 | 8 | 16, 2 | 8 | 32, 4 | 16 | 32};
  return bits[i];
}

/// How far the refinement is with a cell.
enum class Cell_state : std::uint8_t {
  good = 0,      ///< within all bounds, or not looked at
  poor = 64,     ///< to be split: it is on the worklist of some leaf
  exempt = 128,  ///< poor, and given up next to a small angle
  limited = 192  ///< poor, and given up since edges would be shorter than the minimum
};

/// Cell of the mesh: its subdomain, which of its facets are subfacets and which of its edges subsegments.
///
/// `generation()` tells whether a remembered cell is still the same tetrahedron: it changes whenever the slot
/// is reused. It outlives the cell: the constructors leave it alone, as with CGAL's erase counters. It is accessed
/// atomically, since a distant task may reuse the slot while somebody else looks whether the cell is still there.
template <class Gt, class Cb = CGAL::Triangulation_cell_base_3<Gt>>
class Mesh_cell_base_3 : public Cb {
 public:
  static constexpr std::uint32_t no_subfacet = 0xffffffffu;

  template <class Tds2>
  struct Rebind_TDS {
    using Other = Mesh_cell_base_3<Gt, typename Cb::template Rebind_TDS<Tds2>::Other>;
  };
  using Vertex_handle = typename Cb::Vertex_handle;
  using Cell_handle = typename Cb::Cell_handle;

  // Written out, since a defaulted constructor would let value-initialization clear the generation.
  Mesh_cell_base_3() {}
  Mesh_cell_base_3(Vertex_handle v0, Vertex_handle v1, Vertex_handle v2, Vertex_handle v3) : Cb(v0, v1, v2, v3) {}
  Mesh_cell_base_3(Vertex_handle v0, Vertex_handle v1, Vertex_handle v2, Vertex_handle v3, Cell_handle n0,
                   Cell_handle n1, Cell_handle n2, Cell_handle n3)
      : Cb(v0, v1, v2, v3, n0, n1, n2, n3) {}

  /// Position in the table of subdomains; 0: not meshed (outside, or a hole).
  std::int32_t subdomain() const { return subdomain_; }
  void set_subdomain(std::int32_t s) { subdomain_ = s; }

  /// Subfacet on the facet opposite to vertex i, or `no_subfacet`.
  std::uint32_t subfacet(int i) const { return subfacets_[static_cast<std::size_t>(i)]; }
  void set_subfacet(int i, std::uint32_t id) { subfacets_[static_cast<std::size_t>(i)] = id; }
  bool has_subfacet() const {
    return (subfacets_[0] & subfacets_[1] & subfacets_[2] & subfacets_[3]) != no_subfacet;
  }

  /// Set of `edge_bit`s of the edges that are subsegments.
  std::uint8_t subsegment_edges() const { return flags_ & all_edges; }
  void set_subsegment_edges(std::uint8_t e) { flags_ = static_cast<std::uint8_t>((flags_ & ~all_edges) | e); }

  Cell_state state() const { return static_cast<Cell_state>(flags_ & ~all_edges); }
  void set_state(Cell_state s) { flags_ = static_cast<std::uint8_t>((flags_ & all_edges) | static_cast<std::uint8_t>(s)); }
  /// Whether it is known to be poor, so that it is on the worklist of some leaf or was given up.
  bool is_poor() const { return state() != Cell_state::good; }

  unsigned int generation() const { return atomic_generation().load(std::memory_order_relaxed); }
  void advance_generation() { set_erase_counter(generation() + 1); }

  // The names under which CGAL's containers keep the counter across erase and reuse of a slot.
  unsigned int erase_counter() const { return generation(); }
  void set_erase_counter(unsigned int c) { atomic_generation().store(c, std::memory_order_relaxed); }
  void increment_erase_counter() { advance_generation(); }

  /// The circumball as far as it is known.
  const Certified_ball& ball() const { return ball_; }
  Certified_ball& ball() { return ball_; }

  /// Tag of the task that works on the cell, 0 for none; kept by `Zone_guard_3` in checked runs only.
  std::atomic_ref<std::uint16_t> owner() const { return std::atomic_ref<std::uint16_t>(owner_); }

 private:
  std::atomic_ref<unsigned int> atomic_generation() const { return std::atomic_ref<unsigned int>(generation_); }

  static constexpr std::uint8_t all_edges = 63;

  // With what the base leaves of its last eight bytes, the first three fill them: another byte would cost eight.
  std::uint8_t flags_ = 0;
  mutable std::uint16_t owner_ = 0;
  mutable unsigned int generation_;
  std::int32_t subdomain_ = 0;
  Certified_ball ball_;
  std::array<std::uint32_t, 4> subfacets_{no_subfacet, no_subfacet, no_subfacet, no_subfacet};
};

}  // namespace pgdr

#endif
