// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_MESH_VERTEX_BASE_3_H
#define PGDR_MESH_MESH_VERTEX_BASE_3_H

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>

#include <CGAL/Triangulation_vertex_base_3.h>

namespace pgdr {

/// Vertex of the mesh: which feature of the domain it lies on, and how far its neighbours were when it came.
template <class Gt, class Vb = CGAL::Triangulation_vertex_base_3<Gt>>
class Mesh_vertex_base_3 : public Vb {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;

  template <class Tds2>
  struct Rebind_TDS {
    using Other = Mesh_vertex_base_3<Gt, typename Vb::template Rebind_TDS<Tds2>::Other>;
  };
  using Vb::Vb;

  /// Dimension of the lowest-dimensional feature that holds the vertex: 0 input vertex, 1 segment,
  /// 2 facet, 3 volume; 4 for a corner of the bounding box that is no input vertex.
  int in_dimension() const { return dimension_; }
  /// Domain vertex, segment or facet, by `in_dimension()`; `none` for volume and box vertices.
  std::uint32_t index() const { return index_; }
  void set_feature(int dimension, std::uint32_t index) {
    dimension_ = static_cast<std::uint8_t>(dimension);
    index_ = index;
  }

  /// Distance to the nearest vertex at the time of insertion, rounded down, so that no edge there was then is shorter; 0 for input
  /// vertices, which may be refined at will.
  float insertion_radius() const { return insertion_radius_; }
  void set_insertion_radius(double r) { insertion_radius_ = relaxed_radius_ = rounded_down(r); }

  /// That of its cause, or its own if that is larger: where vertices are let closer to others than their causes had been, it goes down no chain of these.
  float relaxed_radius() const { return relaxed_radius_; }
  void relax_radius(double r) { relaxed_radius_ = std::max(relaxed_radius_, rounded_down(r)); }

  /// The two subsegments that meet in a vertex of dimension 1.
  std::array<std::uint32_t, 2>& subsegments() { return subsegments_; }
  const std::array<std::uint32_t, 2>& subsegments() const { return subsegments_; }

  /// Whether its segment crosses another one there, across a gap; then further vertices of both keep distances from there that are alike.
  bool is_crossing() const { return is_crossing_; }
  void set_crossing() { is_crossing_ = true; }

  /// Scratch: position in the cavity at hand, later in the output.
  std::uint32_t number() const { return number_; }
  void set_number(std::uint32_t n) { number_ = n; }

  /// Number of the territory that the vertex belongs to, see `Territory_3`. Atomic, since its owner may take it or give it away
  /// while others look whether it is theirs.
  std::uint32_t territory() const { return std::atomic_ref(territory_).load(std::memory_order_relaxed); }
  void set_territory(std::uint32_t t) { std::atomic_ref(territory_).store(t, std::memory_order_relaxed); }

 private:
  static float rounded_down(double r) {
    const auto nearest = static_cast<float>(r);
    return static_cast<double>(nearest) > r ? std::nextafter(nearest, 0.0f) : nearest;
  }

  std::uint32_t index_ = none;
  std::uint32_t number_ = none;
  std::array<std::uint32_t, 2> subsegments_{none, none};
  float insertion_radius_ = 0;
  float relaxed_radius_ = 0;
  mutable std::uint32_t territory_ = 0;
  std::uint8_t dimension_ = 3;
  bool is_crossing_ = false;
};

}  // namespace pgdr

#endif
