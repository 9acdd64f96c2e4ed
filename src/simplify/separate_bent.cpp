// SPDX-License-Identifier: GPL-3.0-or-later
#include "separate_bent.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/vec_3.h>

#include "narrow_corners.h"

namespace pgdr::simplify_detail {

namespace {

/// In units of the group's diagonal: what is closer to a plane than that is in it.
constexpr double plane = 1e-10;

/// Of the narrow corners of a group that is taken apart, in `halvings`. Of a sphere with a bore, whose facets need up to 12.5, 102,149 tetrahedra are made in 4 seconds with 16,
/// and with 8 there is no end; a block of 66,000 has 83,000 with 16, 126,000 with 24 and 329,000 with 32.
constexpr double most_halvings = 16;
/// Where a group falls into more pieces, the steps between them are as hard as the group: the wing section (a30), with one of 20 taken apart, has no end.
constexpr std::size_t most_pieces = 8;

}  // namespace

Plc separated(Plc plc, const std::vector<std::vector<Index>>& bent, bool triangulate) {
  for (const std::vector<Index>& group : bent) {
    if (group.size() < 2) continue;
    // Only the vertices that they have: there may be many groups.
    Plc part;
    part.exponent = plc.exponent;
    std::vector<Index> vertices;
    for (const Index f : group)
      for (const auto& polygon : plc.facets[f].polygons) vertices.insert(vertices.end(), polygon.begin(), polygon.end());
    domain_detail::sort_unique(vertices);
    for (const Index v : vertices) part.vertices.push_back(plc.vertices[v]);
    for (const Index f : group) {
      part.facets.push_back(plc.facets[f]);
      for (auto& polygon : part.facets.back().polygons)
        for (Index& v : polygon) v = static_cast<Index>(std::ranges::lower_bound(vertices, v) - vertices.begin());
    }
    const Domain_3<Default_kernel> apart = make_domain_3(part, plane, triangulate);
    std::vector<Vec_3> points;
    for (const auto& p : apart.vertices) points.push_back(to_vec(p));
    double narrow = 0;
    for (const auto& corner : domain_detail::Facet_edges(apart).corners(points)) narrow += halvings(corner.angle_deg);
    if (narrow > most_halvings || apart.facets.size() > most_pieces) continue;
    for (const auto& s : apart.segments) plc.segments.push_back({vertices[apart.input_vertex[s.vertices[0]]], vertices[apart.input_vertex[s.vertices[1]]], 0});
  }
  return plc;
}

}  // namespace pgdr::simplify_detail
