// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include <pgdr/io/read_plc.h>
#include <pgdr/quality/exempt_angles.h>
#include <pgdr/report/run_summary.h>

#include "catch.h"
#include "inputs.h"
#include "refinement/refined.h"

using namespace pgdr_test;

TEST_CASE("exempt tetrahedra are explained by the small angles that they are next to", "[quality]") {
  // Two triangles on one edge.
  const Mesh mesh = refined(pgdr::read_plc(data_file("../test/corpus/fan_36.poly")));
  const auto indexed = pgdr::indexed_mesh_3(mesh);
  REQUIRE(indexed.exempt.size() > 100);
  const auto angles = pgdr::exempt_angles(indexed, mesh.domain());
  REQUIRE(angles.size() >= 2);
  std::size_t sum = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    CHECK(angles[i].degrees < 60);
    CHECK(angles[i].tetrahedra > 0);
    if (i > 0) CHECK(angles[i].tetrahedra <= angles[i - 1].tetrahedra);
    sum += angles[i].tetrahedra;
  }
  CHECK(sum == indexed.exempt.size());
  CHECK(angles[0].between == "facets 0 and 1");
  CHECK(angles[0].degrees == Approx(1.63).margin(0.01));
  CHECK(angles[1].between.starts_with("the segment from vertex "));
}

TEST_CASE("a mesh without exempt tetrahedra has nothing to explain", "[quality]") {
  const Mesh mesh = refined(pgdr::read_plc(data_file("cube.poly")));
  CHECK(pgdr::exempt_angles(pgdr::indexed_mesh_3(mesh), mesh.domain()).empty());
}

TEST_CASE("the summary lists the angles with the most exempt tetrahedra", "[quality]") {
  std::vector<pgdr::Exempt_angle> angles;
  for (std::size_t i = 0; i < 7; ++i) angles.push_back({2.125 + double(i), "facets 7 and " + std::to_string(19 + i), 1200 - i});
  std::ostringstream out;
  pgdr::print_exempt_angles(out, angles);
  const std::string text = out.str();
  CHECK(text.find("1,200  at the 2.12 degree angle between facets 7 and 19\n") != std::string::npos);
  CHECK(text.find("1,196  at") != std::string::npos);
  CHECK(text.find("1,195  at") == std::string::npos);
  CHECK(text.find("2,389  at 2 others\n") != std::string::npos);
}
