// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <pgdr/domain/input_error.h>
#include <pgdr/io/medit.h>

#include "../catch.h"
#include "sample_mesh.h"
#include "temporary_folder.h"

using Kind = pgdr::Input_problem::Kind;
using pgdr_test::Temporary_folder;

namespace {

void check_same(const pgdr::Indexed_mesh_3& a, const pgdr::Indexed_mesh_3& b) {
  REQUIRE(a.points.size() == b.points.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      different +=
          std::bit_cast<std::uint64_t>(a.points[i][j]) != std::bit_cast<std::uint64_t>(b.points[i][j]);
    }
  }
  CHECK(different == 0);
  CHECK(a.point_references == b.point_references);
  CHECK(a.edges == b.edges);
  CHECK(a.edge_references == b.edge_references);
  CHECK(a.triangles == b.triangles);
  CHECK(a.triangle_references == b.triangle_references);
  CHECK(a.tetrahedra == b.tetrahedra);
  CHECK(a.tetrahedron_references == b.tetrahedron_references);
}

const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
const std::string vertices = "Vertices\n4\n0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n";
const std::string tetrahedra = "Tetrahedra\n1\n1 2 3 4 9\n";

}  // namespace

TEST_CASE("medit: what is read back is what was written, bit for bit") {
  const Temporary_folder folder;
  auto mesh = pgdr_test::sample_mesh(23);
  mesh.points[0] = {-0.0, 5e-324, 1.7976931348623157e308};
  mesh.points[1] = {2.2250738585072014e-308, 1e308, -1e-310};
  std::mt19937_64 random(3);
  for (std::size_t i = 2; i < 9000; ++i) {
    for (double& x : mesh.points[i]) {
      do x = std::bit_cast<double>(random());
      while (!std::isfinite(x));
    }
  }
  pgdr::write_medit(mesh, folder / "a.mesh");
  const auto read = pgdr::read_medit(folder / "a.mesh");
  check_same(mesh, read);
  CHECK(read.point_dimensions.empty());
  CHECK(read.exempt.empty());
  CHECK(folder.size() == 1);
}

TEST_CASE("medit: the text") {
  const Temporary_folder folder;
  pgdr::Indexed_mesh_3 mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}, {0, 0, 1e-20}};
  mesh.point_references = {1, 0, 0, -4};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  mesh.tetrahedron_references = {7};
  mesh.triangles = {{2, 1, 0}};
  mesh.triangle_references = {5};
  pgdr::write_medit(mesh, folder / "a.mesh");
  CHECK(pgdr_test::content_of(folder / "a.mesh") ==
        "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n4\n0 0 0 1\n1 0 0 0\n0 0.1 0 0\n0 0 1e-20 -4\n"
        "\nTriangles\n1\n3 2 1 5\n\nTetrahedra\n1\n1 2 3 4 7\n\nEnd\n");
}

TEST_CASE("medit: sections in any order, comments, unknown sections") {
  const Temporary_folder folder;
  const auto mesh = pgdr::read_medit(folder.write(
      "a.mesh",
      "# made elsewhere\nMeshVersionFormatted\n1\n\nDimension\n3\n# first the cells\nTetrahedra 1\n1 2 3 4 "
      "9\n"
      "Corners\n2\n1\n2\nRequiredVertices 1\n1\nNormals\n1\n0 0 nan\nNormalAtVertices\n1 1 1\nHexahedra 0\n"
      "VERTICES 4 # count\r\n0 0 0 1\r\n1 0 0 2 # b\r\n0 1 0 3 0 0\n1 4\nEdges\n1\n1 2 6\nend\nwhatever"));
  REQUIRE(mesh.points.size() == 4);
  CHECK(mesh.points[3] == pgdr::Indexed_mesh_3::Point{0, 0, 1});
  CHECK(mesh.point_references == std::vector<std::int32_t>{1, 2, 3, 4});
  CHECK(mesh.tetrahedra == std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}});
  CHECK(mesh.edges == std::vector<std::array<std::uint32_t, 2>>{{0, 1}});
  CHECK(mesh.edge_references == std::vector<std::int32_t>{6});
  CHECK(mesh.triangles.empty());
}

TEST_CASE("medit: errors name the line") {
  struct Case {
    std::string content;
    Kind kind;
    std::string says;
  };
  const std::vector<Case> cases = {
      {"", Kind::unreadable, "the file ends before"},
      {"Vertices\n", Kind::unreadable, "line 1: the file does not begin with MeshVersionFormatted"},
      {"MeshVersionFormatted 2\nDimension 2\n", Kind::unreadable, "line 2: the dimension is not 3"},
      {head + vertices + tetrahedra, Kind::unreadable, "the file ends before the keyword End"},
      {head + vertices + "End\n", Kind::empty, "no section Tetrahedra"},
      {head + tetrahedra + "End\n", Kind::empty, "no section Vertices"},
      {head + "Vertices\n2\n0 0 0 1\n1 0 x 1\nEnd\n", Kind::unreadable,
       "line 6: a coordinate is not a number"},
      {head + "Vertices\n2\n0 0 0 1\n1 0 nan 1\nEnd\n", Kind::bad_coordinate,
       "line 6: a coordinate is not finite"},
      {head + "Vertices\n2\n0 0 0 1\n1 -inf 0 1\nEnd\n", Kind::bad_coordinate, "line 6"},
      {head + "Vertices\n2\n0 0 0 1\n", Kind::unreadable, "the file ends before a coordinate"},
      {head + "Vertices\n9999999\n0 0 0 1\n", Kind::unreadable, "line 4: the section announces 9999999 rows"},
      {head + "Vertices\n-1\n0 0 0 1\n", Kind::unreadable, "line 4"},
      {head + "Vertices\n1\n0 0 0 1.5\n", Kind::unreadable, "line 5: a reference is not an integer"},
      {head + "Vertices\n1\n0 0 0 9999999999\n", Kind::unreadable, "line 5: a reference does not fit"},
      {head + "Vertices\n1\n0 0 0 1\n1 1 1 1\n", Kind::unreadable,
       "line 6: a number stands where a keyword is due"},
      {head + vertices + vertices, Kind::unreadable, "second time"},
      {head + vertices + "Tetrahedra\n2\n1 2 3 4 0\n1 2 3 5 0\nEnd\n", Kind::bad_index,
       "line 12: a tetrahedron names vertex 5"},
      {head + vertices + "Tetrahedra\n2\n1 2 3 4 0\n1 0 3 4 0\nEnd\n", Kind::bad_index,
       "line 12: a tetrahedron names vertex 0"},
      {head + vertices + "Triangles\n1\n1 2 -3 4\n" + tetrahedra + "End\n", Kind::bad_index, "line 11"},
      {head + "Edges\n1\n1 7 0\n" + vertices + tetrahedra + "End\n", Kind::bad_index,
       "line 5: an edge names vertex 7"},
      {head + vertices + "Hexahedra\n1\n1 2 3 4 1 2 3 4 0\nEnd\n", Kind::unreadable,
       "only tetrahedral meshes"},
  };
  const Temporary_folder folder;
  for (const auto& c : cases) {
    std::string message = "accepted";
    Kind kind = Kind::unreadable;
    try {
      pgdr::read_medit(folder.write("wrong.mesh", c.content));
    } catch (const pgdr::Input_error& error) {
      message = error.what();
      kind = error.problems().front().kind;
    }
    CAPTURE(c.content, message);
    CHECK(message.find(c.says) != std::string::npos);
    CHECK(message.find("wrong.mesh") != std::string::npos);
    CHECK(kind == c.kind);
  }
  CHECK_THROWS_AS(pgdr::read_medit(folder / "missing.mesh"), pgdr::Input_error);
}

TEST_CASE("medit: every prefix of a file is refused") {
  const Temporary_folder folder;
  const std::string whole = head + vertices + "Edges\n1\n1 2 5\n" + tetrahedra + "End";
  for (std::size_t length = 0; length < whole.size(); ++length) {
    CHECK_THROWS_AS(pgdr::read_medit(folder.write("p.mesh", whole.substr(0, length))), pgdr::Input_error);
  }
  CHECK_NOTHROW(pgdr::read_medit(folder.write("p.mesh", whole)));
}
