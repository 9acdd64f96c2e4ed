// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdint>
#include <cstring>
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

/// A square pyramid: a quadrilateral and four triangles.
const char* const pyramid_vertices[5] = {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0.5 0.5 1e-3"};
const std::vector<Polygon> pyramid_facets = {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};

std::string facet_lines(const std::string& prefix, bool counts, Index first, const std::string& suffix = "") {
  std::string text;
  for (const Polygon& facet : pyramid_facets) {
    text += prefix + (counts ? std::to_string(facet.size()) : "");
    for (const Index v : facet) text.append(" ").append(std::to_string(v + first));
    text += suffix + "\n";
  }
  return text;
}

std::string vertex_lines(const std::string& prefix, const std::string& suffix = "") {
  std::string text;
  for (const char* v : pyramid_vertices) text += prefix + v + suffix + "\n";
  return text;
}

template <class T>
std::string bytes(T value, bool swapped = false) {
  std::string result(sizeof(T), '\0');
  std::memcpy(result.data(), &value, sizeof(T));
  return swapped ? std::string(result.rbegin(), result.rend()) : result;
}

void check_pyramid(const std::string& name, const std::string& content, std::size_t first_index = 0) {
  const Temporary_folder folder;
  const pgdr_test::Cerr_capture capture;
  const auto plc = pgdr::read_plc(folder.write(name, content));
  CAPTURE(content);
  CHECK(capture.text().empty());
  CHECK(plc.nesting == pgdr::Nesting::alternate);
  CHECK(plc.first_index == first_index);
  REQUIRE(plc.vertices.size() == 5);
  CHECK(plc.vertices[2] == pgdr::Plc::Point_3(1, 1, 0));
  CHECK(plc.vertices[4].x() == 0.5);
  CHECK(plc.vertices[4].z() == Approx(1e-3));
  REQUIRE(plc.facets.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(plc.facets[i].polygons == std::vector<Polygon>{pyramid_facets[i]});
    CHECK(plc.facets[i].marker == 0);
  }
}

struct Case {
  std::string content;
  Kind kind;
  std::string says;
};

void check_failures(const std::string& name, const std::vector<Case>& cases) {
  for (const auto& c : cases) {
    const auto failure = read_failure(name, c.content);
    CAPTURE(c.content, failure.message);
    CHECK(failure.says(c.says));
    CHECK(failure.kind == c.kind);
  }
}

std::string binary_stl(const std::vector<std::vector<float>>& triangles,
                       const std::string& title = "solid binary") {
  std::string text = title;
  text.resize(80, ' ');
  text += bytes(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& t : triangles) {
    text += bytes(0.f) + bytes(0.f) + bytes(0.f);
    for (const float x : t) text += bytes(x);
    text += std::string(2, '\0');
  }
  return text;
}

}  // namespace

TEST_CASE("off: plain, with comments, colours and normals, without line breaks in the header") {
  check_pyramid("p.off", "OFF\n5 5 0\n" + vertex_lines("") + facet_lines("", true, 0));
  check_pyramid("p.OFF", "# made by hand\nOFF 5 5 9 # counts\n\n" + vertex_lines("  ", " # v") + "\n# f\n" +
                             facet_lines("", true, 0, " 255 0 0"));
  check_pyramid("p.off", "OFF\r\n5 5 0\r\n" + vertex_lines("", "\r") + facet_lines("", true, 0, "\r"));
  check_pyramid("p.off", "COFF\n5 5 0\n" + vertex_lines("", " 10 20 30 40") + facet_lines("", true, 0));
  check_pyramid("p.off",
                "NOFF\n5 5 0\n" + vertex_lines("", " 0 0 1") + facet_lines("", true, 0, " 0.5 0.5 0.5"));
}

TEST_CASE("off: doubles come through bit for bit") {
  const std::vector<double> values = {5e-324, -0.0,   1.7976931348623157e308, 2.2250738585072014e-308,
                                      0.1,    1.0 / 3};
  for (const double x : values) {
    char digits[64];
    std::snprintf(digits, sizeof digits, "%.17g", x);
    const Temporary_folder folder;
    const auto plc = pgdr::read_plc(
        folder.write("d.off", std::string("OFF\n3 1 0\n") + digits + " 1 2\n0 0 1\n0 1 0\n3 0 1 2\n"));
    CHECK(bytes(plc.vertices[0].x()) == bytes(x));
  }
}

TEST_CASE("off: errors") {
  const std::string head = "OFF\n5 5 0\n" + vertex_lines("");
  check_failures(
      "w.off",
      {
          {"", Kind::unreadable, "ends before the keyword OFF"},
          {"PLY\n", Kind::unreadable, "line 1"},
          {"4OFF\n1 1 0\n", Kind::unreadable, "line 1"},
          {"OFF BINARY\n1 1 0\n", Kind::unreadable, "line 1: binary OFF"},
          {"OFF\n2", Kind::unreadable, "the file ends before the number of facets"},
          {"OFF\n5 5 0\n0 0 0\n", Kind::unreadable, "line 3: the file ends before vertex 1"},
          {"OFF\n5 5 0\n0 0 0\n0 1,5 0\n", Kind::unreadable, "line 4: vertex 1 has a number with a comma"},
          {"OFF\n1 1 0\n0 0 nan\n3 0 0 0\n", Kind::bad_coordinate,
           "line 3: the z coordinate of vertex 0 is not a number"},
          {"OFF\n1 1 0\n0 inf 0\n3 0 0 0\n", Kind::bad_coordinate, "line 3"},
          {"OFF\n1 1 0\n0 0\n3 0 0 0\n", Kind::unreadable,
           "line 3: the line ends before the z coordinate of vertex 0"},
          {"OFF\n1 1 0\n0 a 0\n3 0 0 0\n", Kind::unreadable, "line 3: the y coordinate of vertex 0 is 'a'"},
          {head + "3 0 1 4\n", Kind::unreadable, "line 8: the file ends before facet 1"},
          {head + "3 0 1\n3 0 1 4\n3 0 1 4\n3 0 1 4\n3 0 1 4\n", Kind::unreadable,
           "line 8: the line ends before a vertex of facet 0"},
          {head + "3 0 1 5\n", Kind::bad_index, "line 8: facet 0 names vertex 5, which is not in 0..4"},
          {head + "3 0 1 -1\n", Kind::bad_index, "line 8"},
          {head + "2 0 1\n", Kind::degenerate_facet, "line 8: facet 0 has 2 vertices"},
          {head + "4000000000 0 1\n", Kind::unreadable, "too short"},
          {"OFF\n5 0 0\n" + vertex_lines(""), Kind::empty, "the surface is empty"},
          {"OFF\n0 0 0\n", Kind::empty, "the surface is empty"},
          {"OFF\n2000000000 2000000000 0\n", Kind::unreadable, "too short"},
      });
}

TEST_CASE("obj: plain, with normals and groups, relative indices, continued lines") {
  check_pyramid("p.obj", vertex_lines("v ") + facet_lines("f ", false, 1), 1);
  check_pyramid(
      "p.obj",
      "mtllib x.mtl\no thing\n" + vertex_lines("v ", " 0.5 0.5 0.5") + "vn 0 0 1\nvt 0 0\nl 1 2\n" +
          "usemtl m\nf 1/1/1\t4//1 3/1 2\nf -5 -4 -1\nf 2 \\\n3 5\nf 3 4 5\ns off\nf 4 1\\\n 5\nweird 1\n",
      1);
}

TEST_CASE("obj: errors") {
  const std::string head = vertex_lines("v ");
  check_failures(
      "w.obj", {
                   {"", Kind::empty, "empty"},
                   {head, Kind::empty, "empty"},
                   {"f 1 2 3\n", Kind::bad_index, "line 1: facet 1 names vertex 3"},
                   {"v 0,5 1 2\n" + head, Kind::unreadable, "line 1: vertex 1 has a number with a comma"},
                   {head + "f 1 2 6\nf 1 2 3\n", Kind::bad_index,
                    "line 6: facet 1 names vertex 6, which is not in 1..5"},
                   {head + "f 1 2 0\n", Kind::bad_index, "line 6"},
                   {head + "f 1 2 -6\n", Kind::bad_index, "line 6"},
                   {head + "f 1 2\n", Kind::degenerate_facet, "line 6: facet 1 has 2 vertices"},
                   {head + "f 1 2 x\n", Kind::unreadable, "line 6"},
                   {"v 1 2\n", Kind::unreadable, "line 1: the line ends before the z coordinate of vertex 1"},
                   {"v 1 2 nan\n", Kind::bad_coordinate, "line 1"},
               });
}

TEST_CASE("ply: ASCII and binary of both byte orders") {
  const std::string counts =
      "comment made by hand\nelement vertex 5\nproperty double x\nproperty double y\nproperty double "
      "z\nproperty uchar red\n"
      "element face 5\nproperty list uchar int vertex_indices\nend_header\n";
  check_pyramid("p.ply",
                "ply\nformat ascii 1.0\n" + counts + vertex_lines("", " 200") + facet_lines("", true, 0));
  check_pyramid(
      "p.ply",
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 5\nproperty list uint8 uint32 vertex_index\nend_header\n" +
          vertex_lines("") + facet_lines("", true, 0));
  const double coordinates[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1e-3}};
  for (const bool big : {false, true}) {
    std::string text =
        std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + counts;
    for (const auto& p : coordinates) text += bytes(p[0], big) + bytes(p[1], big) + bytes(p[2], big) + "\xC8";
    for (const Polygon& facet : pyramid_facets) {
      text += static_cast<char>(facet.size());
      for (const Index v : facet) text += bytes(static_cast<std::int32_t>(v), big);
    }
    check_pyramid("p.ply", text);
    const auto truncated = read_failure("w.ply", text.substr(0, text.size() - 1));
    CAPTURE(truncated.message);
    CHECK(truncated.says("the file ends within face 4"));
  }
}

TEST_CASE("ply: values too small for their type become zero") {
  const Temporary_folder folder;
  for (const std::string type : {"float", "double"}) {
    const auto plc = pgdr::read_plc(
        folder.write("s.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty " + type + " x\nproperty " +
                                  type + " y\nproperty " + type +
                                  " z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                                  "1e-400 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
    CHECK(plc.vertices[0].x() == 0);
  }
}

TEST_CASE("ply: errors") {
  const std::string vertices = "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string head = "ply\nformat ascii 1.0\n" + vertices + faces;
  check_failures(
      "w.ply",
      {
          {"", Kind::unreadable, "the file ends before end_header"},
          {"off\n", Kind::unreadable, "line 1"},
          {"ply\nformat morse 1.0\n", Kind::unreadable, "line 2"},
          {"ply\nformat ascii 1.0\nelement vertex\n", Kind::unreadable, "line 3"},
          {"ply\nformat ascii 1.0\nelement vertex 99999999999\n", Kind::unreadable, "line 3"},
          {"ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\n", Kind::unreadable, "line 4"},
          {"ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nend_header\n", Kind::unreadable,
           "x, y and z"},
          {"ply\nformat ascii 1.0\n" + vertices +
               "element face 1\nproperty list uchar short vertex_indices\nend_header\n",
           Kind::unreadable, "vertex_indices"},
          {head + "0 0 0\n1 0 0\n", Kind::unreadable, "the file ends within vertex 2"},
          {head + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", Kind::bad_coordinate,
           "line 11: the y coordinate of vertex 1"},
          {head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", Kind::bad_index, "line 13: face 0 names vertex 3"},
          {head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", Kind::bad_index, "line 13"},
          {head + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n", Kind::degenerate_facet, "line 13"},
          {head + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n", Kind::unreadable, "the file ends within face 0"},
          {head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 x\n", Kind::unreadable, "line 13"},
          {"ply\nformat ascii 1.0\n" + vertices + "end_header\n0 0 0\n1 0 0\n0 1 0\n", Kind::empty, "empty"},
          {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
               faces + "0 0 0\n1 1e300 0\n0 1 0\n3 0 1 2\n",
           Kind::bad_coordinate, "vertex 1"},
      });
}

TEST_CASE("stl: ASCII and binary, points merged") {
  const std::string ascii =
      "solid a facet of vertex names\n facet normal 0 0 nan\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
      "   vertex 0 1E0 0\n  endloop\n endfacet\n"
      "FACET NORMAL 0 0 1 OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0 VERTEX 0 0 1 ENDLOOP ENDFACET\nendsolid a "
      "facet of vertex names\n";
  const std::vector<std::vector<float>> triangles = {{0, 0, 0, 1, 0, 0, 0, 1, 0},
                                                     {0, 0, 0, 1, 0, 0, 0, 0, 1}};
  const Temporary_folder folder;
  const auto with_tail = binary_stl(triangles, "exported") + "tail";
  for (const std::string& content :
       {ascii, binary_stl(triangles), binary_stl(triangles, "exported"), with_tail}) {
    const pgdr_test::Cerr_capture capture;
    const auto plc = pgdr::read_plc(folder.write("b.STL", content));
    CHECK(capture.text().empty());
    CHECK(plc.vertices.size() == 4);
    CHECK(plc.nesting == pgdr::Nesting::alternate);
    REQUIRE(plc.facets.size() == 2);
    CHECK(plc.facets[0].polygons == std::vector<Polygon>{{0, 1, 2}});
    CHECK(plc.facets[1].polygons == std::vector<Polygon>{{0, 1, 3}});
  }
}

TEST_CASE("stl: errors") {
  const std::string triangle =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string binary = binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}}, "x");
  check_failures(
      "w.stl",
      {
          {"", Kind::empty, "empty"},
          {"solid x\n", Kind::unreadable, "the file ends before endsolid"},
          {"solid x\nendsolid x\n", Kind::empty, "empty"},
          {"solid x\n" + triangle, Kind::unreadable, "line 8: the file ends before endsolid"},
          {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n", Kind::unreadable,
           "line 5: the file ends"},
          {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 "
           "0\nendloop\nendfacet\nendsolid\n",
           Kind::unreadable, "line 7"},
          {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n", Kind::bad_coordinate, "line 4"},
          {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", Kind::unreadable, "line 4"},
          {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 o\n", Kind::unreadable, "line 4"},
          {"solid x\nvertex 0 0 0\n", Kind::unreadable, "line 2"},
          {"just text", Kind::unreadable, "header of a binary STL"},
          {binary.substr(0, 83), Kind::unreadable, "header"},
          {std::string(50, 'v') + " 0 0 1\n" + std::string(50, '2'), Kind::unreadable, "does not begin with 'solid'"},
          {binary.substr(0, binary.size() - 1), Kind::unreadable, "announces 1 triangles, but ends after 0"},
          {binary_stl({}, "x"), Kind::empty, "empty"},
          {binary_stl({{0, 0, 0, 1, 0, nan, 0, 1, 0}}, "x"), Kind::bad_coordinate, "triangle 0"},
      });
}

TEST_CASE("surfaces: every prefix of a file is read or refused, never worse") {
  const std::string off = "OFF\n5 5 0\n" + vertex_lines("") + facet_lines("", true, 0);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 5\nproperty list uchar int vertex_indices\nend_header\n" +
      vertex_lines("") + facet_lines("", true, 0);
  const std::string stl = binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 1, 0, 0, 0, 0, 1}}, "x");
  const pgdr_test::Cerr_capture capture;
  const Temporary_folder folder;
  const auto try_all = [&](const std::string& name, const std::string& whole, std::size_t least) {
    for (std::size_t length = 0; length < whole.size(); ++length) {
      try {
        pgdr::read_plc(folder.write(name, whole.substr(0, length)));
        CHECK(length >= least);
      } catch (const pgdr::Input_error&) {
      }
    }
  };
  try_all("p.off", off, off.size() - 1);
  try_all("p.ply", ply, ply.size() - 1);
  try_all("p.stl", stl, stl.size());
  CHECK(capture.text().empty());
}
