// SPDX-License-Identifier: GPL-3.0-or-later
#include <limits>
#include <string>
#include <vector>

#include <pgdr/io/read_plc.h>

#include "../catch.h"
#include "read_failure.h"
#include "temporary_folder.h"

using pgdr::Index;
using Kind = pgdr::Input_problem::Kind;
using pgdr_test::read_failure;
using pgdr_test::Temporary_folder;

namespace {

using Polygon = std::vector<Index>;

const std::string nodes =
    "4 3 0 0\n"
    "0 0 0 0\n"
    "1 1 0 0\n"
    "2 0 1 0\n"
    "3 0 0 1\n";
const std::string facets =
    "4 1\n"
    "1 0 5\n3 0 1 2\n"
    "1 0 6\n3 0 1 3\n"
    "1 0 7\n3 0 2 3\n"
    "1 0 8\n3 1 2 3\n";

pgdr::Plc read(const std::string& name, const std::string& content) {
  const Temporary_folder folder;
  return pgdr::read_plc(folder.write(name, content));
}

}  // namespace

TEST_CASE("poly: a tetrahedron with holes and regions") {
  const auto plc = read("t.poly", nodes + facets + "1\n0 9 8 7\n2\n0 0.1 0.1 0.1 10 0.5\n1 0.2 0.2 0.2 -3\n");
  REQUIRE(plc.vertices.size() == 4);
  CHECK(plc.vertices[3] == pgdr::Plc::Point_3(0, 0, 1));
  CHECK(plc.vertex_markers.empty());
  CHECK(plc.first_index == 0);
  CHECK(plc.nesting == pgdr::Nesting::fill);
  REQUIRE(plc.facets.size() == 4);
  CHECK(plc.facets[1].polygons == std::vector<Polygon>{{0, 1, 3}});
  CHECK(plc.facets[1].marker == 6);
  CHECK(plc.segments.empty());
  REQUIRE(plc.holes.size() == 1);
  CHECK(plc.holes[0] == pgdr::Plc::Point_3(9, 8, 7));
  REQUIRE(plc.regions.size() == 2);
  CHECK(plc.regions[0].point == pgdr::Plc::Point_3(0.1, 0.1, 0.1));
  CHECK(plc.regions[0].id == 10);
  CHECK(plc.regions[0].max_volume == 0.5);
  CHECK(plc.regions[1].id == -3);
  CHECK(plc.regions[1].max_volume == 0);
}

TEST_CASE("poly: one-based, comments, attributes, markers, several polygons, facet holes, long polygons") {
  const auto plc = read("T.POLY",
                        "# a comment\r\n\r\n"
                        "  8, 3, 2, 1   # counts\r\n"
                        "1 0 0 0 0.5 0.25 11\r\n"
                        "2\t4\t0\t0\t0.5\t0.25\t12\r\n"
                        "3 4 4 0 1e0 .5 13 # the third\r\n"
                        "\r\n# between\r\n"
                        "4 0 4 0 0 0 14\n5 1 1 0 0 0 15\n6 2 1 0 0 0 16\n7 +2 2.0 0 0 0 -17\n8 3 3 0 0 0 18\n"
                        "2 1\n"
                        "4 1 9 # facet 1\n"
                        "5 1 2\n 3\n 4 1  # closed, over three lines\n"
                        "3 5 6 7\n"
                        "2 7 8\n"
                        "1 8\n"
                        "1 1.5 1.25 0\n"
                        "1\n"
                        "3 1 2 3\n"
                        "0\n");
  CHECK(plc.first_index == 1);
  CHECK(plc.vertex_markers == std::vector<int>{11, 12, 13, 14, 15, 16, -17, 18});
  CHECK(plc.vertices[6] == pgdr::Plc::Point_3(2, 2, 0));
  REQUIRE(plc.facets.size() == 2);
  CHECK(plc.facets[0].polygons == std::vector<Polygon>{{0, 1, 2, 3}, {4, 5, 6}, {6, 7}, {7}});
  CHECK(plc.facets[0].holes == std::vector<pgdr::Plc::Point_3>{{1.5, 1.25, 0}});
  CHECK(plc.facets[0].marker == 9);
  CHECK(plc.facets[1].marker == 0);
  CHECK(plc.regions.empty());
}

TEST_CASE("poly: hole and region lists may be missing, as may the node list when a .node file is there") {
  CHECK(read("t.poly", nodes + facets).facets.size() == 4);
  CHECK(read("t.poly", nodes + facets + "0\n").facets.size() == 4);
  CHECK(read("t.poly", nodes + facets + "0\n0").facets.size() == 4);

  const Temporary_folder folder;
  folder.write("split.node", nodes);
  const auto plc = pgdr::read_plc(folder.write("split.poly", "0 3 0 0\n" + facets + "0\n0\n"));
  CHECK(plc.vertices.size() == 4);
  CHECK(plc.facets.size() == 4);
  CHECK(read_failure("alone.poly", "0 3 0 0\n" + facets).says("alone.node"));

  folder.write("bad.node", "1 3 0 0\n0 0 0 nan\n");
  try {
    pgdr::read_plc(folder.write("bad.poly", "0 3 0 0\n" + facets));
    FAIL("accepted");
  } catch (const pgdr::Input_error& error) {
    CHECK(std::string(error.what()).find("bad.node', line 2") != std::string::npos);
  }
}

TEST_CASE("poly: a facet of two-vertex polygons is a list of explicit segments") {
  const auto plc = read("t.poly", nodes + "2 1\n1 0 1\n3 0 1 2\n2 0 44\n2 0 3\n2 3 1\n0\n0\n");
  CHECK(plc.facets.size() == 1);
  REQUIRE(plc.segments.size() == 2);
  CHECK(plc.segments[1].source == 3);
  CHECK(plc.segments[1].target == 1);
  CHECK(plc.segments[1].marker == 44);
}

TEST_CASE("smesh: facets with and without markers") {
  const auto plc =
      read("t.smesh", nodes + "4 1\n3 0 1 2 7\n3 0 1 3\n4 0 2 3 0 -1 \n3\n1 2\n3 8\n0\n1\n0 .1 .1 .1 4\n");
  REQUIRE(plc.facets.size() == 4);
  CHECK(plc.facets[0].marker == 7);
  CHECK(plc.facets[1].marker == 0);
  CHECK(plc.facets[2].marker == -1);
  CHECK(plc.facets[2].polygons == std::vector<Polygon>{{0, 2, 3}});
  CHECK(plc.facets[3].polygons == std::vector<Polygon>{{1, 2, 3}});
  CHECK(plc.facets[3].marker == 8);
  REQUIRE(plc.regions.size() == 1);
  CHECK(plc.regions[0].id == 4);
}

TEST_CASE("poly: errors name the line") {
  struct Case {
    std::string content;
    Kind kind;
    std::string says;
  };
  const std::vector<Case> cases = {
      {"", Kind::unreadable, "ends before the number of vertices"},
      {"four 3 0 0\n", Kind::unreadable, "line 1: the number of vertices is 'four'"},
      {"-4 3 0 0\n", Kind::unreadable, "line 1: the number of vertices is negative"},
      {"99999999999 3 0 0\n", Kind::unreadable, "too short"},
      {"4 2 0 0\n", Kind::unreadable, "line 1: the dimension is 2"},
      {"2 3 0 0\n0 0 0 0\n", Kind::unreadable, "line 2: the file ends before vertex 1"},
      {"2 3 0 0\n0 0,5 0 0\n", Kind::unreadable, "line 2: vertex 0 has a number with a comma; decimals are written with a point"},
      {"2 3 0 0\n0 0 0\n1 0 0 0\n", Kind::unreadable,
       "line 2: the line ends before the z coordinate of vertex 0"},
      {"1 3 0 0\n\n0 0 nan 0\n", Kind::bad_coordinate,
       "line 3: the y coordinate of vertex 0 is not a number"},
      {"1 3 0 0\n0 0 0 -inf\n", Kind::bad_coordinate, "line 2: the z coordinate of vertex 0 is infinite"},
      {"1 3 0 0\n0 1e999 0 0\n", Kind::bad_coordinate, "line 2: the x coordinate of vertex 0 is infinite"},
      {"1 3 0 0\n0 1.0x 0 0\n", Kind::unreadable,
       "line 2: the x coordinate of vertex 0 is '1.0x', not a number"},
      {"1 3 0 0\n5 0 0 0\n", Kind::bad_index, "line 2: the first vertex has number 5"},
      {"2 3 0 0\n1 0 0 0\n3 0 0 0\n", Kind::bad_index, "line 3: vertex number 3 stands where 2 is due"},
      {"1 3 0 1\n1 0 0 0\n", Kind::unreadable, "line 2: the line ends before the marker of vertex 1"},
      {nodes, Kind::unreadable, "line 5: the file ends before the number of facets"},
      {nodes + "0 1\n", Kind::empty, "line 6: there are no facets"},
      {nodes + "1 1\n", Kind::unreadable, "line 6: the file ends before facet 0"},
      {nodes + "1 1\n1 0 1\n", Kind::unreadable, "line 7: the file ends before a polygon of facet 0"},
      {nodes + "1 1\n1 0 1\n3 0 1", Kind::unreadable, "line 8: the file ends before a vertex of facet 0"},
      {nodes + "1 1\n1 0 1\n3 0 1 4\n", Kind::bad_index,
       "line 8: facet 0 names vertex 4, which is not in 0..3"},
      {nodes + "1 1\n1 0 1\n3 0 1 -1\n", Kind::bad_index, "line 8"},
      {nodes + "1 1\n1 0 1\n3 0 1 2 3\n", Kind::unreadable, "line 8: a polygon of facet 0 has more"},
      {nodes + "1 1\n0 0 1\n", Kind::degenerate_facet, "line 7: facet 0 has no polygon"},
      {nodes + "1 1\n1 1 1\n3 0 1 2\n", Kind::unreadable, "line 8: the file ends before a hole of facet 0"},
      {nodes + facets + "2\n0 1 1 1\n", Kind::unreadable, "line 16: the file ends before hole 1"},
      {nodes + facets + "0\n1\n", Kind::unreadable, "line 16: the file ends before region 0"},
      {nodes + facets + "0\n1\n0 1 1 1\n", Kind::unreadable,
       "line 17: the line ends before the attribute of region 0"},
      {nodes + facets + "0\n1\n0 1 1 1 1.5\n", Kind::unreadable,
       "line 17: the attribute of region 0 is not an integer"},
      {nodes + facets + "0\n1\n0 1 1 1 3e9\n", Kind::unreadable, "line 17"},
      {nodes + facets + "0\n1\n0 1 1 1 nan\n", Kind::unreadable, "line 17"},
      {nodes + facets + "0\n1\n0 1 1 1 1 inf\n", Kind::unreadable,
       "line 17: the largest volume of region 0 is not finite"},
      {nodes + facets + "0\n0\n1 2 3\n", Kind::unreadable, "line 17: there is text after the last region"},
  };
  for (const auto& c : cases) {
    const auto failure = read_failure("wrong.poly", c.content);
    CAPTURE(c.content, failure.message);
    CHECK(failure.says(c.says));
    CHECK(failure.kind == c.kind);
  }
}

TEST_CASE("files that cannot be read at all") {
  const Temporary_folder folder;
  const auto message = [](const std::filesystem::path& path) -> std::string {
    try {
      pgdr::read_plc(path);
    } catch (const pgdr::Input_error& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message(folder / "missing.poly").find("missing.poly': there is no such file") != std::string::npos);
  std::filesystem::create_directory(folder / "folder.off");
  CHECK(message(folder / "folder.off").find("folder.off': it is a folder") != std::string::npos);
  CHECK(message(folder.write("a.xyz", "1")).find("the extension '.xyz' is not one of") != std::string::npos);
  CHECK(message(folder.write("noextension", "1")).find("the extension '' is not one of") !=
        std::string::npos);
  CHECK(pgdr::is_known_plc_extension("a/b.OBJ"));
  CHECK(pgdr::is_known_plc_extension("a/b.mesh"));
  CHECK_FALSE(pgdr::is_known_plc_extension("a/b.vtk"));
}

TEST_CASE("poly: every prefix of a file is read or refused, never worse") {
  const std::string whole = nodes + facets + "1\n0 9 8 7\n1\n0 0.1 0.1 0.1 10 0.5\n";
  const Temporary_folder folder;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    try {
      const auto plc = pgdr::read_plc(folder.write("prefix.poly", whole.substr(0, length)));
      CHECK(plc.facets.size() == 4);
    } catch (const pgdr::Input_error&) {
    }
  }
}
