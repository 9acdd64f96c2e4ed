// SPDX-License-Identifier: GPL-3.0-or-later
// The front door for a kernel that the library does not instantiate.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <pgdr/quality/check_mesh.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/refine_mesh_3.h>

#include "catch.h"

TEST_CASE("A cube is refined with exact constructions", "[refinement]") {
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  pgdr::Piecewise_linear_complex_3<Kernel> plc;
  for (int i = 0; i < 8; ++i) plc.vertices.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  for (const std::vector<pgdr::Index>& p : {std::vector<pgdr::Index>{0, 2, 3, 1},
                                            {4, 5, 7, 6},
                                            {0, 1, 5, 4},
                                            {2, 6, 7, 3},
                                            {0, 4, 6, 2},
                                            {1, 3, 7, 5}})
    plc.facets.push_back({{p}, {}, 7});
  pgdr::Parameters parameters;
  parameters.verify = true;
  const auto size = [](const Kernel::Point_3&) { return 0.2; };
  const auto mesh = pgdr::indexed_mesh_3(pgdr::refine_mesh_3(plc, size, parameters));
  CHECK(mesh.tetrahedra.size() > 200);
  CHECK(mesh.exempt.empty());
  const auto quality = pgdr::mesh_quality(mesh);
  CHECK(quality.max_circumradius <= 0.2 * (1 + 1e-9));
  CHECK(quality.max_radius_edge_ratio <= 2);
  CHECK(quality.volume == Approx(1));

  // What double precision cannot tell apart must not be two points to the predicates and one to the rest.
  auto between = plc;
  between.vertices[7] = Kernel::Point_3(1, 1, 1 + Kernel::FT(1) / 3);
  CHECK_THROWS_AS(pgdr::refine_mesh_3(between, size, parameters), pgdr::Input_error);

  // The checker reads arrays; the same cube of doubles is its input.
  pgdr::Plc same;
  for (const auto& p : plc.vertices)
    same.vertices.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  for (const auto& f : plc.facets) same.facets.push_back({f.polygons, {}, f.marker});
  const auto domain = pgdr::make_domain_3(same);
  for (const auto& line : pgdr::check_mesh(mesh, &domain)) {
    INFO(line.property << ": " << line.detail);
    CHECK(line.passed);
  }
}
