// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/mirrors/wedges_3.h>

#include "catch.h"
#include "domain/shapes.h"
#include "refinement/refined.h"
#include "seeded_random.h"

using namespace pgdr_test;
using pgdr::Plc;
using pgdr::Vec_3;

namespace {

/// A tetrahedron whose first two triangles meet at an angle, in degrees, on the edge from (0, 0, 0) to (0, 0, 1).
Plc wedge(Random& random, double degrees) {
  const double phi = degrees * std::numbers::pi / 180;
  const double r = random.between(0.3, 2), s = random.between(0.3, 2);
  Plc plc;
  plc.vertices = {{0, 0, 0},
                  {0, 0, 1},
                  {r, 0, random.between(-0.5, 1.5)},
                  {s * std::cos(phi), s * std::sin(phi), random.between(-0.5, 1.5)}};
  plc.facets.resize(4);
  plc.facets[0].polygons = {{0, 1, 2}};
  plc.facets[1].polygons = {{0, 1, 3}};
  plc.facets[2].polygons = {{1, 2, 3}};
  plc.facets[3].polygons = {{2, 0, 3}};
  return plc;
}

/// A unit cube whose top is divided along a diagonal, with a triangle of height `h` on it whose apex is at `along` of its length.
Plc capped_cube(double h, double along) {
  const double x = along - h / std::numbers::sqrt2, y = along + h / std::numbers::sqrt2;
  Plc plc = box();
  plc.vertices.emplace_back(x, y, 1);
  plc.facets.erase(plc.facets.begin() + 1);  // the top
  int marker = 1;
  for (const std::vector<pgdr::Index>& part : {std::vector<pgdr::Index>{4, 5, 7}, {4, 7, 8}, {4, 8, 7, 6}}) plc.facets.push_back({{part}, {}, marker++});
  return plc;
}

/// Refinement ends with a mesh that passes, of so many vertices at most.
void check_ends(const Plc& plc, std::size_t most) {
  pgdr::Parameters parameters;
  parameters.max_vertices = most;
  const Mesh mesh = refined(plc, std::numeric_limits<double>::infinity(), parameters);
  CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
  CHECK(mesh.statistics().unrecovered == 0);
  CHECK(failures(pgdr::check_mesh(pgdr::indexed_mesh_3(mesh), &mesh.domain())) == "");
}

}  // namespace

TEST_CASE("An image on a segment is as far from the corner, and vertices at like places are in no diametral ball", "[conforming]") {
  Seeded_random random(3);
  for (int k = 0; k < 100; ++k) {
    const auto domain = pgdr::make_domain_3(capped_cube(std::pow(10.0, random.between(-8, -2)), random.between(0.3, 0.7)));
    const pgdr::Segment_wedges_3 wedges(domain, pgdr::domain_detail::Facet_edges(domain));
    const Vec_3 apex = pgdr::to_vec(domain.vertices[8]);
    int found = 0;
    for (pgdr::Index s = 0; s < domain.segments.size(); ++s)
      wedges.for_each_image(s, apex, 0.1, [&](const pgdr::Mirror_image& i) {
        REQUIRE(i.on.dimension == 1);
        const auto& ends = domain.segments[i.on.index].vertices;
        REQUIRE((ends[0] == 4 && ends[1] == 7));  // the diagonal
        const auto& own = domain.segments[s].vertices;
        const Vec_3 corner = pgdr::to_vec(domain.vertices[own[0] == 8 ? own[1] : own[0]]);
        const double d = pgdr::length(apex - corner);
        CHECK(pgdr::length(i.at - corner) == Approx(d));
        for (const auto& [a, b] : {std::pair{random.between(0, d), d}, std::pair{d, random.between(d, 1.4)}}) {
          const Vec_3 u = (1 / d) * (i.at - corner);
          CHECK(pgdr::dot(apex - corner - a * u, apex - corner - b * u) >= -1e-12);
        }
        ++found;
      });
    CHECK(found == 2);  // one from either end
  }
}

TEST_CASE("What a low triangle costs does not depend on how low it is", "[conforming]") {
  for (const double h : {1e-4, 1e-5, 1e-7})
    for (const double along : {0.3, 0.5, 0.99, 0.999}) {
      CAPTURE(h, along);
      check_ends(capped_cube(h, along), 3000);
    }
}

TEST_CASE("A mirror image is as high over the segment, and no nearer to a point of the other facet", "[conforming]") {
  Seeded_random random(1);
  int near = 0;
  for (int k = 0; k < 500; ++k) {
    const double degrees = random.between(0.5, 29.9), phi = degrees * std::numbers::pi / 180;
    const auto domain = pgdr::make_domain_3(wedge(random, degrees));
    const pgdr::Facet_wedges_3 wedges(domain, pgdr::domain_detail::Facet_edges(domain));
    // Facet 0 is in the plane y = 0, facet 1 turned by phi about the z axis.
    REQUIRE(domain.facets.size() == 4);
    const double h = random.between(0.01, 2);
    const Vec_3 q{h, 0, random.between(0.01, 0.99)};
    const double gap = 2 * h * std::sin(phi / 2);
    CAPTURE(k, degrees, h);
    int found = 0;
    wedges.for_each_image(0, q, gap * 1.0001, true, [&](const pgdr::Mirror_image& i) {
      if (i.on.index != 1) return;
      ++found;
      CHECK(i.at.x == Approx(h * std::cos(phi)));
      CHECK(i.at.y == Approx(h * std::sin(phi)));
      CHECK(i.at.z == Approx(q.z));
      CHECK(pgdr::length(i.at - q) == Approx(gap));
      // The center of a ball around a subfacet of facet 1.
      const double height = random.between(0, 2);
      const Vec_3 c{height * std::cos(phi), height * std::sin(phi), random.between(-1, 2)};
      CHECK(pgdr::squared_distance(q, c) - pgdr::squared_distance(i.at, c) ==
            Approx(2 * h * height * (1 - std::cos(phi))).margin(1e-12));
    });
    // Beyond the bounding box of facet 1 there is none of that facet.
    Vec_3 lower = pgdr::to_vec(domain.vertices[0]), upper = lower;
    for (const pgdr::Index v : {1, 3}) {
      const Vec_3 p = pgdr::to_vec(domain.vertices[v]);
      lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
      upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
    }
    const double x = h * std::cos(phi), y = h * std::sin(phi);
    const bool is_near = lower.x <= x && x <= upper.x && lower.y <= y && y <= upper.y && lower.z <= q.z && q.z <= upper.z;
    CHECK(found == (is_near ? 1 : 0));
    near += is_near;
    const auto is_other = [&](const pgdr::Mirror_image& i) { CHECK(i.on.index != 1); };
    wedges.for_each_image(0, q, gap * 0.9999, true, is_other);
    wedges.for_each_image(0, Vec_3{-h, 0, 0.5}, 1e9, true, is_other);
  }
  CHECK(near > 100);
  CHECK(near < 400);
}

TEST_CASE("Two facets at a small angle, with different other edges, are conformed to", "[conforming]") {
  Seeded_random random(2);
  for (const double degrees : {2, 5, 10, 20, 29})
    for (int k = 0; k < 10; ++k) {
      CAPTURE(degrees, k);
      check_ends(wedge(random, degrees), 100000);
    }
}
