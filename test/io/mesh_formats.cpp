// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <pgdr/io/medit.h>
#include <pgdr/io/second_order.h>
#include <pgdr/io/su2.h>
#include <pgdr/io/tetgen.h>
#include <pgdr/io/write_mesh.h>

#include "../catch.h"
#include "read_back.h"
#include "sample_mesh.h"
#include "temporary_folder.h"

namespace {

/// With references that are no tags: 0, negative, and the largest there is.
pgdr::Indexed_mesh_3 mesh_with_references() {
  pgdr::Indexed_mesh_3 mesh = pgdr_test::sample_mesh(5);
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) mesh.tetrahedron_references[i] = static_cast<std::int32_t>(i % 3) - 1;  // -1, 0, 1
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) mesh.triangle_references[i] = i == 0 ? 0 : i == 1 ? 2147483647 : 7;
  return mesh;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

int read_back(const std::filesystem::path& file, const pgdr::Indexed_mesh_3& mesh, const std::string& more) {
  return pgdr_test::read_back(file, mesh.points.size(), mesh.tetrahedra.size(), more);
}

template <class T>
std::map<std::int32_t, std::size_t> count(const std::vector<T>& references) {
  std::map<std::int32_t, std::size_t> n;
  for (const T r : references) ++n[r];
  return n;
}

}  // namespace

TEST_CASE("meshes with groups read into meshio, in all formats that have some") {
  const pgdr_test::Temporary_folder folder;
  const auto mesh = mesh_with_references();
  std::string groups;
  for (const auto& [r, n] : count(mesh.tetrahedron_references)) groups += " --group region_" + std::to_string(r) + ":tetra:" + std::to_string(n);
  std::string with_triangles = groups;
  for (const auto& [r, n] : count(mesh.triangle_references)) with_triangles += " --group marker_" + std::to_string(r) + ":triangle:" + std::to_string(n);
  int code = 0;
  for (const auto format : {pgdr::Gmsh_format::binary_4_1, pgdr::Gmsh_format::ascii_4_1, pgdr::Gmsh_format::ascii_2_2}) {
    pgdr::write_mesh(mesh, folder / "a.msh", {format, {}});
    code = read_back(folder / "a.msh", mesh, with_triangles);
    if (code == 77) PGDR_SKIP("python3-meshio is not installed");
    CHECK(code == 0);
    CHECK(read_back(folder / "a.msh", mesh, " --group region_1:tetra:1 2>/dev/null") == 1);
  }
  pgdr::write_mesh(mesh, folder / "a.inp");
  CHECK(read_back(folder / "a.inp", mesh, groups) == 0);
  pgdr::write_mesh(mesh, folder / "a.ele");
  CHECK(read_back(folder / "a.ele", mesh, groups) == 0);
  pgdr::write_mesh(mesh, folder / "a.su2");
  CHECK(read_back(folder / "a.su2", mesh, "") == 0);
}

TEST_CASE("groups have the names that regions and markers have, as far as a format allows") {
  const pgdr_test::Temporary_folder folder;
  auto mesh = mesh_with_references();
  mesh.names.regions = {{0, "steel"}, {1, "steel"}, {5, "of nothing"}};
  mesh.names.markers = {{7, "the \"inlet\""}};
  const auto tetrahedra = count(mesh.tetrahedron_references);
  const auto triangles = count(mesh.triangle_references);
  const auto group = [](const std::string& name, const char* type, std::size_t n) { return " --group '" + name + ":" + type + ":" + std::to_string(n) + "'"; };
  const std::string regions = group("region_-1", "tetra", tetrahedra.at(-1)) + group("steel", "tetra", tetrahedra.at(0)) + group("steel_1", "tetra", tetrahedra.at(1));
  pgdr::write_mesh(mesh, folder / "a.msh");
  const int code = read_back(folder / "a.msh", mesh, regions + group("the _inlet_", "triangle", triangles.at(7)));
  if (code == 77) PGDR_SKIP("python3-meshio is not installed");
  CHECK(code == 0);
  mesh.names.markers[2147483647] = "steel";  // a region's, too
  pgdr::write_mesh(mesh, folder / "a.inp");
  CHECK(text_of(folder / "a.inp").find("NAME=steel_surface\n") != std::string::npos);
  CHECK(read_back(folder / "a.inp", mesh, regions) == 0);
  CHECK(text_of(folder / "a.inp").find("NAME=the__inlet_\n") != std::string::npos);
  pgdr::write_mesh(mesh, folder / "a.su2");
  CHECK(text_of(folder / "a.su2").find("MARKER_TAG= the__inlet_\n") != std::string::npos);
  pgdr::Write_options options;
  options.vtu = {true, 9};
  mesh.triangle_input_facets.clear();
  pgdr::write_mesh(mesh, folder / "a.vtu", options);
  CHECK(read_back(folder / "a.vtu", mesh, " --triangles " + std::to_string(mesh.triangles.size()) + group("the _inlet_", "triangle", triangles.at(7))) == 0);
}

TEST_CASE("two names that are equal, but for case perhaps, are two in every file") {
  const pgdr_test::Temporary_folder folder;
  auto mesh = mesh_with_references();
  mesh.names.markers = {{0, "Wall"}, {7, "wall"}, {2147483647, "wall"}};
  for (const char* file : {"a.inp", "a.su2", "a.vtu"}) {
    INFO(file);
    pgdr::write_mesh(mesh, folder / file);
    const std::string text = text_of(folder / file);
    for (const char* name : {"Wall", "wall_7", "wall_2147483647"}) CHECK(text.find(name) != std::string::npos);
  }
}

TEST_CASE("formats without a second order refuse it") {
  const pgdr_test::Temporary_folder folder;
  auto mesh = pgdr_test::sample_mesh(2);
  pgdr::add_midside_nodes(mesh);
  CHECK_THROWS_AS(pgdr::write_su2(mesh, folder / "a.su2"), std::invalid_argument);
  CHECK_THROWS_AS(pgdr::write_medit(mesh, folder / "a.mesh"), std::invalid_argument);
}

TEST_CASE("an SU2 file has a marker for each marker") {
  const pgdr_test::Temporary_folder folder;
  const auto mesh = mesh_with_references();
  pgdr::write_mesh(mesh, folder / "a.su2");
  const std::string text = text_of(folder / "a.su2");
  CHECK(text.find("\nNMARK= 3\n") != std::string::npos);
  for (const auto& [r, n] : count(mesh.triangle_references))
    CHECK(text.find("\nMARKER_TAG= marker_" + std::to_string(r) + "\nMARKER_ELEMS= " + std::to_string(n) + "\n") != std::string::npos);
}

TEST_CASE("TetGen's files hold points, tetrahedra, faces and edges with what they refer to") {
  const pgdr_test::Temporary_folder folder;
  const auto mesh = mesh_with_references();
  CHECK(pgdr::mesh_files(folder / "a.ele").size() == 4);
  pgdr::write_mesh(mesh, folder / "a.ele");
  const auto check = [&](const char* name, std::size_t columns, const auto& elements, const std::vector<std::int32_t>& references) {
    INFO(name);
    std::istringstream in(text_of(folder / name));
    std::size_t n = 0;
    std::string rest;
    in >> n;
    std::getline(in, rest);
    REQUIRE(n == elements.size());
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t number = 0;
      in >> number;
      CHECK(number == i);
      for (std::size_t k = 0; k < columns; ++k) {
        double x = 0;
        in >> x;
        CHECK(x == static_cast<double>(elements[i][k]));
      }
      std::int32_t reference = 0;
      in >> reference;
      CHECK(reference == references[i]);
    }
    in >> rest;
    CHECK_FALSE(in);
  };
  check("a.node", 3, mesh.points, mesh.point_references);
  check("a.ele", 4, mesh.tetrahedra, mesh.tetrahedron_references);
  check("a.face", 3, mesh.triangles, mesh.triangle_references);
  check("a.edge", 2, mesh.edges, mesh.edge_references);
}

TEST_CASE("the surfaces of an Abaqus deck are sides of tetrahedra") {
  const pgdr_test::Temporary_folder folder;
  pgdr::Indexed_mesh_3 mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 3, 2, 4}};
  mesh.tetrahedron_references = {7, 4};  // so that the second one is written first
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {1, 4, 2}};
  mesh.triangle_references = {1, 1, 2, 1, 3};
  pgdr::write_mesh(mesh, folder / "a.inp");
  const std::string text = text_of(folder / "a.inp");
  CHECK(text.find("ELSET=region_4\n1,2,4,3,5\n") != std::string::npos);
  CHECK(text.find("ELSET=region_7\n2,1,2,3,4\n") != std::string::npos);
  CHECK(text.find("NAME=marker_1\n2,S1\n2,S2\n2,S4\n") != std::string::npos);
  CHECK(text.find("NAME=marker_2\n2,S3\n") != std::string::npos);
  CHECK(text.find("NAME=marker_3\n1,S4\n") != std::string::npos);
}

TEST_CASE("no number of an Abaqus deck has more than 20 characters, and all read back to 13 digits") {
  const pgdr_test::Temporary_folder folder;
  pgdr::Indexed_mesh_3 mesh;
  mesh.points = {{0, 0, 0}, {-1.2345678901234567e-105, 1.2345678901234567, -1234567.8901234567}, {0.1, -0.30000000000000004, 1e300}, {3, 4, 5}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  pgdr::write_mesh(mesh, folder / "a.inp");
  std::istringstream in(text_of(folder / "a.inp"));
  std::string word;
  while (std::getline(in, word) && word != "*NODE") {}
  for (const auto& p : mesh.points) {
    std::getline(in, word, ',');
    for (std::size_t k = 0; k < 3; ++k) {
      std::getline(in, word, k < 2 ? ',' : '\n');
      CHECK(word.size() <= 20);
      CHECK(std::stod(word) == Approx(p[k]).epsilon(1e-12));
    }
  }
}

TEST_CASE("lengths come out in the user's unit in every format") {
  const pgdr_test::Temporary_folder folder;
  pgdr::Indexed_mesh_3 mesh;
  mesh.exponent = 2;
  mesh.points = {{0, 0, 0}, {1.25, 0, 0}, {0, 1.25, 0}, {0, 0, 1.25}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  mesh.triangles = {{0, 2, 1}};
  for (const char* name : {"a.inp", "a.su2", "a.ele", "a.mesh"}) {
    INFO(name);
    pgdr::write_mesh(mesh, folder / name);
    const std::string text = text_of(folder / (name == std::string("a.ele") ? "a.node" : name));
    CHECK(text.find("1.25") == std::string::npos);
    CHECK(text.find('5') != std::string::npos);
  }
  for (const auto format : {pgdr::Gmsh_format::ascii_4_1, pgdr::Gmsh_format::ascii_2_2}) {
    pgdr::write_gmsh(mesh, folder / "a.msh", format);
    CHECK(text_of(folder / "a.msh").find("1.25") == std::string::npos);
  }
}
