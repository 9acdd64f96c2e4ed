// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/mirrors/vertex_wedges_3.h>

#include "catch.h"
#include "domain/shapes.h"
#include "refinement/any_threads.h"
#include "seeded_random.h"

using namespace pgdr_test;
using pgdr::Plc;
using pgdr::Vec_3;

namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// A triangle in the plane z = 0, with a corner at the origin, in a box.
Plc triangle_in_a_box() {
  Plc plc = box();
  for (auto& v : plc.vertices) v = {3 * v.x() - 1.5, 3 * v.y() - 1.5, 3 * v.z() - 1.5};
  plc.vertices.insert(plc.vertices.end(), {{0, 0, 0}, {1, -0.6, 0}, {1.1, 0.5, 0}});
  plc.facets.emplace_back().polygons = {{8, 9, 10}};
  return plc;
}

/// Another one above it with the same corner, turned by an angle, in degrees, about the y axis.
Plc facet_above(double degrees) {
  const double c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
  Plc plc = triangle_in_a_box();
  plc.vertices.insert(plc.vertices.end(), {{0.9 * c, -0.3, 0.9 * s}, {0.8 * c, 0.7, 0.8 * s}});
  plc.facets.emplace_back().polygons = {{8, 11, 12}};
  return plc;
}

/// Another one that is steep, with a side at that angle above the first.
Plc segment_above(double degrees) {
  const double c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
  Plc plc = triangle_in_a_box();
  plc.vertices.insert(plc.vertices.end(), {{0.8 * c, 0, 0.8 * s}, {0.5, 0.3, 0.4}});
  plc.facets.emplace_back().polygons = {{8, 11, 12}};
  return plc;
}

}  // namespace

TEST_CASE("An image on a facet below is at the like place, and no nearer to a point of that facet", "[conforming]") {
  Seeded_random random(4);
  for (int k = 0; k < 200; ++k) {
    const bool is_segment = k % 2 == 0;
    const double degrees = random.between(0.01, is_segment ? 1.9 : 4), d = random.between(0.1, 0.7);
    CAPTURE(is_segment, degrees, d);
    const auto domain = pgdr::make_domain_3(is_segment ? segment_above(degrees) : facet_above(degrees));
    const pgdr::Vertex_wedges_3 wedges(domain, pgdr::small_angles_3(domain));
    const auto has_corners = [&](const auto& vertices, pgdr::Index a, pgdr::Index b) {
      return std::ranges::find(vertices, a) != vertices.end() && std::ranges::find(vertices, b) != vertices.end();
    };
    pgdr::Feature_id upper{is_segment ? 1 : 2, 0};
    if (is_segment)
      while (!has_corners(domain.segments[upper.index].vertices, 8, 11)) ++upper.index;
    else
      while (!has_corners(domain.facets[upper.index].vertices, 8, 11)) ++upper.index;
    // On the plane above, seen along the y axis at the like place in the plane below.
    const double y = is_segment ? 0 : random.between(-0.2, 0.3) * d;
    const Vec_3 q{d * std::cos(radians(degrees)), y, d * std::sin(radians(degrees))}, like{d, y, 0};
    const double gap = pgdr::length(q - like);
    int found = 0;
    wedges.for_each_image(upper, q, 0.5, 1.0001 * gap, [&](const pgdr::Mirror_image& i) {
      ++found;
      REQUIRE(i.on.dimension == 2);
      CHECK(has_corners(domain.facets[i.on.index].vertices, 8, 9));
      CHECK(wedges.are_close(upper, i.on));
      CHECK(wedges.are_close(i.on, upper));
      CHECK(i.at.z == Approx(0).margin(1e-15));
      CHECK(pgdr::length(i.at - like) <= 1e-6 * gap);
      const Vec_3 center{random.between(0, 1), random.between(-1, 1), 0};
      if (center.x > 0.5 * d) CHECK(pgdr::length(q - center) >= pgdr::length(i.at - center) * (1 - 1e-12));
    });
    CHECK(found == 1);
    wedges.for_each_image(upper, q, 0.5, 0.9999 * gap, [&](const pgdr::Mirror_image&) { FAIL("there is one that far away"); });
  }
}

TEST_CASE("What meets a facet in a corner no wider than the gap has no image there", "[conforming]") {
  // A pyramid whose opposite sides are as far apart as they are wide.
  Plc plc;
  plc.vertices = {{0, 0, 0}, {1, -0.02, -0.02}, {1, 0.02, -0.02}, {1, 0.02, 0.02}, {1, -0.02, 0.02}};
  for (const std::vector<pgdr::Index>& side : {std::vector<pgdr::Index>{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {1, 2, 3, 4}}) plc.facets.emplace_back().polygons = {side};
  const auto domain = pgdr::make_domain_3(plc);
  const pgdr::Vertex_wedges_3 wedges(domain, pgdr::small_angles_3(domain));
  for (pgdr::Index f = 0; f < domain.facets.size(); ++f)
    wedges.for_each_image({2, f}, {0.5, 0, 0.01}, 1, 1, [&](const pgdr::Mirror_image&) { FAIL("an image"); });
}

TEST_CASE("What a feature above a facet costs does not depend on how close it is", "[conforming][refinement]") {
  for (const auto& above : {segment_above, facet_above}) {
    std::vector<std::size_t> numbers;
    for (const double degrees : {0.1, 0.02, 0.005}) numbers.push_back(mesh_with_any_threads(above(degrees), 5000).tetrahedra.size());
    CAPTURE(numbers);
    const auto [least, most] = std::ranges::minmax(numbers);
    CHECK(static_cast<double>(most) <= 1.5 * static_cast<double>(least));
  }
}
