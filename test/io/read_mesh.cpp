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
#include "sample_mesh.h"
#include "temporary_folder.h"

namespace {

pgdr::Indexed_mesh_3 meshed(const pgdr::Plc& plc, double size) {
  return pgdr::mesh_domain(pgdr::valid_domain(plc, 1e-6), pgdr::Command_line_sizing(pgdr::Uniform_sizing_field(size))).mesh;
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
  for (const char* name : {"a.mesh", "a.vtu", "b.vtu"}) {
    INFO(name);
    options.vtu.triangles = name != std::string("b.vtu");
    pgdr::write_mesh(mesh, folder / name, options);
    const pgdr::Plc again = pgdr::read_plc(folder / name);
    CHECK(again.vertices.size() == mesh.points.size());
    const pgdr::Indexed_mesh_3 same = meshed(again, 0.4);
    CHECK(tetrahedra_of(same) == tetrahedra_of(mesh));
    CHECK(counts(same.tetrahedron_references) == counts(mesh.tetrahedron_references));
    if (options.vtu.triangles) CHECK(counts(same.triangle_references) == counts(mesh.triangle_references));
    CHECK(same.triangles.size() == mesh.triangles.size());
    if (name == std::string("a.vtu")) CHECK(again.names.markers.at(3) == "in <between> & _so_ on");
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
  const pgdr::Indexed_mesh_3 mesh = meshed(plc, 1);
  const pgdr_test::Temporary_folder folder;
  pgdr::write_mesh(mesh, folder / "a.mesh");
  CHECK(counts(meshed(pgdr::read_plc(folder / "a.mesh"), 1).tetrahedron_references) == counts(mesh.tetrahedron_references));
}

TEST_CASE("a mesh that makes no sense is refused") {
  pgdr::Indexed_mesh_3 mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0, 0, 2}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}};
  CHECK_THROWS_AS(pgdr::plc_of_mesh(mesh), pgdr::Input_error);
  mesh.tetrahedra = {{0, 1, 2, 9}};
  CHECK_THROWS_AS(pgdr::plc_of_mesh(mesh), pgdr::Input_error);
}

TEST_CASE("a .vtu that is cut off or changed is read or refused, never worse") {
  const pgdr_test::Temporary_folder folder;
  pgdr::Write_options options;
  options.vtu = {true, 1};
  pgdr::write_mesh(pgdr_test::sample_mesh(4), folder / "a.vtu", options);
  std::ifstream in(folder / "a.vtu", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  std::size_t refused = 0;
  const auto look = [&](const std::string& text) {
    folder.write("b.vtu", text);
    try {
      pgdr::plc_of_mesh(pgdr::read_mesh(folder / "b.vtu"));
    } catch (const pgdr::Input_error&) {
      ++refused;
    }
  };
  for (std::size_t size = 0; size < whole.size(); size += 13) look(whole.substr(0, size));
  CHECK(refused > whole.size() / 13 * 9 / 10);
  for (std::size_t at = 0; at < whole.size(); at += 17) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x2a);
    look(changed);
  }
}
