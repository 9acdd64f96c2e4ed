// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/mirrors/shells_3.h>
#include <pgdr/mirrors/wedges_3.h>
#include <pgdr/quality/mesh_quality.h>

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

TEST_CASE("An image on a segment is about as far from the corner, and vertices at like places are in no diametral ball", "[conforming]") {
  Seeded_random random(3);
  for (int k = 0; k < 100; ++k) {
    const auto domain = pgdr::make_domain_3(capped_cube(std::pow(10.0, random.between(-8, -2)), random.between(0.3, 0.7)));
    const pgdr::Shells_3 shells(domain, pgdr::small_angles_3(domain));
    const pgdr::Segment_wedges_3 wedges(domain, pgdr::domain_detail::Facet_edges(domain), shells);
    const Vec_3 apex = pgdr::to_vec(domain.vertices[8]);
    int found = 0;
    for (pgdr::Index s = 0; s < domain.segments.size(); ++s)
      wedges.for_each_image(s, apex, 0.1, [&](const pgdr::Mirror_image& i) {
        REQUIRE(i.on.dimension == 1);
        const auto& ends = domain.segments[i.on.index].vertices;
        REQUIRE((ends[0] == 4 && ends[1] == 7));  // the diagonal
        const auto& own = domain.segments[s].vertices;
        const Vec_3 corner = pgdr::to_vec(domain.vertices[own[0] == 8 ? own[1] : own[0]]);
        const double d = pgdr::length(i.at - corner);
        const Vec_3 u = (1 / d) * (i.at - corner), v = (1 / pgdr::length(apex - corner)) * (apex - corner);
        CHECK(std::abs(pgdr::length(apex - corner) / d - 1) <= pgdr::squared_length(u - v) / 16 + 1e-15);
        for (const auto& [a, b] : {std::pair{random.between(0, d), d}, std::pair{d, random.between(d, 1.4)}}) {
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

TEST_CASE("The shells of segments that meet differ, but by less than their angle allows", "[conforming]") {
  Seeded_random random(4);
  for (int k = 0; k < 100; ++k) {
    const double degrees = std::pow(10, random.between(-4, 1.8));
    CAPTURE(k, degrees);
    const auto domain = pgdr::make_domain_3(wedge(random, degrees));
    const pgdr::Small_angles angles = pgdr::small_angles_3(domain);
    const pgdr::Shells_3 shells(domain, angles);
    const auto other_end = [&](pgdr::Index s, pgdr::Index v) { return domain.segments[s].vertices[domain.segments[s].vertices[0] == v ? 1 : 0]; };
    for (pgdr::Index s = 0; s < domain.segments.size(); ++s)
      for (const pgdr::Index v : domain.segments[s].vertices)
        for (pgdr::Index t = 0; t < s; ++t) {
          if (std::ranges::count(domain.segments[t].vertices, v) == 0) continue;
          const auto unit = [&](pgdr::Index segment) {
            const Vec_3 d = pgdr::to_vec(domain.vertices[other_end(segment, v)]) - pgdr::to_vec(domain.vertices[v]);
            return (1 / pgdr::length(d)) * d;
          };
          const Vec_3 u = unit(s), w = unit(t);
          const double difference = std::abs(shells.factor(s, v) - shells.factor(t, v));
          CHECK(difference <= pgdr::squared_length(u - w) / 16 + 1e-15);
          CHECK(difference <= 1e-7);
          if (angles.vertex_deg[v] > 0.01) CHECK((difference > 1e-12) == (angles.vertex_deg[v] < pgdr::Shells_3::limit));
        }
  }
}

TEST_CASE("A mirror image is about as high over the segment, and no nearer to a point of the other facet", "[conforming]") {
  Seeded_random random(1);
  int near = 0, balls = 0;
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
    const double radius = random.between(gap, 2);
    wedges.for_each_image(0, q, radius, gap * 1.0001, true, [&](const pgdr::Mirror_image& i) {
      if (i.on.index != 1) return;
      ++found;
      const Vec_3 like{h * std::cos(phi), h * std::sin(phi), q.z};
      const double aside = pgdr::length(i.at - like);
      const double along = std::abs(pgdr::dot(Vec_3{std::cos(phi) - 1, std::sin(phi), 0}, pgdr::aslant));
      CHECK(aside == Approx(std::min(gap * gap / (8 * radius), 1e-6 * along * h)).epsilon(0.01).margin(1e-15));
      CHECK(pgdr::dot(i.at, Vec_3{std::sin(phi), -std::cos(phi), 0}) == Approx(0).margin(1e-12));
      // The center of a ball with i.at outside that is on facet 1, no larger than height above the segment and insertion radius allow.
      const double height = random.between(0, 2);
      const Vec_3 c{height * std::cos(phi), height * std::sin(phi), random.between(-1, 2)};
      const double r = pgdr::length(i.at - c);
      if (height / r < h / (4 * radius)) return;
      CHECK(pgdr::length(q - c) >= r * (1 - 1e-12));
      ++balls;
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
    wedges.for_each_image(0, q, radius, gap * 0.9999, true, is_other);
    wedges.for_each_image(0, Vec_3{-h, 0, 0.5}, radius, 1e9, true, is_other);
  }
  CHECK(near > 100);
  CHECK(near < 400);
  CHECK(balls > 50);
}

TEST_CASE("Images of one vertex in several facets around a segment are not at like places", "[conforming]") {
  Plc plc;
  plc.vertices = {{0, 0, 0}, {0, 0, 1}};
  for (const double degrees : {0, 8, 17, 25}) {
    plc.vertices.emplace_back(std::cos(degrees * std::numbers::pi / 180), std::sin(degrees * std::numbers::pi / 180), 0.5);
    plc.facets.emplace_back().polygons = {{0, 1, static_cast<pgdr::Index>(plc.vertices.size() - 1)}};
  }
  const auto domain = pgdr::make_domain_3(plc);
  const pgdr::Facet_wedges_3 wedges(domain, pgdr::domain_detail::Facet_edges(domain));
  const Vec_3 q{0.3, 0, 0.5};
  std::vector<Vec_3> places{q};  // height, 0, along the segment
  wedges.for_each_image(0, q, 0.5, 1, true, [&](const pgdr::Mirror_image& i) { places.push_back({std::hypot(i.at.x, i.at.y), 0, i.at.z}); });
  REQUIRE(places.size() == 4);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      CAPTURE(i, j);
      CHECK(pgdr::length(places[i] - places[j]) > 1e-9);
      CHECK(pgdr::length(places[i] - places[j]) < 1e-6);
    }
}

TEST_CASE("Points at like places make no tetrahedron that is flat but for rounding", "[conforming]") {
  Seeded_random random(5);
  for (const double degrees : {1, 2, 4, 8})
    for (int k = 0; k < 5; ++k) {
      CAPTURE(degrees, k);
      const Mesh mesh = refined(wedge(random, degrees), 0.05);
      CHECK(pgdr::mesh_quality(pgdr::indexed_mesh_3(mesh)).min_dihedral_deg > 1e-3);
    }
}

TEST_CASE("Two facets at a small angle, with different other edges, are conformed to", "[conforming]") {
  Seeded_random random(2);
  for (const double degrees : {2, 5, 10, 20, 29})
    for (int k = 0; k < 10; ++k) {
      CAPTURE(degrees, k);
      check_ends(wedge(random, degrees), 100000);
    }
}
