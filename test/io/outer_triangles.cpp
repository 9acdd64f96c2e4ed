// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/outer_triangles.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>

#include "../catch.h"
#include "sample_mesh.h"

TEST_CASE("triangles with tetrahedra on both sides are removed, with all that belongs to them") {
  constexpr std::uint32_t n = 5;  // points along an edge: 4 x 4 x 4 cubes
  pgdr::Indexed_mesh_3 mesh = pgdr_test::sample_mesh(n);
  mesh.triangles.clear();
  mesh.triangle_references.clear();
  mesh.triangle_input_facets.clear();
  std::set<std::set<std::uint32_t>> seen;
  for (const auto& t : mesh.tetrahedra)
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      const std::array<std::uint32_t, 3> face{t[(opposite + 2) % 4], t[(opposite + 1) % 4], t[(opposite + 3) % 4]};
      if (!seen.insert({face.begin(), face.end()}).second) continue;
      mesh.triangles.push_back(face);
      mesh.triangle_references.push_back(static_cast<std::int32_t>(mesh.triangles.size()));
      mesh.triangle_input_facets.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    }
  const auto all = mesh.triangles;
  constexpr std::size_t outside = 6 * (n - 1) * (n - 1) * 2;
  CHECK(pgdr::keep_outer_triangles(mesh) == all.size() - outside);
  REQUIRE(mesh.triangles.size() == outside);
  REQUIRE(mesh.triangle_references.size() == outside);
  bool belong = true;
  for (std::size_t i = 0; i < outside; ++i) {
    const auto from = static_cast<std::size_t>(mesh.triangle_references[i]);
    belong &= mesh.triangles[i] == all[from - 1] && mesh.triangle_input_facets[i] == from;
  }
  CHECK(belong);
  CHECK(pgdr::keep_outer_triangles(mesh) == 0);
}
