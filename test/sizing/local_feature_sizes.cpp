// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/local_feature_sizes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/mesh_domain.h>
#include <pgdr/sizing/edge_length.h>
#include <pgdr/sizing/mesh_criteria_3.h>

#include "catch.h"
#include "domain/shapes.h"

namespace {

using Point = pgdr::Default_kernel::Point_3;
using Domain = pgdr::Domain_3<pgdr::Default_kernel>;
using Profile = std::vector<std::array<double, 2>>;

/// Adds the prism over simple polygons, from z = 0 to `depth`. All but the first are holes around (0, 0).
void extrude(pgdr::Plc& plc, const std::vector<Profile>& profiles, double depth) {
  pgdr_test::Facet bottom, top;
  for (const Profile& profile : profiles) {
    const auto first = static_cast<pgdr::Index>(plc.vertices.size()), n = static_cast<pgdr::Index>(profile.size());
    auto &lower = bottom.polygons.emplace_back(), &upper = top.polygons.emplace_back();
    for (pgdr::Index i = 0; i < n; ++i) {
      for (const double z : {0.0, depth}) plc.vertices.emplace_back(profile[i][0], profile[i][1], z);
      lower.push_back(first + 2 * i);
      upper.push_back(first + 2 * i + 1);
      const pgdr::Index j = (i + 1) % n;
      plc.facets.push_back({{{first + 2 * i, first + 2 * j, first + 2 * j + 1, first + 2 * i + 1}}, {}, 0});
    }
    if (profiles.size() == 1) continue;
    bottom.holes = {{0, 0, 0}};
    top.holes = {{0, 0, depth}};
  }
  plc.facets.push_back(bottom);
  plc.facets.push_back(top);
}

Profile circle(std::size_t sides, double radius) {
  Profile profile;
  for (std::size_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sides);
    profile.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return profile;
}

Domain prism(const Profile& profile, double depth) {
  pgdr::Plc plc;
  extrude(plc, {profile}, depth);
  return pgdr::make_domain_3(plc, 1e-6);
}

/// A block of 4 x 6 with a shelf of height 1.
const Profile step{{0, 0}, {10, 0}, {10, 1}, {4, 1}, {4, 6}, {0, 6}};
/// Prongs of width 2 with a slot of 0.1 between them.
const Profile prongs{{0, 0}, {4.1, 0}, {4.1, 6}, {2.1, 6}, {2.1, 2}, {2, 2}, {2, 6}, {0, 6}};

/// The width that the smallest size means.
double width(const std::vector<pgdr::Distance_sizing_field>& fields, double cells, const Point& p) {
  double size = std::numeric_limits<double>::infinity();
  for (const auto& field : fields) size = std::min(size, field(p));
  return size * cells * pgdr::mean_edge;
}

double width(const Domain& domain, const Point& p) { return width(pgdr::local_feature_sizes(domain, 4), 4, p); }

}  // namespace

TEST_CASE("What is narrow is measured from facet to facet", "[sizing]") {
  const Domain domain = prism(step, 20);
  const auto fields = pgdr::local_feature_sizes(domain, 4, 0.5);
  for (const double y : {0.0, 0.3, 0.5, 1.0}) CHECK(std::abs(width(fields, 4, Point(8, y, 10)) - 1) < 0.01);
  CHECK(std::abs(width(fields, 4, Point(1, 4, 10)) - 4) < 0.5);
  // Next to the shelf, but in the block.
  CHECK(width(fields, 4, Point(3.5, 0, 10)) < 4);
  // The bound grows with the distance from there.
  const double there = width(fields, 4, Point(8, 3, 10));
  CHECK(std::abs(width(fields, 4, Point(8, 3.5, 10)) - there - 0.5 * 0.5 * 4 * pgdr::mean_edge) < 0.01);
  // What is as wide as the bound everywhere is left out.
  CHECK(pgdr::local_feature_sizes(domain, 4, 0.5, 3.9 / 4 / pgdr::mean_edge).size() < fields.size());
  CHECK(pgdr::local_feature_sizes(domain, 4, 0.5, 0.99 / 4 / pgdr::mean_edge).empty());
  CHECK_THROWS_AS(pgdr::local_feature_sizes(domain, 0), std::invalid_argument);
  CHECK_THROWS_AS(pgdr::local_feature_sizes(domain, 4, 1), std::invalid_argument);
}

TEST_CASE("Gaps count where something is meshed in them", "[sizing]") {
  pgdr::Plc plc;
  extrude(plc, {prongs}, 20);
  CHECK(std::abs(width(pgdr::make_domain_3(plc, 1e-6), Point(1.99, 4, 10)) - 2) < 0.01);
  const auto end = plc.vertices.size();
  pgdr_test::add_box(plc, {-30, -30, -30}, {30, 30, 50});
  REQUIRE(end < plc.vertices.size());
  CHECK(std::abs(width(pgdr::make_domain_3(plc, 1e-6), Point(1.99, 4, 10)) - 0.1) < 0.001);
  plc.nesting = pgdr::Nesting::alternate;  // only what is around the prongs
  CHECK(std::abs(width(pgdr::make_domain_3(plc, 1e-6), Point(1.99, 4, 10)) - 0.1) < 0.001);
  plc.holes.emplace_back(20, 20, 20);
  plc.nesting = pgdr::Nesting::fill;
  CHECK(std::abs(width(pgdr::make_domain_3(plc, 1e-6), Point(1.99, 4, 10)) - 2) < 0.01);
}

TEST_CASE("Strips of curved surfaces and wedges are not narrow, tubes are", "[sizing]") {
  const double solid = width(prism(circle(72, 1), 20), Point(1, 0, 10));
  CHECK((solid > std::numbers::sqrt3 - 0.1 && solid < 2));
  pgdr::Plc tube;
  extrude(tube, {circle(72, 1), circle(72, 0.9)}, 4);
  CHECK(std::abs(width(pgdr::make_domain_3(tube, 1e-6), Point(0.95, 0, 2)) - 0.1) < 0.002);
  const double depth = 2;
  for (const double degrees : {30.0, 3.0, 0.03}) CHECK(std::abs(width(pgdr::make_domain_3(pgdr_test::triangular_prism(degrees, depth), 1e-6), Point(0.1, 0, 1)) - depth) < 0.01);
}

TEST_CASE("So many edges span a shelf, and none more the block beside it", "[sizing]") {
  const Domain domain = prism(step, 10);
  const auto mesh = pgdr::mesh_domain(domain, pgdr::sizing_of({.cells_across = 4}, domain)).mesh;
  double sum = 0;
  int edges = 0, in_block = 0;
  for (const auto& t : mesh.tetrahedra)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const auto &a = mesh.points[t[i]], &b = mesh.points[t[j]];
        if (std::min(a[0], b[0]) > 5) {
          sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
          ++edges;
        }
        in_block += std::max(a[0], b[0]) < 3;
      }
  CHECK(std::abs(sum / edges * 4 - 1) < 0.1);
  const double volume = 5 * 1 * 10, block = 3 * 6 * 10;
  CHECK(edges / volume > 10 * in_block / block);
}
