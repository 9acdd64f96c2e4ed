// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/curvature_sizes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/sizing/edge_length.h>

#include "catch.h"

namespace {

using Point = pgdr::Default_kernel::Point_3;

/// A prism of height 4 over a regular polygon around (x, 0, 0).
void add_prism(pgdr::Plc& plc, pgdr::Index sides, double radius, double x) {
  const auto first = static_cast<pgdr::Index>(plc.vertices.size());
  std::vector<pgdr::Index> bottom, top;
  for (pgdr::Index i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const double z : {0.0, 4.0}) plc.vertices.emplace_back(x + radius * std::cos(angle), radius * std::sin(angle), z);
    bottom.push_back(first + 2 * i);
    top.push_back(first + 2 * i + 1);
    const pgdr::Index j = (i + 1) % sides;
    plc.facets.push_back({{{first + 2 * i, first + 2 * j, first + 2 * j + 1, first + 2 * i + 1}}, {}, 0});
  }
  plc.facets.push_back({{bottom}, {}, 0});
  plc.facets.push_back({{top}, {}, 0});
}

double smallest(const std::vector<pgdr::Distance_sizing_field>& fields, const Point& p) {
  double size = std::numeric_limits<double>::infinity();
  for (const auto& field : fields) size = std::min(size, field(p));
  return size;
}

}  // namespace

TEST_CASE("sizes are in proportion to the radius of curvature", "[sizing]") {
  pgdr::Plc plc;
  add_prism(plc, 36, 1, 0);
  add_prism(plc, 72, 8, 20);
  const auto domain = pgdr::make_domain_3(plc, 1e-6);
  const double g = 0.5, edges_per_turn = 2 * std::numbers::pi / 0.3 / pgdr::mean_edge;  // a size of 0.3 radii
  const auto fields = pgdr::curvature_sizes(domain, edges_per_turn, g);
  REQUIRE(fields.size() == 2);
  CHECK(std::abs(smallest(fields, Point(1, 0, 2)) - (1 - g) * 0.3) < 0.002);
  CHECK(std::abs(smallest(fields, Point(12, 0, 2)) - (1 - g) * 0.3 * 8) < 0.02);
  // On the axis, a radius away from the wall.
  CHECK(std::abs(smallest(fields, Point(0, 0, 2)) - ((1 - g) * 0.3 + g)) < 0.005);
  // What is wider than the bound everywhere is left out.
  CHECK(pgdr::curvature_sizes(domain, edges_per_turn, g, 1).size() == 1);
}

TEST_CASE("a needle in a curved surface is no sharp bend", "[sizing]") {
  // A sixth of a cylinder of radius 1 in strips of 10 degrees, one of which is divided at a hundredth of its width.
  pgdr::Plc plc;
  std::vector<pgdr::Index> bottom, top;
  for (const double degrees : {0.0, 10.0, 20.0, 20.1, 30.0, 40.0, 50.0, 60.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    bottom.push_back(static_cast<pgdr::Index>(plc.vertices.size()));
    plc.vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
    top.push_back(static_cast<pgdr::Index>(plc.vertices.size()));
    plc.vertices.emplace_back(std::cos(angle), std::sin(angle), 4);
  }
  for (pgdr::Index i = 0, n = static_cast<pgdr::Index>(bottom.size()); i < n; ++i)
    plc.facets.push_back({{{bottom[i], bottom[(i + 1) % n], top[(i + 1) % n], top[i]}}, {}, 0});
  plc.facets.push_back({{bottom}, {}, 0});
  plc.facets.push_back({{top}, {}, 0});
  const auto domain = pgdr::make_domain_3(plc, 1e-9);
  const double g = 0.5, edges_per_turn = 2 * std::numbers::pi / 0.3 / pgdr::mean_edge;
  const double angle = 20.05 * std::numbers::pi / 180;
  CHECK(std::abs(smallest(pgdr::curvature_sizes(domain, edges_per_turn, g), Point(std::cos(angle), std::sin(angle), 2)) - (1 - g) * 0.3) < 0.02);
}

TEST_CASE("edges of boxes are features, and no curved surface", "[sizing]") {
  pgdr::Plc plc;
  add_prism(plc, 4, 1, 0);
  add_prism(plc, 8, 1, 10);  // turns by 45 degrees
  const auto domain = pgdr::make_domain_3(plc, 1e-6);
  CHECK(pgdr::curvature_sizes(domain, 12).empty());
  CHECK_THROWS_AS(pgdr::curvature_sizes(domain, 0), std::invalid_argument);
}
