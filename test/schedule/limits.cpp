// SPDX-License-Identifier: GPL-3.0-or-later
// Limits, arenas and several meshes at once.
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include <tbb/task_arena.h>

#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "conforming/consistency.h"
#include "domain/shapes.h"
#include "inputs.h"
#include "schedule/runs.h"

using namespace pgdr_test;

namespace {

pgdr::Plc cube() { return pgdr::read_plc(data_file("cube.poly")); }

pgdr::Parameters on(unsigned threads) {
  pgdr::Parameters p;
  p.threads = threads;
  return p;
}

}  // namespace

TEST_CASE("Two meshes that are refined at once are those that are refined one after the other",
          "[schedule]") {
  struct Job {
    pgdr::Plc plc;
    double radius;
    unsigned threads;
  };
  const std::vector<Job> jobs{{cube(), 0.03, 2},
                              {pgdr::read_plc(data_file("winged_body_in_box.poly")), 1.2, 3},
                              {cube(), 0.035, 0},
                              {tilted(box({0, 0, 0}, {3, 2, 1})), 0.1, 1}};
  const auto run = [&](std::size_t k) {
    return Outcome(jobs[k].plc, size(jobs[k].radius), on(jobs[k].threads));
  };
  std::vector<Outcome> alone;
  for (std::size_t k = 0; k < jobs.size(); ++k) alone.push_back(run(k));
  for (int repetition = 0; repetition < 2; ++repetition) {
    std::vector<std::string> differences(jobs.size());
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < jobs.size(); ++k)
      threads.emplace_back([&, k] { differences[k] = difference(alone[k], "", run(k)); });
    for (auto& t : threads) t.join();
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      CAPTURE(k);
      CHECK(differences[k] == "");
    }
  }
}

TEST_CASE("The caller's arena is respected", "[schedule]") {
  std::vector<Outcome> outcomes;
  for (const int threads : {1, 3}) {
    tbb::task_arena arena(threads);
    arena.execute([&] {
      pgdr::Parameters parameters = on(0);
      parameters.record_tasks = true;
      outcomes.emplace_back(cube(), size(0.03), parameters);
    });
    const auto& schedule = outcomes.back().statistics.schedule;
    CHECK(schedule.threads == static_cast<unsigned>(threads));
    REQUIRE(!schedule.records.empty());
    for (const auto& r : schedule.records) CHECK(r.thread < threads);
  }
  CHECK(difference(outcomes[0], "", outcomes[1]) == "");
  // Asked for, a number of threads counts more than the arena.
  tbb::task_arena one(1);
  one.execute([] { CHECK(Outcome(cube(), size(0.1), on(2)).statistics.schedule.threads == 2); });
}

TEST_CASE("A vertex budget gives the same mesh for every number of threads", "[schedule]") {
  for (const std::size_t budget : {2000u, 20001u, 40000u}) {
    std::vector<Outcome> outcomes;
    for (const unsigned threads : {1u, 2u, 4u, 16u}) {
      CAPTURE(budget, threads);
      pgdr::Parameters parameters = on(threads);
      parameters.max_vertices = budget;
      parameters.check_zones = threads == 4;
      const Mesh mesh = pgdr::refine_mesh_3(cube(), size(0.02), parameters);
      CHECK(mesh.statistics().stop == pgdr::Stop_reason::vertex_budget);
      const std::size_t vertices = mesh.triangulation().number_of_vertices();
      CHECK(vertices >= budget);
      CHECK(vertices <= budget + 50);  // to leave every facet whole
      outcomes.emplace_back(mesh);
      CHECK(difference(outcomes[0], "", outcomes.back()) == "");
      if (threads > 1) continue;
      CHECK(mesh.triangulation().is_valid());
      CHECK(mesh.statistics().unrecovered == 0);
      CHECK(inconsistency(mesh.triangulation(), mesh.complex()) == "");
      CHECK(valid_when_stopped(mesh, outcomes[0].mesh) == "");
    }
  }
}

TEST_CASE("A budget that is not reached changes nothing", "[schedule]") {
  pgdr::Parameters parameters = on(2);
  const Outcome without(cube(), size(0.04), parameters);
  parameters.max_vertices = 10 * without.mesh.points.size();
  CHECK(difference(without, "", Outcome(cube(), size(0.04), parameters)) == "");
}

TEST_CASE("A run that another thread cancels stops with a valid mesh", "[schedule]") {
  const pgdr::Plc plc = cube();
  const std::size_t all = Outcome(plc, size(0.025), on(2)).mesh.points.size();
  for (const std::size_t when : {10u, 3000u, 15000u}) {
    CAPTURE(when);
    std::atomic<bool> cancel{false}, reached{false};
    std::mutex mutex;
    std::condition_variable changed;
    pgdr::Parameters parameters = on(4);
    parameters.cancel = &cancel;
    parameters.check_zones = true;
    parameters.progress = [&](const pgdr::Progress& now) {
      if (now.vertices < when) return;
      const std::lock_guard lock(mutex);
      reached = true;
      changed.notify_one();
    };
    std::thread other([&] {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return reached.load(); });
      cancel = true;
    });
    const Mesh mesh = pgdr::refine_mesh_3(plc, size(0.025), parameters);
    {
      const std::lock_guard lock(mutex);
      reached = true;
    }
    changed.notify_one();
    other.join();
    CHECK(mesh.triangulation().is_valid());
    CHECK(mesh.statistics().unrecovered == 0);
    CHECK(inconsistency(mesh.triangulation(), mesh.complex()) == "");
    const auto indexed = pgdr::indexed_mesh_3(mesh);
    CHECK(valid_when_stopped(mesh, indexed) == "");
    CHECK(mesh.statistics().stop == pgdr::Stop_reason::cancelled);
    CHECK(indexed.points.size() < all);
  }
}
