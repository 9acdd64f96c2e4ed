// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_SUMMARIZE_DOMAIN_3_H
#define PGDR_DOMAIN_SUMMARIZE_DOMAIN_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/detail/facet_edges.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/input_error.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/domain/volumes_3.h>

namespace pgdr {

/// What there is to know about a domain before it is meshed.
struct Domain_summary {
  std::size_t vertices = 0;            ///< distinct
  std::size_t duplicate_vertices = 0;  ///< merged into others
  std::size_t segments = 0;
  std::size_t facets = 0;        ///< after fusing
  std::size_t input_facets = 0;  ///< that facets were made of
  std::size_t fused_facets = 0;  ///< facets made of several input facets
  std::size_t triangles = 0;     ///< of all facets

  std::array<double, 3> lower{};  ///< of the bounding box
  std::array<double, 3> upper{};
  double diagonal = 0;   ///< of the bounding box
  double tolerance = 0;  ///< absolute distance within which facets were fused

  bool closed = false;                 ///< some volume is enclosed; false too where facets intersect
  std::size_t open_edges = 0;          ///< segments with a facet on one side only
  std::size_t non_manifold_edges = 0;  ///< segments where more than two sheets meet
  double smallest_dihedral_deg = 180;
  double smallest_plane_angle_deg = 180;
  double smallest_vertex_angle_deg = 180;  ///< see `Small_angles::vertex_deg`
  std::size_t plane_corners_below_14_48 = 0;

  std::vector<Volume> volumes;  ///< the outside first; empty where facets intersect
  double material_volume = 0;
  std::vector<Input_problem> problems;  ///< of `validate_domain_3`
};

/// Gathers all of a domain's summary.
/// \param max_pairs see `validate_domain_3`.
/// \param known what `validate_domain_3` has found before, which is not looked for again then
template <class K>
Domain_summary summarize_domain_3(const Domain_3<K>& domain, std::size_t max_pairs = 10, const std::vector<Input_problem>* known = nullptr) {
  using namespace domain_detail;
  Domain_summary result;
  result.vertices = domain.vertices.size();
  result.duplicate_vertices = domain.duplicate_vertices;
  result.segments = domain.segments.size();
  result.facets = domain.facets.size();
  const double unit = unit_of(domain);
  for (std::size_t k = 0; k < 3; ++k) {
    result.lower[k] = unit * domain.lower[k];
    result.upper[k] = unit * domain.upper[k];
  }
  result.diagonal = unit * domain.diagonal;
  result.tolerance = unit * domain.tolerance;

  std::vector<Index> inputs;
  for (const auto& f : domain.facets) {
    inputs.insert(inputs.end(), f.input_facets.begin(), f.input_facets.end());
    result.triangles += f.triangles.size();
    if (f.input_facets.size() > 1) ++result.fused_facets;
  }
  std::sort(inputs.begin(), inputs.end());
  result.input_facets = static_cast<std::size_t>(std::unique(inputs.begin(), inputs.end()) - inputs.begin());

  const Facet_edges edges(domain);
  for (std::size_t s = 0; s < domain.segments.size(); ++s) {
    if (edges.sheets(s).size() == 1) ++result.open_edges;
    if (edges.sheets(s).size() > 2) ++result.non_manifold_edges;
  }
  const Small_angles angles = small_angles_3(domain);
  result.smallest_dihedral_deg = angles.smallest_dihedral_deg;
  result.smallest_plane_angle_deg = angles.smallest_plane_angle_deg;
  result.plane_corners_below_14_48 = angles.plane_corners_below_14_48;
  for (double a : angles.vertex_deg)
    result.smallest_vertex_angle_deg = std::min(result.smallest_vertex_angle_deg, a);

  if (domain.facets.empty()) {
    result.problems = validate_domain_3(domain, max_pairs);
    return result;
  }
  if (known)
    result.problems = *known;
  else
    report_intersections(domain, max_pairs, result.problems);
  if (std::ranges::any_of(result.problems, [](const Input_problem& problem) { return problem.kind == Input_problem::Kind::self_intersection; })) return result;
  const Volumes_3<K> volumes(domain);
  if (!known) report_volumes(domain, volumes, max_pairs, result.problems);
  result.closed = volumes.closed();
  result.volumes = volumes.volumes();
  result.material_volume = std::ldexp(volumes.total_material_volume(), 3 * domain.exponent);
  for (Volume& v : result.volumes) {
    v.volume = std::ldexp(v.volume, 3 * domain.exponent);
    v.max_volume = std::ldexp(v.max_volume, 3 * domain.exponent);
    v.max_circumradius = std::ldexp(v.max_circumradius, domain.exponent);
  }
  return result;
}

// Compiled in the library.
extern template Domain_summary summarize_domain_3(const Domain_3<Default_kernel>&, std::size_t, const std::vector<Input_problem>*);
}  // namespace pgdr

#endif
