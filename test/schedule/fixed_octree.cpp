// SPDX-License-Identifier: GPL-3.0-or-later
// The fixed octree of the paper, for comparison.
#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "domain/shapes.h"
#include "inputs.h"
#include "schedule/runs.h"

using namespace pgdr_test;

TEST_CASE("On a fixed octree the mesh is the same for every number of threads", "[schedule]") {
  const pgdr::Plc cube = pgdr::read_plc(data_file("cube.poly"));
  std::size_t leaves = 1;
  for (int depth = 1; depth <= 5; ++depth, leaves *= 8) {
    pgdr::Parameters parameters;
    parameters.octree_depth = depth;
    parameters.threads = 1;
    const Mesh mesh = pgdr::refine_mesh_3(cube, size(0.03), parameters);
    const Outcome first(mesh);
    CAPTURE(depth, first.mesh.tetrahedra.size());
    CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
    CHECK(failures(pgdr::check_mesh(first.mesh, &mesh.domain())) == "");
    CHECK(pgdr::mesh_quality(first.mesh).max_circumradius <= 0.03 * (1 + 1e-9));
    const auto& epochs = first.statistics.schedule.epochs;
    REQUIRE(!epochs.empty());
    CHECK(epochs.back().leaves == leaves);
    std::size_t tasks = 0;
    for (const auto& e : epochs) tasks += e.tasks;
    // Conditions (18) of depth 4 and more ask for less than the size: the first task, alone, does everything.
    CHECK((tasks > 1) == (depth == 2 || depth == 3));
    // The condition of depth 3 holds well before the mesh is done, and there is work in every leaf.
    if (depth == 3) {
      CHECK(epochs.back().most_ready >= 8);
      CHECK(epochs.back().tasks >= 64);
      CHECK(epochs.back().inserted_alone == 0);
    }
    for (const unsigned threads : {2u, 4u, 16u}) {
      CAPTURE(threads);
      parameters.threads = threads;
      parameters.check_zones = threads != 2;
      CHECK(difference(first, "", Outcome(cube, size(0.03), parameters)) == "");
    }
  }
}

TEST_CASE("A tilted shape is meshed on a fixed octree", "[schedule]") {
  for (const int depth : {2, 4}) {
    pgdr::Parameters parameters;
    parameters.octree_depth = depth;
    parameters.threads = 2;
    parameters.check_zones = true;
    const Mesh mesh = pgdr::refine_mesh_3(tilted(box({0, 0, 0}, {3, 2, 1})), size(0.1), parameters);
    const Outcome first(mesh);
    CAPTURE(depth, first.tasks());
    CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
    CHECK(failures(pgdr::check_mesh(first.mesh, &mesh.domain())) == "");
    parameters.threads = 8;
    CHECK(difference(first, "", Outcome(tilted(box({0, 0, 0}, {3, 2, 1})), size(0.1), parameters)) == "");
  }
}
