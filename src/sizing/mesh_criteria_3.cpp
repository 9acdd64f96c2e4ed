// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/mesh_criteria_3.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/sizing/curvature_sizes.h>
#include <pgdr/sizing/facet_sizes.h>
#include <pgdr/sizing/local_feature_sizes.h>

namespace pgdr {
namespace {

bool is_bound(double size, const char* what) {
  if (!(size > 0)) throw std::invalid_argument(std::string(what) + " must be positive");
  return size < Mesh_criteria_3::unbounded;
}

}  // namespace

Combined_sizing_field sizing_of(const Mesh_criteria_3& criteria, const Domain_3<Default_kernel>& domain) {
  is_bound(criteria.cell_size.radius(), "the cell size");
  const double largest = criteria.cell_size.radius();
  std::vector<Distance_sizing_field> fields;
  // An edge is no longer than twice the circumradius of a tetrahedron that has it.
  const auto bound_edges = [&](double length, const std::vector<int>& markers) {
    if (is_bound(length, "the edge size")) fields.push_back(segment_sizes(domain, markers, length / 2, criteria.gradation, largest));
  };
  const auto bound_facets = [&](double radius, const std::vector<int>& markers) {
    if (!is_bound(radius, "the facet size")) return;
    fields.push_back(markers.empty() ? sizes_around(domain, facet_triangles_of(domain), radius, criteria.gradation, largest)
                                     : facet_sizes(domain, markers, radius, criteria.gradation, largest));
  };
  bound_edges(criteria.edge_size, {});
  for (const auto& [marker, length] : criteria.curve_sizes) bound_edges(length, {marker});
  bound_facets(criteria.facet_size, {});
  for (const auto& [marker, radius] : criteria.patch_sizes) bound_facets(radius, {marker});

  const auto add = [&fields](std::vector<Distance_sizing_field> more) { std::ranges::move(more, std::back_inserter(fields)); };
  if (criteria.edges_per_turn != 0) add(curvature_sizes(domain, criteria.edges_per_turn, criteria.gradation, largest));
  if (criteria.cells_across != 0) add(local_feature_sizes(domain, criteria.cells_across, criteria.gradation, largest));

  std::vector<Combined_sizing_field::Function> functions;
  if (const auto& field = criteria.cell_size.field()) functions = Combined_sizing_field::of(field).functions();
  return Combined_sizing_field(Combined_sizing_field::Local(Uniform_sizing_field(largest)), std::move(fields), std::move(functions));
}

}  // namespace pgdr
