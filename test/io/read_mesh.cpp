// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/read_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <pgdr/domain/input_error.h>
#include <pgdr/domain/valid_domain.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/io/write_mesh.h>
#include <pgdr/mesh_domain.h>

#include "../catch.h"
#include "domain/shapes.h"
#include "../inputs.h"
#include "read_back.h"
#include "sample_mesh.h"
#include "temporary_folder.h"

namespace {

pgdr::Indexed_mesh_3 meshed(const pgdr::Plc& plc, double size, const pgdr::Parameters& parameters = {}) {
  return pgdr::mesh_domain(pgdr::valid_domain(plc, 1e-6), pgdr::Combined_sizing_field(pgdr::Uniform_sizing_field(size)), parameters).mesh;
}

std::map<int, std::size_t> counts(const std::vector<std::int32_t>& references) {
  std::map<int, std::size_t> n;
  for (const int r : references) ++n[r];
  return n;
}

std::set<std::array<std::array<double, 3>, 4>> tetrahedra_of(const pgdr::Indexed_mesh_3& mesh) {
  std::set<std::array<std::array<double, 3>, 4>> all;
  for (const auto& t : mesh.tetrahedra) {
    std::array<std::array<double, 3>, 4> corners{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]};
    std::ranges::sort(corners);
    all.insert(corners);
  }
  return all;
}

}  // namespace

TEST_CASE("a mesh that is read and meshed again within the same bounds is the same, finer ones keep its points and parts") {
  const pgdr_test::Temporary_folder folder;
  pgdr::Plc plc = pgdr::read_plc(pgdr_test::data_file("two_regions.poly"));
  plc.names.regions = {{10, "left"}};
  plc.names.markers = {{3, "in <between> & \"so\" on"}};
  const pgdr::Indexed_mesh_3 mesh = meshed(plc, 0.4);
  pgdr::Write_options options;
  options.vtu.triangles = true;
  for (const char* name : {"a.mesh", "a.vtu", "b.vtu", "4_1.msh", "4_1_text.msh", "2_2.msh"}) {
    INFO(name);
    options.gmsh = name[0] == '2' ? pgdr::Gmsh_format::ascii_2_2 : name[3] == '_' ? pgdr::Gmsh_format::ascii_4_1 : pgdr::Gmsh_format::binary_4_1;
    options.vtu.triangles = name != std::string("b.vtu");
    pgdr::write_mesh(mesh, folder / name, options);
    const pgdr::Plc again = pgdr::read_plc(folder / name);
    CHECK(again.vertices.size() == mesh.points.size());
    const pgdr::Indexed_mesh_3 same = meshed(again, 0.4);
    CHECK(tetrahedra_of(same) == tetrahedra_of(mesh));
    CHECK(counts(same.tetrahedron_references) == counts(mesh.tetrahedron_references));
    const bool is_gmsh = name[0] == '2' || name[0] == '4';  // where a marker of 0 is another
    if (options.vtu.triangles && !is_gmsh) CHECK(counts(same.triangle_references) == counts(mesh.triangle_references));
    CHECK(same.triangles.size() == mesh.triangles.size());
    if (name[0] != 'b' && name != std::string("a.mesh")) CHECK(again.names.markers.at(3) == "in <between> & _so_ on");
    if (name[0] == 'b') CHECK(again.names.markers.empty());  // nothing there has the marker
    if (name != std::string("a.mesh")) CHECK(again.names.regions.at(10) == "left");
    const pgdr::Indexed_mesh_3 finer = meshed(again, 0.15);
    CHECK(finer.tetrahedra.size() > 3 * mesh.tetrahedra.size());
    const std::set<std::array<double, 3>> points(finer.points.begin(), finer.points.end());
    for (const auto& p : mesh.points) CHECK(points.contains(p));
  }
}

TEST_CASE("a void inside a region inside a region stays one") {
  pgdr::Plc plc = pgdr_test::box({0, 0, 0}, {3, 3, 3});
  pgdr_test::add_box(plc, {0.75, 0.75, 0.75}, {2.25, 2.25, 2.25});
  pgdr_test::add_box(plc, {1.25, 1.25, 1.25}, {1.75, 1.75, 1.75});
  plc.regions = {{{0.1, 0.1, 0.1}, 1, 0, 0}, {{1, 1, 1}, 2, 0, 0}};
  plc.holes = {{1.5, 1.5, 1.5}};
  // With its slivers: what is put on facets to remove them may encroach other pieces, which are split when the mesh is meshed again.
  pgdr::Parameters parameters;
  parameters.min_dihedral = 0;
  const pgdr::Indexed_mesh_3 mesh = meshed(plc, 1, parameters);
  const pgdr_test::Temporary_folder folder;
  pgdr::write_mesh(mesh, folder / "a.mesh");
  CHECK(counts(meshed(pgdr::read_plc(folder / "a.mesh"), 1, parameters).tetrahedron_references) == counts(mesh.tetrahedron_references));
}

TEST_CASE("a mesh that makes no sense is refused") {
  pgdr::Indexed_mesh_3 mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0, 0, 2}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}};
  CHECK_THROWS_AS(pgdr::plc_of_mesh(mesh), pgdr::Input_error);
  mesh.tetrahedra = {{0, 1, 2, 9}};
  CHECK_THROWS_AS(pgdr::plc_of_mesh(mesh), pgdr::Input_error);
}

TEST_CASE("what Gmsh writes is read, in all formats and orders") {
  const pgdr_test::Temporary_folder folder;
  folder.write("a.geo",
               "SetFactory(\"OpenCASCADE\"); Box(1) = {0,0,0, 1,1,1}; Box(2) = {1,0,0, 1,1,1}; BooleanFragments{ Volume{1,2}; Delete; }{}\n"
               "Mesh.MeshSizeMax = 0.5; Physical Volume(\"left\", 7) = {1}; Physical Volume(\"the right\", 8) = {2};\n"
               "Physical Surface(\"in\", 5) = {1}; Physical Surface(\"others\", 6) = {2:11}; Physical Curve(4) = {1};\n");
  const auto gmsh = [&](const std::string& options) {
    return pgdr_test::run("gmsh -3 -v 0 '" + (folder / "a.geo").string() + "' -o '" + (folder / "a.msh").string() + "' " + options + " >/dev/null 2>&1");
  };
  if (gmsh("") == 127) PGDR_SKIP("gmsh is not installed");
  std::size_t tetrahedra = 0;
  for (const char* options : {"-format msh41", "-format msh41 -bin", "-format msh22", "-format msh41 -bin -order 2", "-format msh22 -order 2", "-format msh41 -save_parametric", "-format msh41 -bin -save_parametric"}) {
    INFO(options);
    REQUIRE(gmsh(options) == 0);
    const pgdr::Indexed_mesh_3 mesh = pgdr::read_mesh(folder / "a.msh");
    if (tetrahedra == 0) tetrahedra = mesh.tetrahedra.size();
    CHECK(tetrahedra > 50);
    CHECK(mesh.tetrahedra.size() == tetrahedra);
    CHECK(mesh.edges.size() > 1);
    CHECK(mesh.names.regions == std::map<int, std::string>{{7, "left"}, {8, "the right"}});
    CHECK(mesh.names.markers == std::map<int, std::string>{{5, "in"}, {6, "others"}});
    CHECK(counts(mesh.tetrahedron_references).size() == 2);
    const pgdr::Indexed_mesh_3 finer = meshed(pgdr::plc_of_mesh(mesh), 0.3);
    CHECK(counts(finer.tetrahedron_references).size() == 2);
    CHECK(counts(finer.triangle_references).size() == 2);
  }
  REQUIRE(gmsh("-format msh22 -bin") == 0);
  CHECK_THROWS_AS(pgdr::read_mesh(folder / "a.msh"), pgdr::Input_error);
}

TEST_CASE("a mesh file that is cut off or changed is read or refused, never worse") {
  const pgdr_test::Temporary_folder folder;
  pgdr::Write_options options;
  options.vtu = {true, 1};
  const std::string name = GENERATE(as<std::string>(), "a.vtu", "binary.msh", "text.msh", "old.msh");
  options.gmsh = name == "binary.msh" ? pgdr::Gmsh_format::binary_4_1 : name == "text.msh" ? pgdr::Gmsh_format::ascii_4_1 : pgdr::Gmsh_format::ascii_2_2;
  const std::string copy = "copy" + name.substr(name.find('.'));
  pgdr::write_mesh(pgdr_test::sample_mesh(4), folder / name, options);
  std::ifstream in(folder / name, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  std::size_t refused = 0;
  const auto look = [&](const std::string& text) {
    folder.write(copy, text);
    try {
      pgdr::plc_of_mesh(pgdr::read_mesh(folder / copy));
    } catch (const pgdr::Input_error&) {
      ++refused;
    }
  };
  for (std::size_t size = 0; size < whole.size(); size += 13) look(whole.substr(0, size));
  CHECK(refused > whole.size() / 13 * (name == "a.vtu" ? 9 : 7) / 10);  // a .msh may end after its elements, or before its last lines
  for (std::size_t at = 0; at < whole.size(); at += 17) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x2a);
    look(changed);
  }
}
