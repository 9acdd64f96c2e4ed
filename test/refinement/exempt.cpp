// SPDX-License-Identifier: GPL-3.0-or-later
// Which tetrahedra are exempt from the radius-edge bound.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "catch.h"
#include "refinement/refined.h"

using namespace pgdr_test;

namespace {

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
  const auto add_facet = [&](std::vector<pgdr::Index> polygon) {
    plc.facets.emplace_back();
    plc.facets.back().polygons.push_back(std::move(polygon));
  };
  for (std::size_t i = 0; i < sides; ++i) add_facet({0, base[i], base[(i + 1) % sides]});
  add_facet(base);
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
