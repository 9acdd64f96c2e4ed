// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <pgdr/refine_mesh_3.h>
#include <pgdr/sizing/uniform_sizing_field.h>

int main() {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  pgdr::Piecewise_linear_complex_3<Kernel> cube;
  for (int i = 0; i < 8; ++i) cube.vertices.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  using Polygon = std::vector<pgdr::Index>;
  for (const Polygon& side : {Polygon{0, 2, 3, 1}, Polygon{4, 5, 7, 6}, Polygon{0, 1, 5, 4},
                              Polygon{2, 6, 7, 3}, Polygon{0, 4, 6, 2}, Polygon{1, 3, 7, 5}})
    cube.facets.push_back({{side}, {}, 0});
  const auto mesh = pgdr::refine_mesh_3(cube, pgdr::Uniform_sizing_field(0.5));
  return mesh.statistics().stop == pgdr::Stop_reason::finished && mesh.statistics().steiner_points > 0 ? 0 : 1;
}
