// SPDX-License-Identifier: GPL-3.0-or-later
// Tasks of touching leaves may follow each other in any order: the mesh is valid, and a function of the order alone.
#include <cstdint>
#include <set>

#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "inputs.h"
#include "schedule/runs.h"

using namespace pgdr_test;

namespace {

/// Random orders: each mesh is checked in full, the task zones, too, and is the same for other numbers of threads.
void require_valid_meshes(const pgdr::Plc& plc, const pgdr::Combined_sizing_field& sizing) {
  const std::uint64_t orders = is_nightly() ? 20 : 4;
  std::set<std::uint64_t> checksums;
  for (std::uint64_t order = 1; order <= orders; ++order) {
    pgdr::Parameters parameters;
    parameters.task_order = order;
    parameters.check_zones = true;
    parameters.threads = 4;
    const Mesh mesh = pgdr::refine_mesh_3(plc, sizing, parameters);
    const Outcome first(mesh);
    CAPTURE(order, first.mesh.tetrahedra.size());
    CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
    CHECK(failures(pgdr::check_mesh(first.mesh, &mesh.domain())) == "");
    CHECK(oversized(first.mesh, sizing) == 0);
    REQUIRE(first.most_ready() >= 3);
    parameters.check_zones = false;
    parameters.threads = 1 + order % 3;
    CHECK(difference(first, "", Outcome(plc, sizing, parameters)) == "");
    checksums.insert(first.checksum);
  }
  CHECK(checksums.size() == orders);
}

}  // namespace

TEST_CASE("The leaves of a cube are refined in random orders", "[schedule]") {
  require_valid_meshes(pgdr::read_plc(data_file("cube.poly")),
                       pgdr::Combined_sizing_field(pgdr::Uniform_sizing_field(0.025)));
}

TEST_CASE("The leaves around a body are refined in random orders", "[schedule]") {
  require_valid_meshes(pgdr::read_plc(data_file("winged_body_in_box.poly")), around_the_body());
}
