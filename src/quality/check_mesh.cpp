// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/mesh/scale_mesh.h>
#include <pgdr/quality/check_mesh.h>

#include <algorithm>
#include <iterator>

#include "check_parts.h"

namespace pgdr {

std::vector<Check_line> check_mesh(const Indexed_mesh_3& mesh, const Domain_3<Default_kernel>* domain,
                                   const Check_options& options) {
  namespace q = quality_detail;
  const int exponent = domain != nullptr ? domain->exponent : mesh.exponent + exponent_for(mesh);
  if (exponent != mesh.exponent) return check_mesh(scaled_to(mesh, exponent), domain, options);
  std::vector<Check_line> lines{q::check_indices(mesh, options.most_tetrahedra)};
  if (!lines[0].passed) return lines;
  lines.push_back(q::check_vertices(mesh));
  lines.push_back(q::check_duplicates(mesh));
  lines.push_back(q::check_orientation(mesh));
  std::vector<Check_line> domain_lines;
  {
    const q::Face_table faces(mesh);
    lines.push_back(q::check_faces(mesh, faces));
    lines.push_back(q::check_boundary(mesh, faces));
    lines.push_back(q::check_edges(mesh));
    lines.push_back(q::check_overlap(mesh, faces));
    if (domain != nullptr) {
      const Volumes_3<Epick> volumes(*domain);
      const q::Expected expected = q::expected_of(*domain, volumes);
      const std::vector<std::uint32_t> matched = q::match_vertices(mesh, *domain);
      domain_lines.push_back(q::check_input_vertices(mesh, *domain, expected, matched));
      for (auto& line : q::check_facets(mesh, *domain, expected)) domain_lines.push_back(std::move(line));
      domain_lines.push_back(q::check_segments(mesh, *domain, expected, matched));
      for (auto& line : q::check_regions(mesh, faces, *domain, volumes))
        domain_lines.push_back(std::move(line));
    }
  }  // the face table goes before the reference triangulation comes
  lines.push_back(q::check_delaunay(mesh));
  std::move(domain_lines.begin(), domain_lines.end(), std::back_inserter(lines));
  for (auto& line : q::check_shapes(mesh, domain, options)) lines.push_back(std::move(line));
  return lines;
}

bool all_passed(const std::vector<Check_line>& lines) {
  return std::all_of(lines.begin(), lines.end(), [](const Check_line& line) { return line.passed; });
}

}  // namespace pgdr
