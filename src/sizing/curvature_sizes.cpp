// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/curvature_sizes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include <pgdr/domain/detail/facet_edges.h>
#include <pgdr/domain/scale.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/sizing/edge_length.h>
#include <pgdr/sizing/facet_sizes.h>

namespace pgdr {

namespace {

using Domain = Domain_3<Default_kernel>;

/// The triangles of curved surfaces.
/// \param size_per_radius sizes in units of the radius of curvature
std::vector<Sized_triangle> bends(const Domain& domain, double size_per_radius) {
  const domain_detail::Facet_edges edges(domain);
  const std::vector<double> angles = dihedral_angles_3(domain, edges);
  const auto point = [&](Index v) { return to_vec(domain.vertices[v]); };
  std::vector<Sized_triangle> result;
  for (std::size_t s = 0; s < domain.segments.size(); ++s) {
    const double turn = 180 - angles[s];
    const auto sheets = edges.sheets(s);
    if (sheets.size() != 2 || !(turn > 0) || turn > feature_angle_deg) continue;
    const auto [a, b] = domain.segments[s].vertices;
    double heights = 0;
    for (const auto& sheet : sheets)
      for (const Index v : domain.facets[sheet.facet].triangles[sheet.triangle])
        if (v != a && v != b) heights += std::sqrt(squared_distance_to_line(point(v), point(a), point(b)));
    const double size = unit_of(domain) * size_per_radius * heights / (2 * turn * std::numbers::pi / 180);
    if (!(size > 0 && std::isfinite(size))) continue;
    for (const auto& sheet : sheets) result.push_back({facet_triangle_of(domain, domain.facets[sheet.facet].triangles[sheet.triangle]), size});
  }
  return result;
}

}  // namespace

std::vector<Distance_sizing_field> curvature_sizes(const Domain& domain, double edges_per_turn, double gradation, double largest) {
  if (!(edges_per_turn > 0 && std::isfinite(edges_per_turn))) throw std::invalid_argument("the number of edges around a turn has to be positive and finite");
  return sizes_around_each(domain, bends(domain, 2 * std::numbers::pi / edges_per_turn / mean_edge), gradation, largest);
}

}  // namespace pgdr
