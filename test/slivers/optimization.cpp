// SPDX-License-Identifier: GPL-3.0-or-later
// Better on average, and everything that held before still does.
#include <pgdr/slivers/optimize_mesh_3.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <string>

#include <pgdr/io/read_plc.h>
#include <pgdr/quality/mesh_quality.h>

#include "catch.h"
#include "inputs.h"
#include "refinement/refined.h"
#include "thread_counts.h"

using namespace pgdr_test;

namespace {

Mesh optimized(const pgdr::Plc& plc, double size, std::size_t rounds, unsigned threads = 0, double angle = pgdr::Parameters().min_dihedral) {
  pgdr::Parameters parameters;
  parameters.min_dihedral = angle;
  parameters.optimization_rounds = rounds;
  parameters.threads = threads;
  parameters.verify = true;
  return refined(plc, size, parameters);
}

}  // namespace

TEST_CASE("Optimized meshes are better on average, with no smaller angle than was asked for", "[slivers]") {
  for (const auto& [file, size] : {Sized_shape{"cube.poly", 0.06}, {"two_regions.poly", 0.15}, {"winged_body_in_box.poly", std::numeric_limits<double>::infinity()}}) {
    CAPTURE(file);
    const pgdr::Plc plc = pgdr::read_plc(data_file(file));
    const pgdr::Mesh_quality before = pgdr::mesh_quality(pgdr::indexed_mesh_3(optimized(plc, size, 0)));
    double last = before.mean_ratio.mean;
    for (const std::size_t rounds : {1u, 3u}) {
      CAPTURE(rounds);
      const Mesh mesh = optimized(plc, size, rounds);
      const pgdr::Indexed_mesh_3 arrays = pgdr::indexed_mesh_3(mesh);
      const pgdr::Mesh_quality after = pgdr::mesh_quality(arrays);
      CHECK(mesh.statistics().optimization.rounds == rounds);
      CHECK(mesh.statistics().optimization.moved > 0);
      CHECK(after.vertices == before.vertices);
      CHECK(after.mean_ratio.mean > last);
      last = after.mean_ratio.mean;
      CHECK(after.min_dihedral_deg >= std::min(before.min_dihedral_deg, pgdr::Parameters().min_dihedral) - 1e-6);
      CHECK(after.tetrahedra_below[4] < before.tetrahedra_below[4]);
      CHECK(failures(pgdr::check_mesh(arrays, &mesh.domain())) == "");
    }
  }
}

TEST_CASE("Optimized meshes are the same for every number of threads", "[slivers]") {
  const pgdr::Plc plc = pgdr::read_plc(data_file("two_regions.poly"));
  const auto run = [&](unsigned threads) { return pgdr::indexed_mesh_3(optimized(plc, 0.075, 3, threads)); };
  const pgdr::Indexed_mesh_3 one = run(1);
  CHECK(one.points.size() > 4000);  // enough for territories
  for (const unsigned threads : thread_counts()) {
    CAPTURE(threads);
    CHECK(equal(run(threads), one));
  }
}

TEST_CASE("Optimization ends where nothing moves any more", "[slivers]") {
  const pgdr::Plc plc = pgdr::read_plc(data_file("cube.poly"));
  for (const double size : {0.15, 0.07}) {  // without and with territories
    const Mesh mesh = optimized(plc, size, 2000);
    const std::size_t rounds = mesh.statistics().optimization.rounds;
    CHECK(rounds < 2000);
    const Mesh more = optimized(plc, size, rounds + 7);
    CHECK(more.statistics().optimization.moved == mesh.statistics().optimization.moved);
    CHECK(equal(pgdr::indexed_mesh_3(more), pgdr::indexed_mesh_3(mesh)));
  }
}

TEST_CASE("Without a wanted angle no star gets a smaller one than it has", "[slivers]") {
  const pgdr::Plc plc = pgdr::read_plc(data_file("cube.poly"));
  const pgdr::Mesh_quality before = pgdr::mesh_quality(pgdr::indexed_mesh_3(optimized(plc, 0.06, 0, 0, 0)));
  const pgdr::Mesh_quality after = pgdr::mesh_quality(pgdr::indexed_mesh_3(optimized(plc, 0.06, 2, 0, 0)));
  CHECK(after.min_dihedral_deg >= before.min_dihedral_deg * (1 - 1e-6));
  CHECK(after.mean_ratio.mean > before.mean_ratio.mean);
}

TEST_CASE("Optimization that is cancelled leaves a valid mesh, and says so", "[slivers]") {
  std::atomic<bool> cancel = false;
  pgdr::Parameters parameters;
  parameters.optimization_rounds = 1000;
  parameters.verify = true;
  parameters.cancel = &cancel;
  parameters.progress = [&](const pgdr::Progress& p) { cancel = cancel || std::string(p.phase) == "optimization"; };
  const Mesh mesh = refined(pgdr::read_plc(data_file("cube.poly")), 0.06, parameters);
  CHECK(mesh.statistics().stop == pgdr::Stop_reason::cancelled);
  CHECK(mesh.statistics().optimization.rounds < 1000);
  const pgdr::Indexed_mesh_3 arrays = pgdr::indexed_mesh_3(mesh);
  CHECK(arrays.unrefined.empty());
  CHECK(failures(pgdr::check_mesh(arrays, &mesh.domain())) == "");
}
