// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/simplify/narrowness.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/small_angles_3.h>

#include "catch.h"

using namespace pgdr;

namespace {

/// One polygon in the plane z = 0.
Narrowness of_polygon(const std::vector<std::array<double, 2>>& corners) {
  Plc plc;
  plc.facets.emplace_back().polygons.emplace_back();
  for (const auto& [x, y] : corners) {
    plc.facets[0].polygons[0].push_back(static_cast<Index>(plc.vertices.size()));
    plc.vertices.emplace_back(x, y, 0);
  }
  return narrowness(make_domain_3(plc));
}

}  // namespace

TEST_CASE("A strip counts how often it is as long as it is wide", "[simplify]") {
  const double length = 3, width = 0.02;
  const Narrowness n = of_polygon({{0, 0}, {length, 0}, {length, width}, {0, width}});
  CHECK(n.halvings == 0);
  CHECK(std::abs(n.widths - 2 * (1 + length / width) - 2 * (1 + width / length)) < 1e-9);
}

TEST_CASE("A corner that comes close to a segment counts by its logarithm", "[simplify]") {
  const double h = 1e-4;
  const Narrowness n = of_polygon({{0, 0}, {2, 0}, {2, 1}, {1, h}, {0, 1}});
  CHECK(n.halvings == 0);
  // Above the long side: twice the integral of 1 / (h + (1 - h) s). The others have less than two widths each.
  const double above = 2 * std::log(1 / h) / (1 - h);
  CHECK(n.widths > 5 + above);
  CHECK(n.widths < 5 + above + 8);
}

TEST_CASE("A needle counts by how often its angle has been halved", "[simplify]") {
  const double quarter = Small_angles::critical_plane_angle_deg / 4 * std::numbers::pi / 180;
  const Narrowness n = of_polygon({{0, 0}, {1, -std::tan(quarter / 2)}, {1, std::tan(quarter / 2)}});
  CHECK(std::abs(n.halvings - 2) < 1e-9);
  CHECK(n.widths < 4);  // no width between its sides
  CHECK(n.tetrahedra() > 2 * 200);
}
