// SPDX-License-Identifier: GPL-3.0-or-later
// Options of `mesh` that say how fine it is, and what things are called.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include <pgdr/io/medit.h>
#include <pgdr/quality/measures.h>

#include "program.h"

using nlohmann::json;
using pgdr_test::file_text;
using pgdr_test::Run;
using pgdr_test::Sandbox;
using pgdr_test::shape;

namespace {

/// Two files, one with two solids in it, of boxes that share a side.
void write_boxes(const Sandbox& sandbox) {
  const auto quad = [](const std::array<std::array<int, 3>, 4>& c) {
    std::string text;
    for (const auto& t : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int i : t)
        text += "vertex " + std::to_string(c[static_cast<std::size_t>(i)][0]) + " " + std::to_string(c[static_cast<std::size_t>(i)][1]) + " " +
                std::to_string(c[static_cast<std::size_t>(i)][2]) + "\n";
      text += "endloop\nendfacet\n";
    }
    return text;
  };
  const auto sides = [&](int z) {
    return quad({{{0, 0, z}, {1, 0, z}, {1, 0, z + 1}, {0, 0, z + 1}}}) + quad({{{1, 0, z}, {1, 1, z}, {1, 1, z + 1}, {1, 0, z + 1}}}) +
           quad({{{1, 1, z}, {0, 1, z}, {0, 1, z + 1}, {1, 1, z + 1}}}) + quad({{{0, 1, z}, {0, 0, z}, {0, 0, z + 1}, {0, 1, z + 1}}}) +
           quad({{{0, 0, z + 1}, {1, 0, z + 1}, {1, 1, z + 1}, {0, 1, z + 1}}});
  };
  const auto floor = [&](int z) { return quad({{{0, 0, z}, {0, 1, z}, {1, 1, z}, {1, 0, z}}}); };
  sandbox.write("base.stl", "solid inlet\n" + floor(0) + "endsolid\nsolid wall\n" + sides(0) + "endsolid\n");
  sandbox.write("top.stl", "solid\n" + floor(1) + sides(1) + "endsolid\n");
}

double circumradius(const pgdr::Indexed_mesh_3& mesh, const std::array<std::uint32_t, 4>& t) {
  return std::sqrt(pgdr::squared_circumradius(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]));
}

}  // namespace

TEST_CASE("tetrahedra on the facets with a marker are as fine as --facet-size says", "[apps]") {
  const Sandbox sandbox;
  write_boxes(sandbox);
  for (const std::string sizes : {"--facet-size inlet:0.04", "--facet-size 1:0.04 --gradation 0.3", "--size 0.3 --facet-size inlet:0.04"}) {
    CAPTURE(sizes);
    const Run run = sandbox.run("mesh base.stl --quiet -o out.mesh " + sizes);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const auto mesh = pgdr::read_medit(sandbox / "out.mesh");
    std::map<std::array<std::uint32_t, 3>, int> marker;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      auto corners = mesh.triangles[i];
      std::ranges::sort(corners);
      marker[corners] = mesh.triangle_references[i];
    }
    double on_inlet = 0, elsewhere = 0;
    for (const auto& t : mesh.tetrahedra) {
      bool is_on = false;
      for (std::size_t k = 0; k < 4; ++k) {
        std::array<std::uint32_t, 3> face{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
        std::ranges::sort(face);
        const auto found = marker.find(face);
        is_on |= found != marker.end() && found->second == 1;
      }
      double& largest = is_on ? on_inlet : elsewhere;
      largest = std::max(largest, circumradius(mesh, t));
    }
    CHECK(on_inlet <= 0.04 * (1 + 1e-9));
    CHECK(on_inlet > 0.02);
    CHECK(elsewhere > 0.2);
  }
}

TEST_CASE("sizes by expression, edge length and volume are bounds", "[apps]") {
  const Sandbox sandbox;
  const auto mesh_of = [&](const std::string& sizes) {
    const Run run = sandbox.run("mesh " + shape("cube.poly") + " --quiet -o out.mesh " + sizes);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return pgdr::read_medit(sandbox / "out.mesh");
  };
  const std::size_t fine = mesh_of("--size 0.1").tetrahedra.size();
  CHECK(mesh_of("--size-expression 0.1").tetrahedra.size() == fine);
  CHECK(mesh_of("--size-expression '0.1+0*sin(x)' --size 0.4").tetrahedra.size() == fine);
  CHECK(mesh_of("--size-expression 0.4 --size 0.1").tetrahedra.size() == fine);
  CHECK(mesh_of("--edge-length 0.135").tetrahedra.size() == fine);
  CHECK(mesh_of("--size 0.1 --curvature 12").tetrahedra.size() == fine);  // a cube is not curved
  CHECK(mesh_of("--size 0.1 --cells-across 4").tetrahedra.size() == fine);  // it is four edges of 0.25 wide
  CHECK(mesh_of("--cells-across 7.5").tetrahedra.size() > fine / 2);
  const std::size_t graded = mesh_of("--size-expression 'min(0.4, 0.1+0.3*x)'").tetrahedra.size();
  CHECK((graded < fine / 2 && graded > mesh_of("--size 0.4").tetrahedra.size()));
  sandbox.write("back.vti",
                "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1 0 1 0 1\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 1 0 1 0 1\"><PointData>"
                "<DataArray type=\"Float64\" Name=\"h\" format=\"ascii\">0.1 0.4 0.1 0.4 0.1 0.4 0.1 0.4</DataArray></PointData></Piece></ImageData></VTKFile>");
  CHECK(mesh_of("--size-field back.vti:h").tetrahedra.size() == mesh_of("--size-expression 0.1+0.3*x").tetrahedra.size());
  const auto small = mesh_of("--max-volume 0.001");
  for (const auto& t : small.tetrahedra) CHECK(std::abs(pgdr::signed_volume(small.points[t[0]], small.points[t[1]], small.points[t[2]], small.points[t[3]])) <= 0.001);
}

TEST_CASE("sizes that make no sense are refused by name", "[apps]") {
  const Sandbox sandbox;
  const std::string mesh = "mesh " + shape("cube.poly") + " -o out.mesh ";
  const auto fails = [&](const std::string& options, const std::string& says) {
    const Run run = sandbox.run(mesh + options);
    CAPTURE(options, run.err);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find(says) != std::string::npos);
  };
  fails("--facet-size 0.1", "MARKER:R");
  fails("--facet-size 77:0.1", "no facet has the marker '77'");
  fails("--facet-size 0:-1", "positive");
  fails("--size-expression 'x+'", "--size-expression");
  fails("--size-expression 'x+w'", "'x+w'");
  fails("--size-expression 0,1", "comma");
  fails("--size-expression ''", "empty");
  fails("--size-expression 'x=0.1'", "assigns");
  fails("--size-expression 'x-0.5'", "the size at");
  fails("--edge-length 0", "--edge-length");
  fails("--max-volume=-1", "--max-volume");
  fails("--curvature 0", "--curvature");
  fails("--cells-across 0", "--cells-across");
  fails("--gradation 0.3", "--curvature");
  fails("--size-field back.vtu", "FILE:ARRAY");
  fails("--size-field back.txt:h", ".vti");
  fails("--order 3", "--order");
  fails("--order 2", "--order 2: 'out.mesh'");
  fails("--vtu-compression 10", "--vtu-compression");
  fails("--patch-angle 200", "--patch-angle");
  fails("--name-marker inlet", "--name-marker");
  fails("--name-marker 1=inlet --name-marker 1=door", "two names");
  CHECK(sandbox.names().empty());
}

TEST_CASE("names go from the input to the groups of the output", "[apps]") {
  const Sandbox sandbox;
  write_boxes(sandbox);
  const Run run = sandbox.run("mesh base.stl top.stl --quiet --size 0.4 -o out.inp -o out.vtu --vtu-triangles --name-region 2=lid");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const std::string deck = file_text(sandbox / "out.inp");
  for (const char* set : {"TYPE=C3D4, ELSET=base\n", "TYPE=C3D4, ELSET=lid\n", "TYPE=ELEMENT, NAME=base_inlet\n", "TYPE=ELEMENT, NAME=base_wall\n", "TYPE=ELEMENT, NAME=top\n"}) {
    INFO(set);
    CHECK(deck.find(set) != std::string::npos);
  }
  const std::string grid = file_text(sandbox / "out.vtu");
  for (const char* name : {"\"base:inlet\"", "\"lid\"", "\"input_facet\"", "\"attribute\""}) {
    INFO(name);
    CHECK(grid.find(name) != std::string::npos);
  }
  const Run patches = sandbox.run("mesh " + shape("cube.poly") + " --quiet --markers-from nothing --patch-angle 60 --name-marker 3=door -o patches.inp");
  REQUIRE(patches.exit_code == 0);
  CHECK(file_text(sandbox / "patches.inp").find("NAME=door") != std::string::npos);
}

TEST_CASE("triangles between regions are left out for solvers that refuse them", "[apps]") {
  const Sandbox sandbox;
  for (const bool outer : {false, true}) {
    const Run run = sandbox.run("mesh " + shape("two_regions.poly") + " --quiet --size 0.4 --order 2 -o out.inp" + (outer ? " --outer-triangles" : ""));
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const std::string deck = file_text(sandbox / "out.inp");
    CHECK(deck.find("NAME=marker_1") != std::string::npos);
    CHECK((deck.find("NAME=marker_3") == std::string::npos) == outer);
  }
}
