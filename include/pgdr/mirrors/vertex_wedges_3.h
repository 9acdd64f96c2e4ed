// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MIRRORS_VERTEX_WEDGES_3_H
#define PGDR_MIRRORS_VERTEX_WEDGES_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <pgdr/domain/bend.h>
#include <pgdr/domain/detail/facet_edges.h>
#include <pgdr/domain/detail/have_common.h>
#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/feature_id.h>
#include <pgdr/domain/region_3.h>
#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mirrors/crossing_3.h>
#include <pgdr/mirrors/mirror_image.h>
#include <pgdr/mirrors/turn_3.h>

namespace pgdr {

/// What meets a facet in a vertex, without a segment there in common, and is close above it: other facets and segments.
///
/// Two such facets are turned onto each other about the line in which their planes meet (`Turn_3`), and a segment onto a facet about the line that is in the
/// facet's plane and at a right angle to the segment. Then, with unit vectors u along the segment and w along its projection and the center c of a ball of
/// a subfacet, |d u - c|^2 = |d w - c|^2 + 2 d (1 - uw) cw: a vertex d u is in no ball before which the vertex of the domain lies behind. And a
/// point f of the facet is in the diametral ball of a subsegment from a u to b u only if it is in that of a w and b w, as (f - a u)(f - b u) =
/// (f - a w)(f - b w) + (a + b)(1 - uw) fw. So nothing between the two has to be as short as the gap, which gets as narrow as one likes.
class Vertex_wedges_3 {
 public:
  template <class K>
  Vertex_wedges_3(const Domain_3<K>& domain, const Small_angles& angles)
      : of_segment_(domain.segments.size()), of_facet_(domain.facets.size()) {
    const auto is_narrow = [](double degrees) { return degrees < Small_angles::critical_plane_angle_deg; };
    if (std::ranges::none_of(angles.vertex_deg, is_narrow)) return;
    boxes_ = facet_boxes(domain);
    const domain_detail::Vertex_features features(domain);
    for (Index v = 0; v < domain.vertices.size(); ++v)
      if (is_narrow(angles.vertex_deg[v])) add(domain, features, v);
  }

  /// Calls `found` with each image of m, a point on the segment or facet with this insertion radius, that is within `distance` of it: in the plane of a facet, and in
  /// its bounding box.
  template <class Found>
  void for_each_image(const Feature_id& on, const Vec_3& m, double radius, double distance, const Found& found) const {
    for (const Wedge& w : wedges(on))
      if (const auto at = w.turn.image(m, radius, distance); at && boxes_[w.lower].contains_closed(*at)) found(Mirror_image{{2, w.lower}, *at});
  }

  /// Segments of such facets that cross each other.
  const std::vector<Crossing_3>& crossings() const { return crossings_; }

  /// Whether two segments or facets are such a pair.
  bool are_close(const Feature_id& a, const Feature_id& b) const { return is_above(a, b) || is_above(b, a); }

 private:
  /// The sine of the angle up to which images pay: of facets, as far as no triangle in the corner has the bound of 2, and of segments, whose images are one more point where
  /// the facet would do with none. Table in docs/robustness.md.
  static constexpr double most_between_facets = 0.25, most_over_facet = 0.035;
  /// And from which on: below, what like places leave to images comes close to rounding.
  static constexpr double least = 1e-5;
  /// How wide the part of a corner is, in units of that sine, in which a facet has another one above it: in a narrower one all points are as close to
  /// its sides as to the other facet.
  static constexpr double wide = 10;
  /// How close segments are where they cross, of the distance from their ends.
  static constexpr double close = 0.25;

  struct Wedge {
    Index lower;  ///< the facet that is turned onto
    Turn_3 turn;
  };

  /// A triangle of a facet at a vertex.
  struct Corner {
    Index facet;
    Vec_3 normal;                ///< of the facet's plane
    std::array<Vec_3, 2> sides;  ///< unit vectors
  };
  using Corners = std::span<const Corner>;

  /// The facets at a vertex.
  struct Star {
    template <class K>
    Star(const Domain_3<K>& domain, const domain_detail::Vertex_features& features, Index v) : origin(to_vec(domain.vertices[v])) {
      for (const auto& [f, t] : features.triangles(v)) {
        const auto& triangle = domain.facets[f].triangles[t];
        const std::size_t k = triangle[0] == v ? 0 : triangle[1] == v ? 1 : 2;
        corners.push_back({f, to_vec(domain.facets[f].normal), {towards(domain, triangle[(k + 1) % 3]), towards(domain, triangle[(k + 2) % 3])}});
      }
      for (auto first = corners.begin(); first != corners.end();) {
        const auto last = std::find_if(first, corners.end(), [&](const Corner& c) { return c.facet != first->facet; });
        facets.emplace_back(first, last);
        first = last;
      }
      for (const Index s : features.segments(v))
        for (const Index f : domain.segments[s].facets)
          for (const Index g : domain.segments[s].facets) joined.emplace_back(f, g);
      std::ranges::sort(joined);
    }
    Star(const Star&) = delete;
    Star& operator=(const Star&) = delete;

    template <class K>
    Vec_3 towards(const Domain_3<K>& domain, Index w) const {
      return domain_detail::normalized(to_vec(domain.vertices[w]) - origin);
    }
    /// Whether two facets have a segment here in common.
    bool are_joined(Index f, Index g) const { return std::ranges::binary_search(joined, std::pair(f, g)); }

    Vec_3 origin;
    std::vector<Corner> corners;  ///< those of each facet one after the other
    std::vector<Corners> facets;
    std::vector<std::pair<Index, Index>> joined;
  };

  template <class K>
  void add(const Domain_3<K>& domain, const domain_detail::Vertex_features& features, Index v) {
    const Star star(domain, features, v);
    for (const Corners& f : star.facets)
      for (const Corners& g : star.facets)
        if (f.front().facet < g.front().facet) add_facets(domain, star, f, g);
    for (const Index s : features.segments(v)) {
      const auto& segment = domain.segments[s];
      const Index other = segment.vertices[segment.vertices[0] == v ? 1 : 0];
      const Vec_3 along = star.towards(domain, other);
      for (const Corners& f : star.facets) {
        if (!is_over(along, f) || is_bent(domain, f)) continue;
        const Index facet = f.front().facet;
        const auto is_at_it = [&](Index g) { return star.are_joined(g, facet) || has(of_facet_[g], facet); };
        const auto& ends = domain.facets[facet].vertices;
        if (std::ranges::none_of(segment.facets, is_at_it) && std::ranges::find(ends, other) == ends.end()) add_segment(star.origin, s, along, f);
      }
    }
  }

  static bool has(const std::vector<Wedge>& wedges, Index lower) {
    return std::ranges::any_of(wedges, [&](const Wedge& w) { return w.lower == lower; });
  }

  template <class K>
  void add_facets(const Domain_3<K>& domain, const Star& star, const Corners& f, const Corners& g) {
    const Vec_3 n = f.front().normal, m = g.front().normal, along = cross(n, m);
    const double sine = length(along);
    if (!(least < sine && sine < most_between_facets) || star.are_joined(f.front().facet, g.front().facet)) return;
    double overlap = 0;
    for (const Corner& a : f)
      for (const Corner& b : g) overlap += common_angle(a, b);
    if (overlap < wide * sine || is_bent(domain, f) || is_bent(domain, g)) return;
    // On either side of the line.
    const Vec_3 u = domain_detail::normalized(cross(n, along)), w = (dot(n, m) < 0 ? -1.0 : 1.0) * domain_detail::normalized(cross(m, along));
    for (const double side : {1.0, -1.0}) {
      of_facet_[f.front().facet].push_back({g.front().facet, Turn_3(star.origin, along, side * u, side * w)});
      of_facet_[g.front().facet].push_back({f.front().facet, Turn_3(star.origin, along, side * w, side * u)});
    }
    for (const Index s : domain.facets[f.front().facet].segments)
      for (const Index t : domain.facets[g.front().facet].segments)
        if (!domain_detail::have_common(domain.segments[s].vertices, domain.segments[t].vertices))
          if (const auto crossing = crossing_3(domain, s, t, close)) crossings_.push_back(*crossing);
  }

  /// Where images are on pieces that are no more in one plane, four of two features can be a flat tetrahedron.
  template <class K>
  static bool is_bent(const Domain_3<K>& domain, const Corners& f) {
    return bend(domain, f.front().facet) > 0;
  }

  /// Whether a direction is that close to the plane of a facet, and its projection in one of the facet's corners.
  static bool is_over(const Vec_3& along, const Corners& f) {
    const double sine = dot(along, f.front().normal);
    if (!(least < std::abs(sine) && std::abs(sine) < most_over_facet)) return false;
    return std::ranges::any_of(f, [&](const Corner& c) {
      const Vec_3 up = cross(c.sides[0], c.sides[1]), projection = along - sine * c.normal;
      return dot(cross(c.sides[0], projection), up) > 0 && dot(cross(projection, c.sides[1]), up) > 0;
    });
  }

  void add_segment(const Vec_3& origin, Index s, const Vec_3& along, const Corners& f) {
    const Vec_3& n = f.front().normal;
    const Vec_3 projection = domain_detail::normalized(along - dot(along, n) * n);
    of_segment_[s].push_back({f.front().facet, Turn_3(origin, cross(n, projection), along, projection)});
  }

  /// The angle, in radians, between the directions that two corners have in common, seen along the normal of the first.
  static double common_angle(const Corner& a, const Corner& b) {
    const double turn = dot(cross(a.sides[0], a.sides[1]), a.normal) < 0 ? -1 : 1;
    const auto angle = [&](const Vec_3& from, const Vec_3& to) { return arc_tangent(turn * dot(cross(from, to), a.normal), dot(from, to)); };
    const bool is_alike = angle(b.sides[0], b.sides[1]) > 0;
    const Vec_3 &first = b.sides[is_alike ? 0 : 1], &last = b.sides[is_alike ? 1 : 0];
    const double start = angle(a.sides[0], first);
    return std::max(0.0, std::min(angle(a.sides[0], a.sides[1]), start + angle(first, last)) - std::max(0.0, start));
  }

  const std::vector<Wedge>& wedges(const Feature_id& upper) const { return upper.dimension == 1 ? of_segment_[upper.index] : of_facet_[upper.index]; }
  bool is_above(const Feature_id& a, const Feature_id& b) const { return b.dimension == 2 && has(wedges(a), b.index); }

  std::vector<std::vector<Wedge>> of_segment_, of_facet_;
  std::vector<Region_3> boxes_;
  std::vector<Crossing_3> crossings_;
};

}  // namespace pgdr

#endif
