// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/mesh_criteria_3.h>

#include <array>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>

#include <pgdr/domain/valid_domain.h>
#include <pgdr/mesh_domain.h>

#include "catch.h"
#include "domain/shapes.h"
#include "inputs.h"
#include "seeded_random.h"

namespace {

using pgdr::Mesh_criteria_3;
using Point = pgdr::Default_kernel::Point_3;
using Domain = pgdr::Domain_3<pgdr::Default_kernel>;

/// The unit cube whose facets have the markers 1 to 6, with a marked segment across one of them.
Domain cube() {
  pgdr::Plc plc = pgdr_test::box();
  for (std::size_t i = 0; i < 6; ++i) plc.facets[i].marker = static_cast<int>(i) + 1;
  plc.segments.push_back({0, 3, 9});
  return pgdr::valid_domain(plc, 1e-6);
}

double length(const pgdr::Indexed_mesh_3& mesh, std::uint32_t a, std::uint32_t b) {
  return std::hypot(mesh.points[a][0] - mesh.points[b][0], mesh.points[a][1] - mesh.points[b][1], mesh.points[a][2] - mesh.points[b][2]);
}

double circumradius(const pgdr::Indexed_mesh_3& mesh, const std::array<std::uint32_t, 3>& t) {
  const double a = length(mesh, t[0], t[1]), b = length(mesh, t[1], t[2]), c = length(mesh, t[2], t[0]), s = (a + b + c) / 2;
  return a * b * c / (4 * std::sqrt(s * (s - a) * (s - b) * (s - c)));
}

pgdr::Indexed_mesh_3 mesh_of(const Domain& domain, const Mesh_criteria_3& criteria) { return pgdr::mesh_domain(domain, pgdr::sizing_of(criteria, domain)).mesh; }

/// The longest edge on segments with the marker.
double longest_edge(const pgdr::Indexed_mesh_3& mesh, int marker) {
  double longest = 0;
  for (std::size_t i = 0; i < mesh.edges.size(); ++i)
    if (mesh.edge_references[i] == marker) longest = std::max(longest, length(mesh, mesh.edges[i][0], mesh.edges[i][1]));
  return longest;
}

double largest_triangle(const pgdr::Indexed_mesh_3& mesh, int marker) {
  double largest = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (mesh.triangle_references[i] == marker) largest = std::max(largest, circumradius(mesh, mesh.triangles[i]));
  return largest;
}

}  // namespace

TEST_CASE("criteria bound edges on segments, triangles on facets and tetrahedra", "[sizing]") {
  const Domain domain = cube();
  constexpr double rounded = 1 + 1e-9;
  SECTION("edges") {
    const auto mesh = mesh_of(domain, {.edge_size = 0.1});
    CHECK(longest_edge(mesh, 0) <= 0.1 * rounded);
    CHECK(longest_edge(mesh, 9) <= 0.1 * rounded);
    CHECK(largest_triangle(mesh, 2) > 0.1);  // they need not be as small in the middle
  }
  SECTION("edges of one curve") {
    const auto mesh = mesh_of(domain, {.curve_sizes = {{9, 0.05}}});
    CHECK(longest_edge(mesh, 9) <= 0.05 * rounded);
    CHECK(longest_edge(mesh, 0) > 0.2);
  }
  SECTION("all facets") {
    const auto mesh = mesh_of(domain, {.facet_size = 0.1});
    for (int marker = 1; marker <= 6; ++marker) CHECK(largest_triangle(mesh, marker) <= 0.1 * rounded);
  }
  SECTION("a patch, and a field of cells") {
    const auto mesh = mesh_of(domain, {.cell_size = [](const Point& p) { return 0.1 + 0.3 * p.z(); }, .patch_sizes = {{2, 0.05}}, .gradation = 0.4});
    CHECK(largest_triangle(mesh, 2) <= 0.05 * rounded);
    CHECK(largest_triangle(mesh, 1) <= 0.15);
    CHECK(largest_triangle(mesh, 1) > 0.05);
  }
  SECTION("a size of cells alone is the uniform field") {
    const auto sizing = pgdr::sizing_of({.cell_size = 0.2}, domain);
    CHECK(sizing(Point(0.5, 0.5, 0.5)) == 0.2);
    CHECK(sizing.near_surfaces().empty());
    CHECK(sizing.functions().empty());
  }
}

TEST_CASE("sizes around segments grow with the distance from the nearest", "[sizing]") {
  const auto field = pgdr::Distance_sizing_field::from_segments({{{{0, 0, 0}, {2, 0, 0}}}, {{{0, 3, 0}, {0, 3, 8}}}, {{{5, 5, 5}, {5, 5, 5}}}}, 0.1, 0.9, 4);
  pgdr_test::Seeded_random random(3);
  for (int i = 0; i < 300; ++i) {
    const double x = random.between(-3, 3), y = random.between(-1, 5), z = random.between(0, 8);
    const double beyond = std::max({-x, x - 2, 0.0});
    const double d = std::min(std::sqrt(beyond * beyond + y * y + z * z), std::hypot(x, y - 3));
    const double size = 0.1 + 0.8 * std::min(d / 4, 1.0);
    CHECK(field(Point(x, y, z)) == Approx(size).epsilon(1e-12));
    const double limit = random.between(0.1, 0.9), found = field.size_if_below(Point(x, y, z), [&] { return limit; });
    CHECK((found < limit) == (size < limit));
  }
  CHECK(field.area() == 0);
  CHECK_THROWS_AS(pgdr::Distance_sizing_field::from_segments({}, 0.1, 0.9, 4), std::invalid_argument);
}

TEST_CASE("criteria without sense are refused", "[sizing]") {
  const Domain domain = cube();
  for (const Mesh_criteria_3& criteria : {Mesh_criteria_3{.edge_size = 0}, Mesh_criteria_3{.facet_size = -1}, Mesh_criteria_3{.cell_size = std::numeric_limits<double>::quiet_NaN()},
                                          Mesh_criteria_3{.patch_sizes = {{7, 1}}}, Mesh_criteria_3{.curve_sizes = {{7, 1}}}, Mesh_criteria_3{.edge_size = 1, .gradation = 1}})
    CHECK_THROWS_AS(pgdr::sizing_of(criteria, domain), std::invalid_argument);
}
