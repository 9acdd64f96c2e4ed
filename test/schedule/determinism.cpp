// SPDX-License-Identifier: GPL-3.0-or-later
// The same mesh for every number of threads, as a table: rows of inputs, columns of thread counts.

#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "inputs.h"
#include "schedule/runs.h"

using namespace pgdr_test;

namespace {

// The rows of the table; those of real models are skipped where the model is absent.

int repetitions() { return is_nightly() ? 5 : 1; }

void body() {
  require_same_mesh(pgdr::read_plc(data_file("winged_body_in_box.poly")), around_the_body(), repetitions());
}

void model(const char* name, double radius, const pgdr::Parameters& parameters = {}, std::size_t least_tasks = 100,
           std::size_t least_ready = 8) {
  CAPTURE(name);
  const auto path = input_model(name);
  if (!path) PGDR_SKIP("the real models are not here");
  require_same_mesh(pgdr::read_plc(*path), size(radius), repetitions(), parameters, least_tasks, least_ready);
}

/// For a model of moderate size to have tasks enough.
pgdr::Parameters many_leaves() {
  pgdr::Parameters parameters;
  parameters.outside_points = 10;
  return parameters;
}

// Surfaces have so much outside that their work is divided among territories.
void joint() { model("a03_joint.off", 0.02, {}, 20, 4); }
void knot() { model("a11_knot2.off", 0.007, {}, 20, 4); }
void airplane() { model("a19_airplane_in_box.poly", 0.9, many_leaves()); }

}  // namespace

TEST_CASE("The cube is the same mesh for every number of threads, every time", "[schedule]") {
  require_same_mesh(pgdr::read_plc(data_file("cube.poly")), size(0.023), repetitions());
}

TEST_CASE("The winged body in its box is the same mesh for every number of threads", "[schedule]") {
  body();
}

TEST_CASE("A joint is the same mesh for every number of threads", "[schedule][models]") {
  joint();
}

TEST_CASE("A knot is the same mesh for every number of threads", "[schedule][models]") {
  knot();
}

TEST_CASE("An airplane in its box is the same mesh for every number of threads", "[schedule][models]") {
  airplane();
}
