// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/quality/check_mesh.h>
#include <pgdr/quality/mesh_quality.h>

#include <pgdr/domain/make_domain_3.h>

#include "catch.h"
#include "corruptions.h"
#include "domain/shapes.h"
#include "lattice_mesh.h"

namespace {

std::string printed(const std::vector<pgdr::Check_line>& lines) {
  std::string s;
  for (const auto& line : lines)
    s += (line.passed ? "ok   " : "FAIL ") + line.property + ": " + line.detail + "\n";
  return s;
}

bool fails(const std::vector<pgdr::Check_line>& lines, const std::string& property) {
  for (const auto& line : lines)
    if (line.property == property) return !line.passed;
  return false;
}

TEST_CASE("A valid mesh passes every check, with and without its input", "[quality]") {
  const auto domain = pgdr::make_domain_3(pgdr_test::two_boxes());
  for (const int n : {2, 4, 8}) {
    const auto mesh = pgdr_test::lattice_mesh(n);
    const auto lines = pgdr::check_mesh(mesh, &domain);
    INFO(printed(lines));
    REQUIRE(pgdr::all_passed(lines));
    REQUIRE(lines.size() == 16);
    REQUIRE(pgdr::all_passed(pgdr::check_mesh(mesh)));
  }
}

/// The facets of `two_boxes` cut into the triangles of the lattice, each square along the same diagonal.
pgdr::Plc triangulated_boxes(int n, const std::vector<std::array<double, 3>>& points) {
  const pgdr_test::Lattice lattice(n);
  pgdr::Plc plc;
  for (const auto& p : points) plc.vertices.emplace_back(p[0], p[1], p[2]);
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    plc.facets.emplace_back();
    plc.facets.back().polygons = {{a, b, c}};
    plc.facets.back().marker =
        pgdr_test::Lattice::marker(lattice.common_facets(std::array<std::uint32_t, 3>{a, b, c}));
  };
  const auto square = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    add(a, b, c);
    add(a, c, d);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (const int side : {0, n / 2, n}) {
        square(lattice.at(side, i, j), lattice.at(side, i + 1, j), lattice.at(side, i + 1, j + 1),
               lattice.at(side, i, j + 1));
        if (2 * side == n) continue;
        square(lattice.at(i, side, j), lattice.at(i + 1, side, j), lattice.at(i + 1, side, j + 1),
               lattice.at(i, side, j + 1));
        square(lattice.at(i, j, side), lattice.at(i + 1, j, side), lattice.at(i + 1, j + 1, side),
               lattice.at(i, j + 1, side));
      }
  plc.regions = {{{0.25, 0.5, 0.5}, 10, 0}, {{0.75, 0.5, 0.5}, 20, 0}};
  return plc;
}

TEST_CASE("Facets that are only nearly planar may be cut into other triangles", "[quality]") {
  const int n = 6;
  for (const double bump : {1e-12, 1e-9, 1e-7}) {
    auto mesh = pgdr_test::lattice_mesh(n, 0.1, bump);
    for (const auto& t : mesh.triangles)
      for (const auto v : t) mesh.point_references[v] = 0;
    std::fill(mesh.edge_references.begin(), mesh.edge_references.end(), 0);
    auto plc = triangulated_boxes(n, mesh.points);
    const auto domain = pgdr::make_domain_3(plc);
    REQUIRE(domain.facets.size() == 11);
    REQUIRE(mesh.triangles.size() == plc.facets.size());
    const auto lines = pgdr::check_mesh(mesh, &domain);
    INFO(bump << "\n" << printed(lines));
    REQUIRE(pgdr::all_passed(lines));

    auto far = mesh;  // out of one facet's plane by ten tolerances
    const pgdr_test::Lattice lattice(n);
    far.points[lattice.at(2, 2, 0)][2] -= 1.8e-5;
    REQUIRE(fails(pgdr::check_mesh(far, &domain), "distance"));
  }
}

TEST_CASE("Ties between cospherical points are allowed, whichever way they are broken", "[quality]") {
  auto mesh = pgdr_test::lattice_mesh(4, 0);
  REQUIRE(pgdr::all_passed(pgdr::check_mesh(mesh)));
  // The same lattice turned by 90 degrees: other diagonals of the cubes.
  for (auto& p : mesh.points) p = {p[0], 1 - p[2], p[1]};
  const auto lines = pgdr::check_mesh(mesh);
  INFO(printed(lines));
  REQUIRE(pgdr::all_passed(lines));
}

TEST_CASE("Every corruption fails the property that it breaks", "[quality]") {
  const auto domain = pgdr::make_domain_3(pgdr_test::two_boxes());
  const auto valid = pgdr_test::lattice_mesh(4);
  for (const auto& corruption : pgdr_test::corruptions()) {
    auto mesh = valid;
    corruption.apply(mesh);
    const auto lines = pgdr::check_mesh(mesh, &domain);
    INFO(corruption.name << "\n" << printed(lines));
    REQUIRE(fails(lines, corruption.property));
    REQUIRE_FALSE(pgdr::all_passed(lines));
    if (!corruption.needs_domain) REQUIRE(fails(pgdr::check_mesh(mesh), corruption.property));
  }
}

TEST_CASE("The ratio bound is checked, and small angles of the input excuse only what is near them",
          "[quality]") {
  const auto mesh = pgdr_test::lattice_mesh(4);
  REQUIRE(fails(pgdr::check_mesh(mesh, nullptr, {0.7}), "ratio"));
  const auto domain = pgdr::make_domain_3(pgdr_test::two_boxes());
  REQUIRE(fails(pgdr::check_mesh(mesh, &domain, {0.7}), "ratio"));  // all its angles are right
  REQUIRE_FALSE(fails(pgdr::check_mesh(mesh, &domain, {2}), "ratio"));

  // A tetrahedron that is a thin wedge: 10 degrees at the edge from 0 to 1, ratio well above 2.
  pgdr::Plc wedge;
  const double s = std::tan(10 * std::acos(-1.0) / 180);
  wedge.vertices = {{0, 0, 0}, {8, 0, 0}, {4, 1, 0}, {4, 1, s}};
  wedge.facets.resize(4);
  wedge.facets[0].polygons = {{0, 1, 2}};
  wedge.facets[1].polygons = {{0, 1, 3}};
  wedge.facets[2].polygons = {{0, 2, 3}};
  wedge.facets[3].polygons = {{1, 2, 3}};
  const auto wedge_domain = pgdr::make_domain_3(wedge);
  pgdr::Indexed_mesh_3 one;
  for (const auto& p : wedge.vertices) one.points.push_back({p.x(), p.y(), p.z()});
  one.point_references.assign(4, 0);
  one.edges = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  one.edge_references.assign(6, 0);
  one.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  one.triangle_references.assign(4, 0);
  one.tetrahedra = {{0, 1, 2, 3}};
  one.tetrahedron_references = {1};
  const auto lines = pgdr::check_mesh(one, &wedge_domain);
  INFO(printed(lines));
  REQUIRE(pgdr::all_passed(lines));
  REQUIRE(lines.back().detail.find("1 tetrahedra over it; shortest edge between what meets at an angle < 14.48: 1, < 30: 0") != std::string::npos);
  REQUIRE(fails(pgdr::check_mesh(one), "ratio"));

  // Its dihedral angles, and those of the lattice's tetrahedra.
  const double smallest = pgdr::mesh_quality(mesh).min_dihedral_deg;
  REQUIRE(pgdr::all_passed(pgdr::check_mesh(one, &wedge_domain, {2, 14})));
  REQUIRE(fails(pgdr::check_mesh(one, nullptr, {2, 14}), "dihedral angle"));
  REQUIRE(fails(pgdr::check_mesh(mesh, &domain, {2, smallest + 0.1}), "dihedral angle"));
  REQUIRE_FALSE(fails(pgdr::check_mesh(mesh, &domain, {2, smallest - 0.1}), "dihedral angle"));

  // A regular tetrahedron with circumradius 0.1, which the bound 0.6 makes poor, that ends within and beyond 0.4 from the wedge's edge.
  const auto beside = [&](double distance) {
    auto mesh_beside = one;
    const double h = 0.1 / std::sqrt(3);
    mesh_beside.points = {{4 + h, h - distance, h}, {4 + h, -h - distance, -h}, {4 - h, h - distance, -h}, {4 - h, -h - distance, h}};
    return fails(pgdr::check_mesh(mesh_beside, &wedge_domain, {0.6}), "ratio");
  };
  REQUIRE_FALSE(beside(0.44));
  REQUIRE(beside(0.5));  // what is protected there is 0.024 wide

  // Nine circumradii from there, with an edge across the wedge, and across a part of it.
  const auto across = [&](double part) {
    auto mesh_across = one;
    const double l = part * s / 2;
    mesh_across.points = {{4, 0.5, 0}, {4, 0.5, l}, {4 + l, 0.5, l / 2}, {4 + l / 3, 0.5 + l, l / 2}};
    return fails(pgdr::check_mesh(mesh_across, &wedge_domain, {0.6}), "ratio");
  };
  REQUIRE_FALSE(across(1));
  REQUIRE(across(0.8));
}

TEST_CASE("Next to a facet that is bent, what is smaller than its bend may be poor", "[quality]") {
  pgdr::Plc plc = pgdr_test::triangulated(pgdr_test::box());
  plc.vertices[7] = {1, 1, 1.04};
  const auto domain = pgdr::make_domain_3(plc, 0.05);
  REQUIRE(domain.facets.size() == 6);
  // A regular tetrahedron, which the bound 0.6 makes poor, at the top.
  const auto is_poor = [&](double edge) {
    pgdr::Indexed_mesh_3 one;
    const double h = edge / std::sqrt(8);
    one.points = {{0.5 + h, 0.5 + h, 1 + h}, {0.5 + h, 0.5 - h, 1 - h}, {0.5 - h, 0.5 + h, 1 - h}, {0.5 - h, 0.5 - h, 1 + h}};
    one.point_references.assign(4, 0);
    one.tetrahedra = {{0, 1, 2, 3}};
    one.tetrahedron_references = {1};
    return fails(pgdr::check_mesh(one, &domain, {0.6}), "ratio");
  };
  CHECK_FALSE(is_poor(0.035));
  CHECK(is_poor(0.045));
}

TEST_CASE("Meshes that are no meshes are refused without harm", "[quality]") {
  REQUIRE(fails(pgdr::check_mesh({}), "indices"));
  auto flat = pgdr_test::lattice_mesh(2);
  for (auto& p : flat.points) p[2] = 0;
  REQUIRE(fails(pgdr::check_mesh(flat), "orientation"));
  const auto domain = pgdr::make_domain_3(pgdr_test::two_boxes());
  REQUIRE(fails(pgdr::check_mesh(flat, &domain), "volume"));
}

}  // namespace
