// SPDX-License-Identifier: GPL-3.0-or-later
// Which tetrahedra are exempt from the radius-edge bound.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <pgdr/acute/split_guard_3.h>

#include "catch.h"
#include "refinement/refined.h"

using namespace pgdr_test;

namespace {

void add_facet(pgdr::Plc& plc, std::vector<pgdr::Index> polygon) {
  plc.facets.emplace_back();
  plc.facets.back().polygons.push_back(std::move(polygon));
}

/// A pyramid over a regular polygon, of height 1; its sides leave the axis at an angle.
pgdr::Plc spike(std::size_t sides, double degrees) {
  pgdr::Plc plc;
  plc.vertices = {{0, 0, 1}};
  const double radius = std::tan(degrees * std::numbers::pi / 180);
  std::vector<pgdr::Index> base;
  for (std::size_t i = 0; i < sides; ++i) {
    const double turn = 2 * std::numbers::pi * double(i) / double(sides);
    base.push_back(static_cast<pgdr::Index>(plc.vertices.size()));
    plc.vertices.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0);
  }
  for (std::size_t i = 0; i < sides; ++i) add_facet(plc, {0, base[i], base[(i + 1) % sides]});
  add_facet(plc, base);
  return plc;
}

}  // namespace

TEST_CASE("Only what touches the pieces at a tip is exempt", "[refinement]") {
  // Facets of 5 to 17 degrees at the tip. Away from it, too, their edges come close to each other.
  for (const auto& [sides, degrees] : {std::pair{10, 20.0}, {20, 30.0}, {12, 10.0}}) {
    CAPTURE(sides, degrees);
    const Mesh refined_mesh = refined(spike(static_cast<std::size_t>(sides), degrees));
    const auto mesh = pgdr::indexed_mesh_3(refined_mesh);
    CHECK(failures(pgdr::check_mesh(mesh, &refined_mesh.domain())) == "");
    const auto from_tip = [&](std::size_t v) {
      const auto& p = mesh.points[v];
      return std::hypot(p[0], p[1], p[2] - 1);
    };
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t v = 1; v < mesh.points.size(); ++v) nearest = std::min(nearest, from_tip(v));
    CHECK(nearest > 0.1);
    CHECK(!mesh.exempt.empty());
    std::size_t apart = 0;
    for (const std::size_t t : mesh.exempt)
      apart += std::ranges::none_of(mesh.tetrahedra[t], [&](auto v) { return from_tip(static_cast<std::size_t>(v)) < 1.01 * nearest; });
    CHECK(apart == 0);
  }
}

TEST_CASE("What touches a narrow wedge is not refined in vain", "[refinement]") {
  // A prism over a triangle of ten degrees: any tetrahedron at its edge is above the bound.
  pgdr::Plc plc;
  for (const double y : {0, 1}) {
    plc.vertices.emplace_back(0, y, 0);
    plc.vertices.emplace_back(1, y, 0);
    plc.vertices.emplace_back(1, y, std::tan(10 * std::numbers::pi / 180));
  }
  for (const auto& polygon : {std::vector<pgdr::Index>{0, 1, 2}, {3, 4, 5}, {0, 1, 4, 3}, {0, 2, 5, 3}, {1, 2, 5, 4}}) add_facet(plc, polygon);
  const Mesh coarse = refined(plc);
  const auto mesh = pgdr::indexed_mesh_3(coarse);
  CHECK(failures(pgdr::check_mesh(mesh, &coarse.domain())) == "");
  CHECK(coarse.statistics().steiner_points == 0);
  CHECK(mesh.exempt.size() == 3);

  // Where the user asks for smaller ones it is.
  const Mesh fine = refined(plc, 0.1);
  CHECK(failures(pgdr::check_mesh(pgdr::indexed_mesh_3(fine), &fine.domain())) == "");
  CHECK(fine.statistics().steiner_points > 100);
}

TEST_CASE("A Steiner point inherits the insertion radii of an edge that is shorter than these", "[refinement]") {
  using Tr = Mesh::Triangulation;
  Tr tr;
  const std::vector<Tr::Point> points{{0, 0, 0}, {0.1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Tr::Vertex_handle> v;
  for (const auto& p : points) v.push_back(tr.insert(p));
  const Tr::Cell_handle c = tr.finite_cells_begin();
  pgdr::Tetrahedron_points corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = pgdr::position(c->vertex(static_cast<int>(i)));
  const auto ball = pgdr::tetrahedron_ball(corners);
  const auto inherited = [&](double a, double b) {
    v[0]->set_insertion_radius(a);
    v[1]->set_insertion_radius(b);
    return pgdr::inherited_radius(c, ball, corners);
  };
  v[2]->set_insertion_radius(7);
  v[3]->set_insertion_radius(7);
  CHECK(inherited(0.5, 0.25) == Approx(0.25));
  CHECK(inherited(0.125, 3) == Approx(0.125));
  CHECK(inherited(0.0625, 3) == 0);  // no longer than the edge
}
