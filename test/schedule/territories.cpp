// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes that are too coarse for more than one leaf, on all threads: by quality alone, divided among territories.

#include <cmath>
#include <limits>
#include <numbers>

#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "inputs.h"
#include "schedule/runs.h"

using namespace pgdr_test;

namespace {

const pgdr::Combined_sizing_field no_size(pgdr::Uniform_sizing_field(std::numeric_limits<double>::infinity()), {});

/// A ball whose surface has 2 n (m - 1) triangles; every other vertex is pulled towards the center by a share of the radius.
pgdr::Plc ball(pgdr::Index n, pgdr::Index m, double pull) {
  pgdr::Plc plc;
  plc.vertices = {{0, 0, -1}, {0, 0, 1}};
  for (pgdr::Index i = 1; i < m; ++i)
    for (pgdr::Index j = 0; j < n; ++j) {
      const double a = std::numbers::pi * i / m, b = 2 * std::numbers::pi * (j + 0.5 * i) / n;
      const double r = (i + j) % 2 ? 1 : 1 - pull;
      plc.vertices.push_back({r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), -r * std::cos(a)});
    }
  const auto at = [&](pgdr::Index i, pgdr::Index j) { return 2 + (i - 1) * n + j % n; };
  const auto add = [&](pgdr::Index a, pgdr::Index b, pgdr::Index c) {
    plc.facets.emplace_back().polygons.push_back({a, b, c});
  };
  for (pgdr::Index j = 0; j < n; ++j) {
    add(0, at(1, j + 1), at(1, j));
    add(1, at(m - 1, j), at(m - 1, j + 1));
    for (pgdr::Index i = 1; i + 1 < m; ++i) {
      add(at(i, j), at(i, j + 1), at(i + 1, j));
      add(at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    }
  }
  return plc;
}

bool model(const char* name) {
  CAPTURE(name);
  const auto path = input_model(name);
  if (path) require_same_mesh(pgdr::read_plc(*path), no_size, 1, {}, 15, 4);
  return path.has_value();
}

}  // namespace

TEST_CASE("A ball by quality alone is the same mesh for every number of threads", "[schedule]") {
  require_same_mesh(ball(60, 30, 0), no_size, is_nightly() ? 2 : 1, {}, 20, 4);
}

TEST_CASE("So is one with sharp edges, where territories are torn", "[schedule]") {
  require_same_mesh(ball(60, 40, 0.2), no_size, is_nightly() ? 2 : 1, {}, 20, 4);
}

TEST_CASE("A hand by quality alone is the same mesh for every number of threads", "[schedule][models]") {
  if (!model("a10_hand.off")) PGDR_SKIP("the real models are not here");
}

TEST_CASE("An airplane by quality alone is the same mesh for every number of threads", "[schedule][models]") {
  if (!model("a19_airplane_in_box.poly")) PGDR_SKIP("the real models are not here");
}

TEST_CASE("Most of a mesh by quality alone is inserted side by side", "[schedule]") {
  pgdr::Parameters parameters;
  parameters.threads = 2;
  const Outcome run(ball(120, 60, 0), no_size, parameters);
  std::size_t inserted = 0, alone = 0;
  for (const auto& e : run.statistics.schedule.epochs) {
    CHECK(e.leaves == 1);
    inserted += e.inserted;
    alone += e.inserted_alone;
  }
  CAPTURE(inserted, alone);
  CHECK(inserted > 1000);
  CHECK(alone < 0.25 * static_cast<double>(inserted));
}

TEST_CASE("The budget of vertices holds for divided work, for every number of threads", "[schedule]") {
  const pgdr::Plc plc = ball(60, 30, 0);
  pgdr::Parameters parameters;
  const std::size_t all = Outcome(plc, no_size, parameters).mesh.points.size();
  parameters.max_vertices = all - all / 20;
  parameters.threads = 1;
  const Outcome one(plc, no_size, parameters);
  CHECK(one.statistics.stop == pgdr::Stop_reason::vertex_budget);
  CHECK(one.mesh.points.size() <= parameters.max_vertices + all / 100);
  parameters.threads = 3;
  CHECK(difference(one, "", Outcome(plc, no_size, parameters)) == "");
}
