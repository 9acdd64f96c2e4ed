// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/facet_triangles.h>

#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/make_domain_3.h>

namespace pgdr {

std::vector<Facet_triangle> facet_triangles(const Plc& plc) {
  std::vector<Facet_triangle> triangles;
  Plc others;  // each with a marker of its own, so that none are fused
  std::vector<Index> facet_of;
  for (Index f = 0; f < plc.facets.size(); ++f) {
    const auto& polygons = plc.facets[f].polygons;
    if (polygons.size() == 1 && polygons[0].size() == 3) {
      triangles.push_back({{polygons[0][0], polygons[0][1], polygons[0][2]}, f});
    } else {
      others.facets.push_back({polygons, plc.facets[f].holes, static_cast<int>(facet_of.size())});
      facet_of.push_back(f);
    }
  }
  if (facet_of.empty()) return triangles;
  others.vertices = plc.vertices;
  constexpr double tolerance = 1e-6;  // how far polygons may be from plane, as everywhere
  const Domain_3<Default_kernel> domain = make_domain_3(others, tolerance, true);
  for (const auto& facet : domain.facets)
    for (const auto& t : facet.triangles)
      triangles.push_back({{domain.input_vertex[t[0]], domain.input_vertex[t[1]], domain.input_vertex[t[2]]}, facet_of[static_cast<std::size_t>(facet.marker)]});
  return triangles;
}

}  // namespace pgdr
