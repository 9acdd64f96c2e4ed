// SPDX-License-Identifier: GPL-3.0-or-later
// The same mesh for every number of threads, as a table: rows of inputs, columns of thread counts.
#include <limits>
#include <string>
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

}  // namespace

TEST_CASE("The cube is the same mesh for every number of threads, every time", "[schedule]") {
  require_same_mesh(pgdr::read_plc(data_file("cube.poly")), size(0.023), 5);
}

TEST_CASE("The winged body in its box is the same mesh for every number of threads", "[schedule]") {
  require_same_mesh(pgdr::read_plc(data_file("winged_body_in_box.poly")),
                    size(0.9, {{{-19.89, -5.65, -5.61}, {6.50, 8.05, 5.61}, 0.8}}), 1);
}
