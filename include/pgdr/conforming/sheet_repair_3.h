// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_SHEET_REPAIR_3_H
#define PGDR_CONFORMING_SHEET_REPAIR_3_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/conforming/sheet_walk_3.h>
#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/mesh/territory_3.h>

namespace pgdr {

// What goes on where the circumcircle of a subfacet holds vertices of its own facet. In a plane the circle of what a Delaunay triangulation
// shows is empty. In a bent facet, one that was fused of near-coplanar ones, vertices are off the plane, and may be out of the ball though
// they are in the circle; what was made around them then is not Delaunay in the plane.

/// Whether a subsegment between a subfacet and its circumcenter is encroached by either, so that to split it helps. It always is if the circle
/// is empty (see `walk_in_sheet`); else the pieces at the crossing would be halved for ever.
template <class Subsegment, class Subfacet, class Point>
bool is_in_the_way(const Subsegment& s, const Subfacet& t, const Point& center) {
  return is_encroached(s, center) || std::ranges::any_of(t.vertices, [&](auto v) {
           return v != s.vertices[0] && v != s.vertices[1] && is_encroached(s, v->point());
         });
}

/// Where a subfacet is split if such a subsegment is not in the way: halfway from its middle to where the straight way to the circumcenter
/// crosses. That is inside the circle, too.
template <class Subsegment, class Subfacet>
Vec_3 point_before(const Subsegment& s, const Subfacet& t, const Vec_3& center) {
  const auto distance = [&](const Vec_3& p) {
    return std::sqrt(squared_distance_to_line(p, position(s.vertices[0]), position(s.vertices[1])));
  };
  const Vec_3 middle = barycenter(t);
  const double before = distance(middle), beyond = distance(center);
  return before + beyond > 0 ? middle + (0.5 * before / (before + beyond)) * (center - middle) : middle;
}

/// A neighbor of a missing subfacet of a bent facet with which it is not locally Delaunay, as seen along the normal of their facet,
/// so that their edge is to be flipped: a point at its circumcenter could be where that neighbor's side of the sheet has vertices
/// already. None if there is none, or it is not own; one that is there itself only if `any`. Each flip is one of Lawson's, which
/// in a plane come to an end.
template <class Tr>
std::uint32_t neighbor_to_flip(const Constraint_complex_3<Tr>& complex, std::uint32_t slot, const Territory_3<Tr>& territory,
                               bool any) {
  using Complex = Constraint_complex_3<Tr>;
  constexpr double rounding = 1e-9;  // radians: cocircular vertices are left as they are
  const auto& t = complex.subfacet(slot);
  const auto& plane = complex.plane(t.facet);
  if (!complex.is_bent(t.facet) || !territory.owns(t.vertices)) return Complex::none;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t n = t.neighbors[i];
    if ((n & Complex::subsegment_bit) || !territory.owns(complex.subfacet(n).vertices)) continue;
    if (complex.subfacet(n).present && !any) continue;
    const auto a = t.vertices[i], b = t.vertices[(i + 1) % 3], c = t.vertices[(i + 2) % 3];
    const auto d = complex.subfacet(n).vertices[static_cast<std::size_t>(complex.edge_with_neighbor(n, slot))];
    const auto angle_at = [&](auto v) {
      const Vec_3 p = plane.project(position(v)), e = plane.project(position(b)) - p, f = plane.project(position(c)) - p;
      return arc_tangent(length(cross(e, f)), dot(e, f));
    };
    if (angle_at(a) + angle_at(d) > std::numbers::pi + rounding &&
        complex.orientation(t.facet, a->point(), b->point(), d->point()) == CGAL::POSITIVE &&
        complex.orientation(t.facet, d->point(), c->point(), a->point()) == CGAL::POSITIVE)
      return n;
  }
  return Complex::none;
}

}  // namespace pgdr

#endif
