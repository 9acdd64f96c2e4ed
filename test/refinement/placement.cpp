// SPDX-License-Identifier: GPL-3.0-or-later
// Where Steiner points go: every policy ends and keeps the bound, and what each is for.
#include <pgdr/refinement/point_placement.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "inputs.h"
#include "refinement/refined.h"

using namespace pgdr_test;
using pgdr::Point_placement;

namespace {

constexpr Point_placement policies[] = {Point_placement::lazy, Point_placement::circumcenter, Point_placement::type1, Point_placement::type2};

/// With points where the policy puts them: they are not moved afterwards.
Mesh placed(const pgdr::Plc& plc, double size, double bound, Point_placement placement) {
  pgdr::Parameters parameters;
  parameters.radius_edge_ratio = bound;
  parameters.min_dihedral = 0;
  const pgdr::Standard_placement policy{placement, {pgdr::cosine_of_degrees(20)}};
  return pgdr::refine_mesh_3(pgdr::make_domain_3(plc, parameters.coplanar_tolerance, false), same_size(size), parameters, policy);
}

pgdr::Tetrahedron_points corners(const pgdr::Indexed_mesh_3& mesh, std::size_t t) {
  pgdr::Tetrahedron_points p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = pgdr::to_vec(mesh.points[mesh.tetrahedra[t][i]]);
  return p;
}

/// Tetrahedra with a dihedral angle below five degrees.
std::size_t slivers(const pgdr::Indexed_mesh_3& mesh) {
  const double cosine = std::cos(5 * std::numbers::pi / 180);
  std::size_t n = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    n += pgdr::largest_dihedral_cosine(corners(mesh, t)) > cosine;
  return n;
}

constexpr double any_size = std::numeric_limits<double>::infinity();
const Sized_shape sized_shapes[] = {{"cube.poly", 0.08},          {"l_block.poly", 0.2},           {"cavity.poly", 0.4},
                        {"two_regions.poly", 0.2},    {"plate_with_hole.poly", 0.3},   {"plate_with_hole.poly", any_size},
                        {"winged_body_in_box.poly", 4}, {"winged_body_in_box.poly", any_size}};

}  // namespace

TEST_CASE("Every placement ends with the bound kept", "[refinement]") {
  for (const auto& [file, size] : sized_shapes)
    for (const double bound : {2.0, 4.0})
      for (const Point_placement placement : policies) {
        CAPTURE(file, size, bound, static_cast<int>(placement));
        const Mesh mesh = placed(pgdr::read_plc(data_file(file)), size, bound, placement);
        CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
        CHECK(failures(pgdr::check_mesh(pgdr::indexed_mesh_3(mesh), &mesh.domain(), {bound})) == "");
      }
}

TEST_CASE("At a bound of two the type-II ball is empty", "[refinement]") {
  for (const auto& [file, size] : sized_shapes) {
    CAPTURE(file, size);
    const auto plc = pgdr::read_plc(data_file(file));
    const auto mesh = [&](Point_placement p, double bound) { return pgdr::indexed_mesh_3(placed(plc, size, bound, p)); };
    CHECK(equal(mesh(Point_placement::type2, 2), mesh(Point_placement::circumcenter, 2)));
  }
  const auto body = pgdr::read_plc(data_file("winged_body_in_box.poly"));
  CHECK(!equal(pgdr::indexed_mesh_3(placed(body, any_size, 4, Point_placement::type2)),
               pgdr::indexed_mesh_3(placed(body, any_size, 4, Point_placement::circumcenter))));
}

TEST_CASE("No placement makes edges shorter than its selection ball allows", "[refinement]") {
  const double size = 0.06;
  for (const Point_placement placement : policies) {
    CAPTURE(static_cast<int>(placement));
    const auto mesh = pgdr::indexed_mesh_3(placed(pgdr::read_plc(data_file("cube.poly")), size, 2, placement));
    CHECK(shortest_edge(mesh) >= 0.5 * (1 - pgdr::size_selection_fraction) * size);
  }
}

TEST_CASE("A choice of points leaves hardly a sliver", "[refinement]") {
  const auto cube = pgdr::read_plc(data_file("cube.poly"));
  const auto center = pgdr::indexed_mesh_3(placed(cube, 0.04, 2, Point_placement::circumcenter));
  const auto chosen = pgdr::indexed_mesh_3(placed(cube, 0.04, 2, Point_placement::lazy));
  CAPTURE(slivers(center), slivers(chosen), center.tetrahedra.size(), chosen.tetrahedra.size());
  CHECK(slivers(center) > 50);
  // What is left lies on facets, where no point is chosen.
  CHECK(4 * slivers(chosen) <= slivers(center));
  CHECK(chosen.tetrahedra.size() <= center.tetrahedra.size());
}

TEST_CASE("The smallest dihedral angle of a tetrahedron", "[refinement]") {
  const auto degrees = [](const pgdr::Tetrahedron_points& p) {
    return 180 / std::numbers::pi * std::acos(pgdr::largest_dihedral_cosine(p));
  };
  CHECK(degrees({pgdr::Vec_3{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}) == Approx(70.528779));
  CHECK(degrees({pgdr::Vec_3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) == Approx(54.735610));
  // A sliver: the corners of a square, one diagonal lifted.
  CHECK(degrees({pgdr::Vec_3{1, 0, 0}, {0, 1, 0.01}, {-1, 0, 0}, {0, -1, 0.01}}) < 2);
  CHECK(pgdr::largest_dihedral_cosine({pgdr::Vec_3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}) == Approx(1));
}
