// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <limits>
#include <vector>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/acute/protected_balls_3.h>
#include <pgdr/domain/make_domain_3.h>
#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "inputs.h"
#include "refinement/refined.h"

using namespace pgdr_test;
using pgdr::Plc;
using pgdr::Protected_balls_3;
using pgdr::Vec_3;

namespace {

/// A triangle with a vertex in the origin, and a second one below that passes the origin at a distance.
Plc two_triangles(double distance) {
  Plc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {-1, -1, -distance}, {1, -1, -distance}, {0, 2, -distance}};
  plc.facets.resize(2);
  plc.facets[0].polygons = {{0, 1, 2}};
  plc.facets[1].polygons = {{3, 4, 5}};
  return plc;
}

/// Whether x is a power of two.
bool is_power_of_two(double x) {
  int exponent = 0;
  return std::frexp(x, &exponent) == 0.5;
}

}  // namespace

TEST_CASE("Protected balls leave half of each segment, keep clear of other features, and have powers of two for radii", "[conforming]") {
  for (const double distance : {1.0, 1e-2, 1e-4, 1e-5}) {
    CAPTURE(distance);
    const auto domain = pgdr::make_domain_3(two_triangles(distance));
    const Protected_balls_3 balls(domain, {true, false, false, false, false, false});
    const double largest = std::min(0.25, distance / 2);
    CHECK(balls.radius(0) <= largest);
    CHECK(balls.radius(0) > largest / 2);
    CHECK(is_power_of_two(balls.radius(0)));
    CHECK(balls.largest() == balls.radius(0));
    CHECK(balls.radius(1) == 0);

    const double r = balls.radius(0);
    CHECK(balls.find(Vec_3{0.9 * r, 0, 0}) == 0);
    CHECK(balls.find(Vec_3{1.1 * r, 0, 0}) == Protected_balls_3::none);
    CHECK(balls.find(Vec_3{1, 0, 0}) == Protected_balls_3::none);
    // On the sphere is not inside, whatever rounding says.
    for (int k = 0; k < 100; ++k) {
      const Vec_3 p = balls.on_sphere(0, {std::cos(k), std::sin(k), 0.1 * k});
      CHECK(pgdr::length(p) == Approx(r));
      CHECK(balls.find(p) == Protected_balls_3::none);
      CHECK(balls.contains_segment(0, p));
    }
    CHECK_FALSE(balls.contains_segment(0, {0, 1.001 * r, 0}));
    CHECK(balls.find({0.5 * r, 0, 0}, 0.25 * r * r) == 0);
    CHECK(balls.find({0.5 * r, 0, 0}, 4 * r * r) == Protected_balls_3::none);
  }
}

TEST_CASE("Features get no points in a protected ball", "[conforming]") {
  // Facets that are seven degrees apart: without the balls, their points came ever closer to the ends of the common edge.
  const Mesh mesh = refined(pgdr::read_plc(data_file("../test/corpus/fan_134.poly")), std::numeric_limits<double>::infinity());
  const pgdr::Acute_neighborhood_3 acute(mesh.domain());
  CHECK(mesh.statistics().unrecovered == 0);
  std::size_t on_sphere = 0;
  for (const auto v : mesh.triangulation().finite_vertex_handles()) {
    if (v->in_dimension() != 1 && v->in_dimension() != 2) continue;
    const Vec_3 p = pgdr::position(v);
    CHECK(acute.balls().find(p) == Protected_balls_3::none);
    for (pgdr::Index c = 0; c < mesh.domain().vertices.size(); ++c) {
      const double distance = pgdr::length(p - pgdr::to_vec(mesh.domain().vertices[c]));
      on_sphere += distance == Approx(acute.balls().radius(c));
    }
  }
  CHECK(on_sphere > 0);
}
