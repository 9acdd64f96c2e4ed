// SPDX-License-Identifier: GPL-3.0-or-later
// What surface files say of which facets belong together.
#include <map>
#include <string>
#include <vector>

#include <pgdr/io/read_plc.h>

#include "../catch.h"
#include "temporary_folder.h"

using pgdr::Markers_from;

namespace {

using Names = std::map<int, std::string>;

pgdr::Plc read_with(const std::string& name, const std::string& content, Markers_from from = Markers_from::names) {
  const pgdr_test::Temporary_folder folder;
  return pgdr::read_plc(folder.write(name, content), from);
}

std::vector<int> markers_of(const pgdr::Plc& plc) {
  std::vector<int> markers;
  for (const auto& facet : plc.facets) markers.push_back(facet.marker);
  return markers;
}

std::string solid(const std::string& name, const std::string& height) {
  return "solid " + name + "\nfacet normal 0 0 1\nouter loop\nvertex 0 0 " + height + "\nvertex 1 0 " + height + "\nvertex 0 1 " + height +
         "\nendloop\nendfacet\nendsolid " + name + "\n";
}

}  // namespace

TEST_CASE("solids of an STL file with different names have markers with these names") {
  const auto plc = read_with("a.stl", solid("the inlet", "0") + solid("wall", "1") + solid("the inlet", "2"));
  CHECK(plc.name == "a");
  CHECK(markers_of(plc) == std::vector{1, 2, 1});
  CHECK(plc.names.markers == Names{{1, "the inlet"}, {2, "wall"}});
  const auto one = read_with("a.stl", solid("body", "0") + solid("body", "1"));
  CHECK(markers_of(one) == std::vector{0, 0});
  CHECK(one.names.markers == Names{{0, "body"}});
  CHECK(read_with("a.stl", solid("", "0")).names.markers.empty());
  CHECK(read_with("a.stl", solid("#1", "0") + solid("part #2 ", "1")).names.markers == Names{{1, "#1"}, {2, "part #2"}});
  CHECK(read_with("a.stl", solid("Geh\xe4use", "0")).names.markers.at(0) == "Geh\xc3\xa4use");
  CHECK(read_with("a.stl", solid("Geh\xc3\xa4use", "0")).names.markers.at(0) == "Geh\xc3\xa4use");
  const auto none = read_with("a.stl", solid("a", "0") + solid("b", "1"), Markers_from::nothing);
  CHECK(markers_of(none) == std::vector{0, 0});
  CHECK(none.names.markers.empty());
}

TEST_CASE("groups, or objects, and materials of an OBJ file become markers") {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const auto groups = read_with("a.obj", corners + "o body\ng low\nusemtl steel\nf 1 3 2\ng high # a comment\nf 1 2 4\ng low\nf 2 3 4\n");
  CHECK(markers_of(groups) == std::vector{1, 2, 1});
  CHECK(groups.names.markers == Names{{1, "low"}, {2, "high"}});
  const auto materials = read_with("a.obj", corners + "usemtl wood\nf 1 3 2\nusemtl steel\nf 1 2 4\nusemtl wood\nf 2 3 4\n");
  CHECK(materials.names.markers == Names{{1, "wood"}, {2, "steel"}});
  const auto both = read_with("a.obj", corners + "g a\nusemtl x\nf 1 3 2\nusemtl y\nf 1 2 4\ng b\nf 2 3 4\n");
  CHECK(markers_of(both) == std::vector{1, 2, 3});
  CHECK(both.names.markers == Names{{1, "a:x"}, {2, "a:y"}, {3, "b:y"}});
  const auto one = read_with("a.obj", corners + "o body\nf 1 3 2\nf 1 2 4\n");
  CHECK(markers_of(one) == std::vector{0, 0});
  CHECK(one.names.markers == Names{{0, "body"}});
  CHECK(read_with("a.obj", corners + "f 1 3 2\n").names.markers.empty());
}

TEST_CASE("colours of faces become markers where that is asked for") {
  const std::string off = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 255 0 16\n3 0 1 3 0.0 1.0 0.5\n3 1 2 3\n";
  const auto plc = read_with("a.off", off, Markers_from::colors);
  CHECK(markers_of(plc) == std::vector{1, 2, 3});
  CHECK(plc.names.markers == Names{{1, "#ff0010"}, {2, "#00ff80"}});
  CHECK(markers_of(read_with("a.off", off)) == std::vector{0, 0, 0});
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 1 2 3\n3 0 1 3 250 0 0\n";
  CHECK(read_with("a.ply", ply, Markers_from::colors).names.markers == Names{{1, "#010203"}, {2, "#fa0000"}});
  CHECK(markers_of(read_with("a.ply", ply)) == std::vector{0, 0});
}
