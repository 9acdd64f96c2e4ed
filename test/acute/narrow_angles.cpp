// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/acute/narrow_angles_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <pgdr/domain/make_domain_3.h>

#include "catch.h"
#include "domain/shapes.h"

using namespace pgdr_test;
using pgdr::Feature_id;
using pgdr::Index;
using pgdr::Plc;

namespace {

/// Two triangles with vertex 0 in common, one above the other at an angle.
Plc pair(double degrees) {
  const double z = std::tan(degrees * std::numbers::pi / 180);
  Plc plc;
  plc.vertices = {{0, 0, 0}, {1, -1, 0}, {1, 1, 0}, {1, -1, z * std::sqrt(2)}, {1, 1, z * std::sqrt(2)}};
  plc.facets.resize(2);
  plc.facets[0].polygons = {{0, 1, 2}};
  plc.facets[1].polygons = {{0, 3, 4}};
  return plc;
}

template <class Domain>
Feature_id segment(const Domain& domain, Index a, Index b) {
  for (Index s = 0; s < domain.segments.size(); ++s)
    if (domain.segments[s].vertices == std::array{std::min(a, b), std::max(a, b)}) return {1, s};
  FAIL("no such segment");
  return {};
}

}  // namespace

TEST_CASE("A wedge is narrow between its facets, at its edge and below the limit", "[conforming]") {
  for (const double degrees : {1.0, 10.0, 14.0, 15.0, 40.0, 90.0}) {
    CAPTURE(degrees);
    const auto domain = pgdr::make_domain_3(triangular_prism(degrees, 2));
    REQUIRE(domain.facets.size() == 5);
    const pgdr::Narrow_angles_3 narrow(domain, pgdr::small_angles_3(domain));
    const bool is_below = degrees < 14.48;
    const auto are_narrow = [&](Feature_id u, Feature_id p, Feature_id q) {
      const bool result = narrow.are_narrow(u, p, q, 14.48);
      CHECK(narrow.are_narrow(u, q, p, 14.48) == result);
      return result;
    };
    const Feature_id edge = segment(domain, 0, 3), side{2, 0}, wall{2, 1}, end{2, 2}, bottom{2, 3};
    // Points inside the two facets, on segments that bound these elsewhere, and corners of theirs.
    CHECK(are_narrow(edge, side, wall) == is_below);
    CHECK(are_narrow({0, 0}, side, wall) == is_below);
    CHECK(are_narrow({0, 3}, side, {0, 2}) == is_below);
    CHECK(are_narrow(edge, segment(domain, 1, 4), segment(domain, 2, 5)) == is_below);
    CHECK(are_narrow(edge, {0, 1}, {0, 5}) == is_below);
    // The plane angle at the bottom's corner, between its two segments.
    CHECK(are_narrow({0, 0}, segment(domain, 0, 1), segment(domain, 0, 2)) == is_below);

    CHECK_FALSE(are_narrow(edge, side, side));
    CHECK_FALSE(are_narrow(edge, {0, 1}, {0, 4}));  // of one facet
    CHECK_FALSE(are_narrow(edge, edge, wall));
    CHECK_FALSE(are_narrow(edge, end, wall));  // does not meet the edge
    CHECK_FALSE(are_narrow({0, 0}, bottom, side));  // at a right angle
    CHECK_FALSE(are_narrow({0, 1}, side, wall));    // not where they meet
    CHECK_FALSE(are_narrow({2, 0}, side, wall));
  }
}

TEST_CASE("Facets with no more than a vertex in common are narrow at the vertex", "[conforming]") {
  for (const double degrees : {5.0, 20.0}) {
    CAPTURE(degrees);
    const auto domain = pgdr::make_domain_3(pair(degrees));
    const pgdr::Narrow_angles_3 narrow(domain, pgdr::small_angles_3(domain));
    const bool is_below = degrees < 14.48;
    CHECK(narrow.are_narrow({0, 0}, {2, 0}, {2, 1}, 14.48) == is_below);
    CHECK(narrow.are_narrow({0, 0}, segment(domain, 0, 1), segment(domain, 0, 3), 14.48) == is_below);
    CHECK_FALSE(narrow.are_narrow({0, 0}, segment(domain, 0, 1), {2, 0}, 14.48));  // on its boundary
    CHECK_FALSE(narrow.are_narrow({0, 1}, {2, 0}, {2, 1}, 14.48));
  }
}
