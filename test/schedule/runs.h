// SPDX-License-Identifier: GPL-3.0-or-later
// What a run leaves that must not depend on the number of threads.
#ifndef PGDR_TEST_SCHEDULE_RUNS_H
#define PGDR_TEST_SCHEDULE_RUNS_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <pgdr/io/write_mesh.h>

#include "catch.h"
#include "io/temporary_folder.h"
#include "refinement/refined.h"
#include "thread_counts.h"

namespace pgdr_test {

/// The decisions of the scheduler, without times: what it did in every epoch, and between the waves.
inline std::vector<std::size_t> course(const pgdr::Schedule_statistics& s) {
  std::vector<std::size_t> numbers{s.far_parcels, s.settled};
  for (const auto& e : s.epochs)
    numbers.insert(numbers.end(), {e.leaves, e.waves, e.tasks, e.most_ready, e.active, e.deferred, e.inserted,
                                   e.inserted_alone});
  return numbers;
}

/// A finished run, as far as it must be the same every time.
struct Outcome {
  Outcome(const pgdr::Plc& plc, const pgdr::Combined_sizing_field& sizing, const pgdr::Parameters& parameters)
      : Outcome(pgdr::refine_mesh_3(plc, sizing, parameters)) {}
  explicit Outcome(const Mesh& refined)
      : statistics(refined.statistics()),
        mesh(pgdr::indexed_mesh_3(refined)),
        checksum(pgdr::mesh_checksum(mesh)) {}

  std::size_t tasks() const {
    std::size_t n = 0;
    for (const auto& e : statistics.schedule.epochs) n += e.tasks;
    return n;
  }
  /// How many tasks could run at once, in the widest wave.
  std::size_t most_ready() const {
    std::size_t n = 0;
    for (const auto& e : statistics.schedule.epochs) n = std::max(n, e.most_ready);
    return n;
  }

  pgdr::Run_statistics statistics;
  pgdr::Indexed_mesh_3 mesh;
  std::uint64_t checksum;
};

/// A bound on circumradii, the same everywhere.
inline pgdr::Combined_sizing_field size(double radius) { return pgdr::Combined_sizing_field(pgdr::Uniform_sizing_field(radius)); }

/// What `pgdr mesh -o OUT.mesh` writes.
inline std::string medit_bytes(const pgdr::Indexed_mesh_3& mesh) {
  const Temporary_folder folder;
  pgdr::write_mesh(mesh, folder / "out.mesh");
  return content_of(folder / "out.mesh");
}

/// Where two runs differ; empty if they do not. `bytes` are those of the first one's file.
inline std::string difference(const Outcome& a, const std::string& bytes, const Outcome& b) {
  if (a.checksum != b.checksum) return "checksum";
  if (!equal(a.mesh, b.mesh)) return "arrays";
  if (course(a.statistics.schedule) != course(b.statistics.schedule)) return "course of the schedule";
  if (!bytes.empty() && bytes != medit_bytes(b.mesh)) return "bytes of the file";
  return {};
}

/// Sizes for `data/winged_body_in_box.poly` with which its leaves run side by side.
inline pgdr::Combined_sizing_field around_the_body() {
  return pgdr::Combined_sizing_field(pgdr::Uniform_sizing_field(0.9),
                                   {{{-19.89, -5.65, -5.61}, {6.50, 8.05, 5.61}, 0.8}});
}

/// Runs with every number of threads, `repetitions` times each, and compares everything with one checked run. There
/// must be enough to do at once, or nothing would be shown.
inline void require_same_mesh(const pgdr::Plc& plc, const pgdr::Combined_sizing_field& sizing, int repetitions,
                              pgdr::Parameters parameters = {}, std::size_t least_tasks = 100,
                              std::size_t least_ready = 8) {
  parameters.check_zones = true;
  parameters.threads = 4;
  std::string bytes;
  const Outcome first = [&] {
    const Mesh mesh = pgdr::refine_mesh_3(plc, sizing, parameters);
    Outcome o(mesh);
    CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
    CHECK(failures(pgdr::check_mesh(o.mesh, &mesh.domain())) == "");
    // What may not be split next to an acute angle may be above the size, too.
    if (o.mesh.exempt.empty()) CHECK(oversized(o.mesh, sizing) == 0);
    return o;
  }();
  bytes = medit_bytes(first.mesh);
  CAPTURE(first.mesh.tetrahedra.size(), first.tasks(), first.most_ready());
  CHECK(first.statistics.schedule.threads == 4);
  REQUIRE(first.tasks() >= least_tasks);
  REQUIRE(first.most_ready() >= least_ready);
  parameters.check_zones = false;
  for (int k = 0; k < repetitions; ++k)
    for (const unsigned threads : thread_counts()) {
      parameters.threads = threads;
      const Outcome again(plc, sizing, parameters);
      CAPTURE(k, threads);
      REQUIRE(again.statistics.schedule.threads == threads);
      REQUIRE(difference(first, k == 0 ? bytes : "", again) == "");
    }
}

}  // namespace pgdr_test

#endif
