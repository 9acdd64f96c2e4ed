// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "program.h"

using pgdr_test::Run;
using pgdr_test::Sandbox;
using pgdr_test::shape;

TEST_CASE("info describes the project's shapes", "[apps]") {
  const Sandbox sandbox;
  for (const char* name : {"cube.poly", "l_block.poly", "cavity.poly", "two_regions.poly",
                           "plate_with_hole.poly", "winged_body_in_box.poly"}) {
    const Run run = sandbox.run("info " + shape(name));
    INFO(name << '\n' << run.out << run.err);
    CHECK(run.exit_code == 0);
    CHECK(run.err.empty());
    for (const char* word : {"vertices", "facets", "segments", "bounding box", "closed", "dihedral",
                             "plane angle", "regions", "problems"})
      CHECK(run.out.find(word) != std::string::npos);
  }
}

TEST_CASE("a surface is not refused for how its triangles are fused", "[apps]") {
  const Sandbox sandbox;
  // A prism whose lid is a valley 5e-7 deep along its longer diagonal; fused, that is divided along the shorter one, a ridge. A box stands 1e-7 above the valley.
  sandbox.write("valley.off",
                "OFF\n16 24 0\n"
                "-1 0 0.0\n0 -0.5 0.0\n1 0 0.0\n0 0.5 0.0\n-1 0 0.9999995\n0 -0.5 1.0\n"
                "1 0 0.9999995\n0 0.5 1.0\n-0.02 -0.02 0.9999996\n0.02 -0.02 0.9999996\n0.02 0.02 0.9999996\n-0.02 0.02 0.9999996\n"
                "-0.02 -0.02 1.5\n0.02 -0.02 1.5\n0.02 0.02 1.5\n-0.02 0.02 1.5\n"
                "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n"
                "3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n"
                "3 8 10 9\n3 8 11 10\n3 12 13 14\n3 12 14 15\n3 8 9 13\n3 8 13 12\n"
                "3 9 10 14\n3 9 14 13\n3 10 11 15\n3 10 15 14\n3 11 8 12\n3 11 12 15\n");
  const Run run = sandbox.run("info valley.off");
  INFO(run.out << run.err);
  CHECK(run.exit_code == 0);
  CHECK(run.out.find("facets                   13 of 24 in the file, 11 of them fused") != std::string::npos);
  CHECK(run.out.find("regions                  2,") != std::string::npos);
  CHECK(sandbox.run("info valley.off --tolerance 0").exit_code == 0);
}

TEST_CASE("info writes the PLC as understood", "[apps]") {
  const Sandbox sandbox;
  // The unit cube as 12 triangles.
  sandbox.write("cube.off",
                "OFF\n8 12 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n"
                "3 3 0 4\n3 3 4 7\n");
  const Run run = sandbox.run("info cube.off --write-plc fused.poly");
  INFO(run.out << run.err);
  REQUIRE(run.exit_code == 0);
  const Run fused = sandbox.run("info fused.poly");
  CHECK(fused.exit_code == 0);
  const auto line = [](const std::string& text, const std::string& word) {
    const std::size_t at = text.find(word);
    return at == std::string::npos ? std::string() : text.substr(at, text.find('\n', at) - at);
  };
  CHECK(line(run.out, "segments") == line(fused.out, "segments"));
  CHECK(line(run.out, "facets").find("6") != std::string::npos);
  CHECK(line(run.out, "segments").find("12") != std::string::npos);
}
