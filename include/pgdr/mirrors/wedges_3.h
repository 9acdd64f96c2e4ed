// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MIRRORS_WEDGES_3_H
#define PGDR_MIRRORS_WEDGES_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <pgdr/domain/detail/facet_edges.h>
#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/region_3.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mirrors/mirror_image.h>
#include <pgdr/mirrors/shells_3.h>
#include <pgdr/mirrors/turn_3.h>

namespace pgdr {

/// The pairs of segments that follow each other around a corner of a facet, at less than `limit` degrees.
///
/// A vertex of one of them may lie in the diametral ball of a subsegment of the other, however short that is, unless both have vertices at
/// like distances from the corner. Then none does: with unit vectors u and v along the two, a vertex d v and a subsegment from a u to b u,
/// (d v - a u)(d v - b u) = (d - a)(d - b) + d (a + b)(1 - uv), of which the first part is negative only if d is between a and b. So
/// distances need not be equal: they may differ by a factor of 1 - uv, and do (`Shells_3`).
class Segment_wedges_3 {
 public:
  /// No triangle in a narrower corner has the bound of 2.
  static constexpr double limit = Small_angles::critical_plane_angle_deg;

  template <class K>
  Segment_wedges_3(const Domain_3<K>& domain, const domain_detail::Facet_edges& edges, const Shells_3& shells) : of_segment_(domain.segments.size()) {
    std::vector<Vec_3> points;
    for (const auto& p : domain.vertices) points.push_back(to_vec(p));
    const auto segment = [&](Index facet, Index a, Index b) {
      const auto& list = domain.facets[facet].segments;
      return *std::ranges::find_if(list, [&](Index s) { return domain.segments[s].vertices == std::array{std::min(a, b), std::max(a, b)}; });
    };
    for (const auto& corner : edges.corners(points)) {
      if (!(corner.angle_deg < limit)) continue;
      const Vec_3& origin = points[corner.vertex];
      const auto [a, b] = corner.others;
      const Vec_3 u = domain_detail::normalized(points[a] - origin), v = domain_detail::normalized(points[b] - origin);
      const Index s = segment(corner.facet, corner.vertex, a), t = segment(corner.facet, corner.vertex, b);
      const double chord = length(u - v);
      const double of_s = shells.factor(s, corner.vertex), of_t = shells.factor(t, corner.vertex);
      of_segment_[s].push_back({t, origin, v, length(points[b] - origin), chord, of_t / of_s});
      of_segment_[t].push_back({s, origin, u, length(points[a] - origin), chord, of_s / of_t});
    }
  }

  /// Calls `found` with each image of m, a point of the segment or an end, that is within `distance` of it.
  template <class Found>
  void for_each_image(Index segment, const Vec_3& m, double distance, const Found& found) const {
    for (const Wedge& w : of_segment_[segment]) {
      const double d = length(m - w.origin);
      if (0 < d && d < w.length && w.chord * d <= distance) found(Mirror_image{{1, w.other}, w.origin + w.factor * d * w.along});
    }
  }

 private:
  struct Wedge {
    Index other;
    Vec_3 origin, along;  ///< the corner, and the unit vector from there along the other segment
    double length;        ///< of the other segment
    double chord;         ///< distance between a point and its image, in units of theirs from the corner
    double factor;        ///< between their shells
  };
  std::vector<std::vector<Wedge>> of_segment_;
};

/// The pairs of facets that meet at less than `limit` degrees in a segment, about which each is turned onto the other (`Turn_3`).
class Facet_wedges_3 {
 public:
  static constexpr double limit = 60;
  /// Up to this angle images pay for every point. Between wider facets each is one more point where refinement would do with
  /// none; but what is missing may keep coming back without.
  static constexpr double usual_limit = 30;

  template <class K>
  Facet_wedges_3(const Domain_3<K>& domain, const domain_detail::Facet_edges& edges) : of_facet_(domain.facets.size()), boxes_(facet_boxes(domain)) {
    using namespace domain_detail;
    for (Index s = 0; s < domain.segments.size(); ++s) {
      const auto [a, b] = domain.segments[s].vertices;
      const Vec_3 origin = to_vec(domain.vertices[a]), along = to_vec(domain.vertices[b]) - origin;
      for (const Sheet& f : edges.sheets(s))
        for (const Sheet& g : edges.sheets(s)) {
          const Vec_3 u = normalized(inward(domain, f, along)), v = normalized(inward(domain, g, along));
          const double angle = angle_deg(u, v);
          if (f.facet != g.facet && angle < limit) of_facet_[f.facet].push_back({g.facet, angle < usual_limit, Turn_3(origin, along, u, v)});
        }
    }
  }

  /// Calls `found` with each image of m, a point in the plane of the facet with this insertion radius, that is within `distance` of it. Images may be next
  /// to the other facet instead of on it, but are in its bounding box, which says a lot of a strip. `is_usual`: only where the facets
  /// meet at less than `usual_limit`.
  template <class Found>
  void for_each_image(Index facet, const Vec_3& m, double radius, double distance, bool is_usual, const Found& found) const {
    for (const Wedge& w : of_facet_[facet]) {
      if (is_usual && !w.is_usual) continue;
      if (const auto at = w.turn.image(m, radius, distance); at && boxes_[w.other].contains_closed(*at)) found(Mirror_image{{2, w.other}, *at});
    }
  }

 private:
  struct Wedge {
    Index other;
    bool is_usual;
    Turn_3 turn;
  };
  std::vector<std::vector<Wedge>> of_facet_;
  std::vector<Region_3> boxes_;
};

}  // namespace pgdr

#endif
