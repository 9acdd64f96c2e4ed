// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_ACUTE_SPLIT_SPACING_3_H
#define PGDR_ACUTE_SPLIT_SPACING_3_H

#include <algorithm>
#include <cstddef>
#include <limits>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/acute/split_guard_3.h>
#include <pgdr/domain/feature_id.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mesh/cavity_3.h>

namespace pgdr {

/// Whether a point may come as close to the vertices around it as it would.
enum class Spacing : std::uint8_t {
  wide_enough,
  too_close,     ///< next to a small angle, or on a bent facet
  below_minimum  ///< closer than the minimum edge length
};

/// How close to other vertices a point on a feature may be.
///
/// Vertices that are near only because their feature and the point's meet at a small angle do not count: the two features
/// get points at like places, as close to each other as the angle makes them, and that is no reason for shorter edges along
/// either of them. (J. Shewchuk and H. Si, *Higher-quality tetrahedral mesh generation for domains with small angles by
/// constrained Delaunay refinement*, SoCG 2014, call such edges seditious.) Along each feature, then, distances are bounded
/// from below, and the refinement ends.
template <class Tr>
class Split_spacing_3 {
 public:
  Split_spacing_3(const Acute_neighborhood_3& acute, double min_edge_length)
      : acute_(acute), squared_min_edge_(min_edge_length * min_edge_length) {}

  /// Squared distance from m to the nearest vertex of its cavity that counts.
  double squared_distance(const Cavity_3<Tr>& cavity, const Vec_3& m, const Feature_id& on) const {
    return cavity.squared_insertion_radius(m, [&](typename Tr::Vertex_handle v) {
      return acute_.explains(on, m, feature_of(v), position(v));
    });
  }

  /// What a vertex v encroaches is split next to small angles only if the new edges are no shorter than those that v itself
  /// came with: otherwise two features could drive each other to ever shorter ones. How far "next to" reaches: if v is this
  /// close to m, the split point, just because the two features meet at a small angle, however far away they meet.
  double reach(const Feature_id& on, const Vec_3& m, typename Tr::Vertex_handle v) const {
    const bool explained = acute_.explains(on, m, feature_of(v), position(v));
    return explained ? std::numeric_limits<double>::infinity() : 0;
  }

  /// For the split of a piece at m that v asks for.
  Split_guard guard(const Feature_id& on, const Vec_3& m, typename Tr::Vertex_handle v) const {
    return {.floor = v->insertion_radius(), .reach = reach(on, m, v), .relaxed = v->relaxed_radius()};
  }

  /// Whether a point at this squared distance from a vertex is too close to it, whoever asks for the point.
  bool is_below_minimum(double squared_distance) const { return squared_distance < squared_min_edge_; }

  /// Whether m, the split point of a piece with these vertices and this radius, is to be inserted. `bend`: how far the piece's facet is off
  /// one plane. Refinement is about facets that are plane: to this one, a distance below that is none (docs/theory.md, after theorem 5).
  Spacing spacing(const Cavity_3<Tr>& cavity, const Vec_3& m, const Feature_id& on, const auto& vertices, Split_reason reason,
                  const Split_guard& guard, double radius, double bend) const {
    const double d2 = cavity.squared_insertion_radius(m);
    if (is_below_minimum(d2)) return Spacing::below_minimum;
    if (reason != Split_reason::missing && guard.size == 0 && d2 < bend * bend) return Spacing::too_close;
    const double floor2 = squared_floor(vertices, guard);
    if (reason == Split_reason::missing || d2 >= floor2 || squared_distance(cavity, m, on) >= floor2) return Spacing::wide_enough;
    return is_near_angle(m, guard, radius) ? Spacing::too_close : Spacing::wide_enough;
  }

  /// Whether it is certainly too close, by the vertices of the piece alone, which count always: where the mesh is not graded, the cavity of a
  /// point has tens of thousands of tetrahedra, and as many vertices ask for the same split.
  bool is_too_close(const Vec_3& m, const auto& vertices, Split_reason reason, const Split_guard& guard, double radius) const {
    if (reason == Split_reason::missing) return false;
    const double floor2 = squared_floor(vertices, guard);
    return std::ranges::any_of(vertices, [&](const auto& v) { return pgdr::squared_distance(m, position(v)) < floor2; }) &&
           is_near_angle(m, guard, radius);
  }

 private:
  double squared_floor(const auto& vertices, const Split_guard& guard) const {
    const double floor = is_apart(vertices, guard) ? guard.floor_apart : guard.floor;
    return floor * floor * (1 - 1e-9);
  }

  bool is_near_angle(const Vec_3& m, const Split_guard& guard, double radius) const {
    if (guard.is_strict) return true;
    if (guard.count == 0) return acute_.contains(m, std::max(guard.reach, 4 * radius));
    return guard.is_near(acute_);
  }

  /// Whether a piece has none of the vertices in which the features of the guard's edge meet.
  bool is_apart(const auto& vertices, const Split_guard& guard) const {
    return guard.floor_apart > 0 && std::ranges::none_of(vertices, [&](typename Tr::Vertex_handle v) {
      return v->in_dimension() == 0 && acute_.meet_at(v->index(), guard.meeting[0], guard.meeting[1]);
    });
  }

  const Acute_neighborhood_3& acute_;
  double squared_min_edge_;
};

}  // namespace pgdr

#endif
