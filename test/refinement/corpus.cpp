// SPDX-License-Identifier: GPL-3.0-or-later
// Small PLCs that some version of the mesher failed on, most of them made by bench/random_plcs.py --keep.
#include <algorithm>
#include <filesystem>
#include <limits>
#include <vector>

#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "conforming/consistency.h"
#include "inputs.h"
#include "refinement/refined.h"

using namespace pgdr_test;

TEST_CASE("Every PLC that once failed is meshed", "[corpus]") {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(data_file("../test/corpus")))
    if (entry.path().extension() == ".poly") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  REQUIRE(paths.size() >= 50);
  for (const auto& path : paths) {
    CAPTURE(path.filename());
    pgdr::Parameters parameters;
    parameters.max_vertices = 200000;
    const Mesh mesh = refined(pgdr::read_plc(path), std::numeric_limits<double>::infinity(), parameters);
    CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
    CHECK(mesh.statistics().unrecovered == 0);
    CHECK(inconsistency(mesh.triangulation(), mesh.complex()) == "");
    CHECK(failures(pgdr::check_mesh(pgdr::indexed_mesh_3(mesh), &mesh.domain())) == "");
  }
}
