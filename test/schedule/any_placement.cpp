// SPDX-License-Identifier: GPL-3.0-or-later
// The schedule asks nothing of a Steiner point but where it is: the guarantees hold for any point of the selection ball.
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/refinement/point_placement.h>

#include "catch.h"
#include "inputs.h"
#include "schedule/runs.h"

using namespace pgdr_test;
using pgdr::Poor_tetrahedron;
using pgdr::Vec_3;

namespace {

/// One type for all placements of this file, so that the engine is compiled once.
struct Placement {
  Vec_3 (*at)(const Poor_tetrahedron&);
  pgdr::Lazy_placement choice = {};
  Vec_3 operator()(const Poor_tetrahedron& t) const { return at(t); }
  double enough(const Poor_tetrahedron& t) const { return choice.enough(t); }
  void alternatives(const Poor_tetrahedron& t, pgdr::Point_choice& points) const { choice.alternatives(t, points); }
};
static_assert(pgdr::ChoosingPlacement<Placement>);

/// Anywhere in the ball, evenly spread over its volume: random numbers from the bits of the circumcenter.
Vec_3 scattered(const Poor_tetrahedron& t, double radius) {
  const Vec_3& c = t.ball.center;
  std::uint64_t state = std::bit_cast<std::uint64_t>(c.x) ^ std::rotl(std::bit_cast<std::uint64_t>(c.y), 21) ^
                        std::rotl(std::bit_cast<std::uint64_t>(c.z), 42);
  Random random(state);
  const double z = random.between(-1, 1), angle = random.between(0, 2 * std::numbers::pi);
  const double r = 0.999 * radius * std::cbrt(random.between(0, 1)), s = std::sqrt(1 - z * z);
  return c + r * Vec_3{s * std::cos(angle), s * std::sin(angle), z};
}

Mesh run(const pgdr::Plc& plc, const pgdr::Combined_sizing_field& sizing, const pgdr::Parameters& parameters,
         const Placement& placement) {
  return pgdr::refine_mesh_3(pgdr::make_domain_3(plc, parameters.coplanar_tolerance, false), sizing,
                             parameters, placement);
}

/// The same mesh for every number of threads, valid, with the bound kept, and other than with circumcenters.
void require_same_mesh_with(const Placement& placement, const pgdr::Plc& plc,
                            const pgdr::Combined_sizing_field& sizing, double bound) {
  pgdr::Parameters parameters;
  parameters.radius_edge_ratio = bound;
  parameters.check_zones = true;
  parameters.threads = 4;
  const Mesh mesh = run(plc, sizing, parameters, placement);
  const Outcome first(mesh);
  CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
  CHECK(failures(pgdr::check_mesh(first.mesh, &mesh.domain(), {bound})) == "");
  CHECK(oversized(first.mesh, sizing) == 0);
  REQUIRE(first.tasks() >= 100);
  REQUIRE(first.most_ready() >= 8);
  CHECK(first.checksum != Outcome(plc, sizing, parameters).checksum);
  parameters.check_zones = false;
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    CAPTURE(threads);
    parameters.threads = threads;
    REQUIRE(difference(first, "", Outcome(run(plc, sizing, parameters, placement))) == "");
  }
}

const Placement in_type_1{[](const Poor_tetrahedron& t) { return scattered(t, t.type_1_radius()); }};
const Placement in_type_2{[](const Poor_tetrahedron& t) { return scattered(t, t.type_2_radius()); }};
const Placement near_edges{[](const Poor_tetrahedron& t) { return pgdr::Type_1_placement()(t); }};

}  // namespace

TEST_CASE("Steiner points may be anywhere in the selection ball", "[schedule]") {
  const auto plc = pgdr::read_plc(data_file("cube.poly"));
  const pgdr::Combined_sizing_field sizing(pgdr::Uniform_sizing_field(0.023));
  require_same_mesh_with(in_type_1, plc, sizing, 2);
  require_same_mesh_with(in_type_1, plc, sizing, 4);
  require_same_mesh_with(in_type_2, plc, sizing, 4);
}

TEST_CASE("Steiner points may be anywhere in the selection ball around a body, too", "[schedule]") {
  const auto plc = pgdr::read_plc(data_file("winged_body_in_box.poly"));
  require_same_mesh_with(in_type_1, plc, around_the_body(), 2);
  require_same_mesh_with(near_edges, plc, around_the_body(), 4);
}

TEST_CASE("A choice among several points is the same for every number of threads", "[schedule]") {
  const Placement lazy{[](const Poor_tetrahedron& t) { return t.ball.center; }, {pgdr::cosine_of_degrees(25)}};
  require_same_mesh_with(lazy, pgdr::read_plc(data_file("winged_body_in_box.poly")), around_the_body(), 2);
}
