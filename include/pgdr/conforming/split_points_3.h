// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_SPLIT_POINTS_3_H
#define PGDR_CONFORMING_SPLIT_POINTS_3_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/acute/protected_balls_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/feature_request.h>
#include <pgdr/conforming/split_point_3.h>
#include <pgdr/mesh/triangle_ball.h>

namespace pgdr {

/// Where the pieces of a complex are split: subsegments in the middle or on a shell, subfacets at their circumcenter, neither
/// inside a protected ball.
template <class Tr>
class Split_points_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Vertex_handle = typename Tr::Vertex_handle;

  Split_points_3(const Complex& complex, const Acute_neighborhood_3& acute) : complex_(complex), acute_(acute) {}

  /// Whether subsegments at v are split on shells: where segments meet at a small angle, or cross each other across a gap.
  bool is_acute(Vertex_handle v) const { return has_ball(v) || v->is_crossing(); }

  Vec_3 of_subsegment(std::uint32_t slot) const {
    const auto& ends = complex_.subsegment(slot).vertices;
    double shell = 0, factor = 1;
    for (const Vertex_handle end : ends)
      if (has_ball(end)) {
        shell = acute_.balls().radius(end->index());
        factor = acute_.shells().factor(complex_.subsegment(slot).segment, end->index());
      }
    return subsegment_split_point(position(ends[0]), position(ends[1]), is_acute(ends[0]), is_acute(ends[1]), shell, factor);
  }

  Vec_3 of_subfacet(std::uint32_t slot, Split_reason reason) const {
    // Off the center of cocircular vertices, or the next points would be cocircular again.
    Vec_3 m = reason == Split_reason::flat ? towards_centroid(slot, 0.2) : circumcenter(slot);
    if (const Index v = ball_around(slot, m); v != Protected_balls_3::none) m = acute_.balls().on_sphere(v, m);
    return complex_.on_plane(complex_.subfacet(slot).facet, m);
  }

  /// Where a subsegment may be split for another reason: at a share of its length, but from an acute corner on at its shell only.
  Vec_3 on_subsegment(std::uint32_t slot, double share) const {
    const auto& ends = complex_.subsegment(slot).vertices;
    if (is_acute(ends[0]) || is_acute(ends[1])) return of_subsegment(slot);
    return (1 - share) * position(ends[0]) + share * position(ends[1]);
  }

  /// The same of a subfacet: at a share of the way from its circumcenter to its centroid.
  Vec_3 on_subfacet(std::uint32_t slot, double share) const {
    return complex_.on_plane(complex_.subfacet(slot).facet, towards_centroid(slot, share));
  }

  /// The midpoint of the longest edge of a subfacet, on its facet's plane, and the subsegment that this edge is, or none.
  std::pair<Vec_3, std::uint32_t> on_longest_edge(std::uint32_t slot) const {
    const auto& t = complex_.subfacet(slot);
    const auto squared_length = [&](std::size_t i) {
      return squared_distance(position(t.vertices[(i + 1) % 3]), position(t.vertices[(i + 2) % 3]));
    };
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (squared_length(i) > squared_length(longest)) longest = i;
    const Vec_3 m = 0.5 * (position(t.vertices[(longest + 1) % 3]) + position(t.vertices[(longest + 2) % 3]));
    const std::uint32_t n = t.neighbors[longest];
    return {complex_.on_plane(t.facet, m), n & Complex::subsegment_bit ? n & ~Complex::subsegment_bit : Complex::none};
  }

  /// Whether all of a subsegment lies in the protected ball of one of its ends: it is not split.
  bool is_subsegment_protected(std::uint32_t slot) const {
    const auto& ends = complex_.subsegment(slot).vertices;
    const auto protects = [&](Vertex_handle center, Vertex_handle other) {
      return has_ball(center) && acute_.balls().contains_segment(center->index(), position(other));
    };
    return protects(ends[0], ends[1]) || protects(ends[1], ends[0]);
  }

  /// Whether the circumcenter of a subfacet lies in a protected ball: it is split only if it is missing, on the sphere.
  bool is_subfacet_protected(std::uint32_t slot) const {
    return ball_around(slot, circumcenter(slot)) != Protected_balls_3::none;
  }

 private:
  bool has_ball(Vertex_handle v) const { return v->in_dimension() == 0 && acute_.is_acute_vertex(v->index()); }

  /// At a share of the way from a subfacet's circumcenter.
  Vec_3 towards_centroid(std::uint32_t slot, double share) const {
    const auto& v = complex_.subfacet(slot).vertices;
    return (1 - share) * circumcenter(slot) + (share / 3) * (position(v[0]) + position(v[1]) + position(v[2]));
  }

  Vec_3 circumcenter(std::uint32_t slot) const {
    const auto& v = complex_.subfacet(slot).vertices;
    return triangle_circumcenter(position(v[0]), position(v[1]), position(v[2]));
  }

  /// The vertex of the subfacet's facet in whose ball its circumcenter m is, or none.
  Index ball_around(std::uint32_t slot, const Vec_3& m) const {
    const auto& t = complex_.subfacet(slot);
    const Index v = acute_.balls().find(m, squared_distance(m, position(t.vertices[0])));
    return std::ranges::binary_search(complex_.domain().facets[t.facet].vertices, v) ? v : Protected_balls_3::none;
  }

  const Complex& complex_;
  const Acute_neighborhood_3& acute_;
};

}  // namespace pgdr

#endif
