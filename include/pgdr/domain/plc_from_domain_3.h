// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_PLC_FROM_DOMAIN_3_H
#define PGDR_DOMAIN_PLC_FROM_DOMAIN_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/detail/facet_edges.h>
#include <pgdr/domain/detail/planar_triangulation.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/plc.h>
#include <pgdr/domain/volumes_3.h>

namespace pgdr {

namespace domain_detail {

/// Chains directed edges into closed loops in which no vertex repeats, each from its smallest vertex on.
inline std::vector<std::vector<Index>> closed_loops(std::vector<Index_pair> edges) {
  std::sort(edges.begin(), edges.end());
  std::vector<char> taken(edges.size(), 0);
  const auto take_from = [&](Index v) -> std::optional<Index> {
    auto e = std::lower_bound(edges.begin(), edges.end(), Index_pair{v, 0});
    for (; e != edges.end() && (*e)[0] == v; ++e)
      if (char& t = taken[static_cast<std::size_t>(e - edges.begin())]; !t) {
        t = 1;
        return (*e)[1];
      }
    return std::nullopt;
  };
  std::vector<std::vector<Index>> loops;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (taken[i]) continue;
    std::vector<Index> path{edges[i][0]};
    while (const std::optional<Index> next = take_from(path.back())) {
      const auto seen = std::find(path.begin(), path.end(), *next);
      if (seen == path.end()) {
        path.push_back(*next);
        continue;
      }
      std::vector<Index> loop(seen, path.end());
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      loops.push_back(std::move(loop));
      path.erase(seen + 1, path.end());
    }
  }
  std::sort(loops.begin(), loops.end());
  return loops;
}

/// The polygons of one fused facet: its boundary as loops, internal segments, isolated vertices, hole seeds.
template <class K>
Plc_facet<K> facet_polygons(const Domain_3<K>& domain, std::size_t index, const std::vector<Vec_3>& points) {
  const auto& facet = domain.facets[index];
  Plc_facet<K> result;
  result.marker = facet.marker;
  std::vector<Index_pair> directed, outline, internal;
  for (const auto& t : facet.triangles)
    for (std::size_t i = 0; i < 3; ++i) directed.push_back({t[i], t[(i + 1) % 3]});
  std::sort(directed.begin(), directed.end());
  std::vector<Index_pair> boundary;
  std::vector<char> on_segment(facet.vertices.size(), 0);
  for (Index s : facet.segments) {
    const Index_pair ends = domain.segments[s].vertices, reverse{ends[1], ends[0]};
    const bool forward = contains(directed, ends), backward = contains(directed, reverse);
    if (forward && backward)
      internal.push_back(ends);
    else
      boundary.push_back(forward ? ends : reverse);
    if (forward != backward) outline.push_back(ends);
    for (Index v : ends)
      on_segment[static_cast<std::size_t>(std::lower_bound(facet.vertices.begin(), facet.vertices.end(), v) -
                                          facet.vertices.begin())] = 1;
  }
  result.polygons = closed_loops(boundary);
  if (result.polygons.size() > 1) {
    std::sort(outline.begin(), outline.end());
    Planar_triangulation plane_mesh(points, facet.vertices, to_vec(facet.normal));
    for (const Index_pair& s : outline) plane_mesh.insert_constraint(s[0], s[1]);
    plane_mesh.mark_odd(outline);
    for (const Vec_3& seed : plane_mesh.hole_seeds(outline))
      result.holes.emplace_back(seed.x, seed.y, seed.z);
  }
  for (const Index_pair& s : internal) result.polygons.push_back({s[0], s[1]});
  for (std::size_t i = 0; i < facet.vertices.size(); ++i)
    if (!on_segment[i]) result.polygons.push_back({facet.vertices[i]});
  return result;
}

/// Whether facets `f` and `g` could be taken for one.
template <class K>
bool nearly_coplanar(const Domain_3<K>& domain, Index f, Index g, const std::vector<Vec_3>& points) {
  const auto within = [&](const auto& plane, const auto& other) {
    return std::all_of(other.vertices.begin(), other.vertices.end(), [&](Index v) {
      return std::abs(dot(to_vec(plane.normal), points[v] - to_vec(plane.origin))) <= 4 * domain.tolerance;
    });
  };
  return within(domain.facets[f], domain.facets[g]) || within(domain.facets[g], domain.facets[f]);
}

}  // namespace domain_detail

/// The PLC as understood: fused facets as polygons, and every segment that cannot be inferred from them.
///
/// `make_domain_3` of the result gives the domain again: the same vertices, segments and facets. Nesting is
/// always `Nesting::fill`: volumes left empty by `Nesting::alternate` get hole seeds.
template <class K>
Piecewise_linear_complex_3<K> plc_from_domain_3(const Domain_3<K>& domain) {
  using namespace domain_detail;
  Piecewise_linear_complex_3<K> plc;
  plc.vertices = domain.vertices;
  if (std::any_of(domain.vertex_markers.begin(), domain.vertex_markers.end(), [](int m) { return m != 0; }))
    plc.vertex_markers = domain.vertex_markers;
  plc.holes = domain.holes;
  plc.regions = domain.regions;
  plc.exponent = domain.exponent;
  plc.first_index = domain.first_index;
  plc.names = domain.names;
  std::vector<Vec_3> points;
  for (const auto& p : domain.vertices) points.push_back(to_vec(p));

  for (std::size_t f = 0; f < domain.facets.size(); ++f)
    plc.facets.push_back(facet_polygons(domain, f, points));
  for (const auto& s : domain.segments) {
    const bool kept_apart = s.facets.size() == 2 &&
                            domain.facets[s.facets[0]].marker == domain.facets[s.facets[1]].marker &&
                            nearly_coplanar(domain, s.facets[0], s.facets[1], points);
    if (s.facets.empty() || s.marker != 0 || kept_apart)
      plc.segments.push_back({s.vertices[0], s.vertices[1], s.marker});
  }
  if (domain.nesting == Nesting::alternate) {
    const Volumes_3<K> volumes(domain);
    for (std::size_t v = 0; v < volumes.volumes().size(); ++v) {
      const Volume& volume = volumes.volumes()[v];
      if (volume.outside || volume.material || volume.is_hole) continue;
      if (const auto seed = volumes.interior_point(v)) plc.holes.emplace_back(seed->x, seed->y, seed->z);
    }
  }
  return plc;
}

// Compiled in the library.
extern template Plc plc_from_domain_3(const Domain_3<Default_kernel>&);
}  // namespace pgdr

#endif
