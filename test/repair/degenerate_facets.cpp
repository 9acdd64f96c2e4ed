// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/repair/degenerate_facets.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/refine_mesh_3.h>

#include "catch.h"
#include "domain/shapes.h"
#include "seeded_random.h"

using namespace pgdr;
using namespace pgdr_test;

namespace {

constexpr Index on_edge = 15;  ///< how many places an edge has for vertices

double mesh_volume(const Plc& plc) {
  Parameters parameters;
  parameters.coplanar_tolerance = 0;
  double sum = 0;
  for (const auto& [id, v] : mesh_quality(indexed_mesh_3(refine_mesh_3(plc, Uniform_sizing_field(), parameters))).region_volumes) sum += v;
  return sum;
}

/// A tetrahedron; its edge from 0 to 1 is in general position, and vertices 4 and later are on it, exactly.
Plc tetrahedron() {
  Plc plc;
  plc.nesting = Nesting::alternate;
  plc.vertices = {{0, 0, 0}, {16, 32, 48}, {40, 0, 0}, {0, 0, 60}};
  for (int k = 1; k <= static_cast<int>(on_edge); ++k) plc.vertices.emplace_back(k, 2 * k, 3 * k);
  plc.facets = {{{{0, 2, 3}}, {}, 0}, {{{1, 3, 2}}, {}, 0}};
  return plc;
}

/// Lets what no facet has be equal to a corner: by itself it would be a vertex of the complex.
void merge_unused(Plc& plc) {
  std::vector<bool> is_used(plc.vertices.size(), false);
  for (const Facet& f : plc.facets)
    for (const auto& polygon : f.polygons)
      for (const Index v : polygon) is_used[v] = true;
  for (Index v = 0; v < is_used.size(); ++v)
    if (!is_used[v]) plc.vertices[v] = plc.vertices[0];
}

/// Some of the vertices on the edge, ascending.
std::vector<Index> some(Random& random) {
  std::vector<Index> result;
  for (Index v = 4; v < 4 + on_edge; ++v)
    if (random.below(4) == 0) result.push_back(v);
  return result;
}

/// A polygon as triangles that share its corners, any.
void add_ears(Plc& plc, std::vector<Index> polygon, Random& random) {
  while (polygon.size() > 2) {
    const auto n = static_cast<std::uint32_t>(polygon.size()), i = random.below(n);
    plc.facets.push_back({{{polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]}}, {}, 0});
    polygon.erase(polygon.begin() + i);
  }
}

}  // namespace

TEST_CASE("a triangle without area goes, its number stays, and its neighbor gets its vertex") {
  Plc plc = tetrahedron();
  plc.facets.push_back({{{0, 4, 1}}, {}, 0});
  plc.facets.push_back({{{0, 1, 2}}, {}, 3});
  plc.facets.push_back({{{0, 3, 4}}, {}, 0});
  plc.facets.push_back({{{4, 3, 1}}, {}, 0});
  merge_unused(plc);
  CHECK_THROWS_AS(make_domain_3(plc), Input_error);
  CHECK(take_degenerate_facets_away(plc) == 1);
  REQUIRE(plc.facets.size() == 6);
  CHECK(plc.facets[2].polygons.empty());
  CHECK(plc.facets[3].polygons == std::vector<std::vector<Index>>{{0, 4, 1, 2}});
  const auto domain = make_domain_3(plc);
  CHECK(validate_domain_3(domain).empty());
  CHECK(domain.facets.size() == 4);
  CHECK(take_degenerate_facets_away(plc) == 0);
}

TEST_CASE("what is not degenerate stays as it is") {
  Plc plc = triangulated(tilted(box()));
  const std::size_t facets = plc.facets.size();
  CHECK(take_degenerate_facets_away(plc) == 0);
  CHECK(plc.facets.size() == facets);
  CHECK(validate_domain_3(make_domain_3(plc)).empty());
}

TEST_CASE("however a gap of no width was filled, the volume is that of the tetrahedron") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Seeded_random random(seed);
    const std::vector<Index> one = some(random), other = some(random);
    Plc plc = tetrahedron();
    std::vector<Index> first{0, 1, 2}, second{0, 3, 1}, gap{0};
    first.insert(first.begin() + 1, one.begin(), one.end());
    second.insert(second.end(), other.rbegin(), other.rend());
    gap.insert(gap.end(), other.begin(), other.end());
    gap.push_back(1);
    gap.insert(gap.end(), one.rbegin(), one.rend());
    plc.facets.push_back({{first}, {}, 0});
    plc.facets.push_back({{second}, {}, 0});
    add_ears(plc, gap, random);
    merge_unused(plc);
    const std::size_t facets = plc.facets.size();
    CHECK(take_degenerate_facets_away(plc) == facets - 4);
    REQUIRE(validate_domain_3(make_domain_3(plc, 0)).empty());
    CHECK(std::abs(mesh_volume(plc) - 40 * 32 * 60 / 6.0) < 1e-6);
  }
}
