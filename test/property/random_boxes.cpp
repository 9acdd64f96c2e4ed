// SPDX-License-Identifier: GPL-3.0-or-later
#include "property/random_boxes.h"

#include "catch.h"
#include "conforming/consistency.h"

using namespace pgdr_test;

TEST_CASE("Random boxes without acute angles are meshed, whatever their position and scale", "[property]") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    double scale = 1;
    const Plc plc = moved_at_random(Random_boxes(seed).make(), seed, scale);
    CAPTURE(seed, scale, plc.vertices.size());
    const auto domain = pgdr::make_domain_3(plc);
    REQUIRE(pgdr::validate_domain_3(domain).empty());
    pgdr::Parameters parameters;
    parameters.max_vertices = 200000;
    const double size =
        seed % 2 ? std::numeric_limits<double>::infinity() : Random(seed).between(0.3, 2) * scale;
    const Mesh mesh = pgdr::refine_mesh_3(domain, pgdr::Uniform_sizing_field(size), parameters);
    REQUIRE(mesh.statistics().stop == pgdr::Stop_reason::finished);
    const std::string fault = inconsistency(mesh.triangulation(), mesh.complex());
    CAPTURE(fault);
    CHECK(fault.empty());
    const auto indexed = pgdr::indexed_mesh_3(mesh);
    const std::string failed = failures(pgdr::check_mesh(indexed, &domain));
    CAPTURE(failed);
    CHECK(failed.empty());
    CHECK(indexed.exempt.empty());
    CHECK(pgdr::mesh_quality(indexed).max_circumradius <= size * (1 + 1e-9));
  }
}
