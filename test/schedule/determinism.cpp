// SPDX-License-Identifier: GPL-3.0-or-later
// The same mesh for every number of threads, as a table: rows of inputs, columns of thread counts.
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "inputs.h"
#include "schedule/runs.h"

using namespace pgdr_test;

namespace {

pgdr::Command_line_sizing size(double radius, std::vector<pgdr::Sizing_box> boxes = {}) {
  return pgdr::Command_line_sizing(pgdr::Uniform_sizing_field(radius), std::move(boxes));
}

/// A row for a real model; false where it is absent.
bool same_mesh_of_model(const char* name, double radius) {
  const auto path = input_model(name);
  pgdr::Parameters many_leaves;
  many_leaves.outside_points = 10;  // for a model of moderate size to have tasks enough
  if (path) require_same_mesh(pgdr::read_plc(*path), size(radius), 1, many_leaves);
  return path.has_value();
}

}  // namespace

TEST_CASE("The cube is the same mesh for every number of threads, every time", "[schedule]") {
  require_same_mesh(pgdr::read_plc(data_file("cube.poly")), size(0.023), 5);
}

TEST_CASE("The winged body in its box is the same mesh for every number of threads", "[schedule]") {
  require_same_mesh(pgdr::read_plc(data_file("winged_body_in_box.poly")),
                    size(0.9, {{{-19.89, -5.65, -5.61}, {6.50, 8.05, 5.61}, 0.8}}), 1);
}

TEST_CASE("A joint is the same mesh for every number of threads", "[schedule][models]") {
  if (!same_mesh_of_model("a03_joint.off", 0.02)) PGDR_SKIP("the real models are not here");
}

TEST_CASE("A knot is the same mesh for every number of threads", "[schedule][models]") {
  if (!same_mesh_of_model("a11_knot2.off", 0.007)) PGDR_SKIP("the real models are not here");
}

TEST_CASE("An airplane in its box is the same mesh for every number of threads", "[schedule][models]") {
  if (!same_mesh_of_model("a19_airplane_in_box.poly", 0.9)) PGDR_SKIP("the real models are not here");
}

// Not part of a usual run: minutes. Call it by its tag.
TEST_CASE("Every row of the table, five times", "[.][repeated]") {
  require_same_mesh(pgdr::read_plc(data_file("winged_body_in_box.poly")),
                    size(0.9, {{{-19.89, -5.65, -5.61}, {6.50, 8.05, 5.61}, 0.8}}), 5);
  pgdr::Parameters many_leaves;
  many_leaves.outside_points = 10;
  for (const auto& [name, radius] : {std::pair<const char*, double>{"a03_joint.off", 0.02},
                                     {"a11_knot2.off", 0.007},
                                     {"a19_airplane_in_box.poly", 0.9}}) {
    CAPTURE(name);
    if (const auto path = input_model(name)) require_same_mesh(pgdr::read_plc(*path), size(radius), 5, many_leaves);
  }
}
