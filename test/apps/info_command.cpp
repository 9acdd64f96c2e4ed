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
