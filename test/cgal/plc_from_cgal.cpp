// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <pgdr/cgal/plc_from_face_graph.h>
#include <pgdr/cgal/plc_from_polygon_soup.h>
#include <pgdr/make_mesh_3.h>

#include "c3t3.h"
#include "catch.h"

namespace {

using pgdr_test::C3t3;
using Point = pgdr_test::Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

Surface unit_cube() {
  Surface cube;
  const auto p = [](int x, int y, int z) { return Point(x, y, z); };
  CGAL::make_hexahedron(p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), cube);
  return cube;
}

std::set<int> markers_of(const pgdr::Plc& plc) {
  std::set<int> markers;
  for (const auto& f : plc.facets) markers.insert(f.marker);
  return markers;
}

double volume_of(const C3t3& c3t3) {
  double volume = 0;
  for (auto c = c3t3.cells_in_complex_begin(); c != c3t3.cells_in_complex_end(); ++c) volume += c3t3.triangulation().tetrahedron(c).volume();
  return volume;
}

}  // namespace

TEST_CASE("A surface mesh with patches and feature edges becomes a PLC", "[cgal]") {
  Surface cube = unit_cube();
  CHECK(markers_of(pgdr::plc_from_face_graph(cube)) == std::set<int>{0});
  CHECK(pgdr::plc_from_face_graph(cube).segments.empty());
  auto patch = cube.add_property_map<Surface::Face_index, std::size_t>("f:patch", 4).first;
  patch[*cube.faces().begin()] = 11;
  auto is_feature = cube.add_property_map<Surface::Edge_index, bool>("e:feature", false).first;
  is_feature[*cube.edges().begin()] = true;
  const auto plc = pgdr::plc_from_face_graph(cube, CGAL::parameters::face_patch_map(patch).edge_is_constrained_map(is_feature));
  CHECK(plc.vertices.size() == 8);
  CHECK(plc.facets.size() == 6);
  CHECK(markers_of(plc) == std::set<int>{4, 11});
  REQUIRE(plc.segments.size() == 1);
  const auto e = *cube.edges().begin();
  const auto& [from, to, marker] = plc.segments[0];
  CHECK(std::set{plc.vertices[from], plc.vertices[to]} == std::set{cube.point(cube.vertex(e, 0)), cube.point(cube.vertex(e, 1))});

  const auto c3t3 = pgdr::make_mesh_3<C3t3>(plc, pgdr::Uniform_sizing_field(0.3));
  std::set<int> patches;
  for (auto f = c3t3.facets_in_complex_begin(); f != c3t3.facets_in_complex_end(); ++f) patches.insert(c3t3.surface_patch_index(*f));
  CHECK(patches == std::set<int>{4, 11});
}

TEST_CASE("Vertices that were removed leave no gap in the PLC of a surface mesh", "[cgal]") {
  Surface surface;
  const auto gone = surface.add_vertex(Point(9, 9, 9));
  CGAL::make_tetrahedron(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1), surface);
  surface.remove_vertex(gone);
  REQUIRE(surface.has_garbage());
  const auto plc = pgdr::plc_from_face_graph(surface);
  CHECK(plc.vertices.size() == 4);
  for (const auto& f : plc.facets)
    for (const pgdr::Index v : f.polygons[0]) CHECK(v < 4);
}

TEST_CASE("Polyhedra and points of other kernels of doubles are taken, too", "[cgal]") {
  CGAL::Polyhedron_3<pgdr_test::Kernel> icosahedron;
  CGAL::make_icosahedron(icosahedron, Point(0, 0, 0), 1);
  CHECK(volume_of(pgdr::make_mesh_3<C3t3>(icosahedron, pgdr::Uniform_sizing_field(0.5))) > 2.5);

  using Other = CGAL::Simple_cartesian<float>;
  CGAL::Surface_mesh<Other::Point_3> tetrahedron;
  CGAL::make_tetrahedron(Other::Point_3(0, 0, 0), Other::Point_3(1, 0, 0), Other::Point_3(0, 1, 0), Other::Point_3(0, 0, 1), tetrahedron);
  CHECK(std::abs(volume_of(pgdr::make_mesh_3<C3t3>(tetrahedron, pgdr::Uniform_sizing_field(0.5))) - 1.0 / 6) < 1e-14);
}

TEST_CASE("What a surface holds is void, what that holds is not", "[cgal]") {
  Surface nested = unit_cube();
  for (const double size : {0.6, 0.2}) {
    Surface inner = unit_cube();
    for (const auto v : inner.vertices()) inner.point(v) = Point(0.5, 0.5, 0.5) + size * (inner.point(v) - Point(0.5, 0.5, 0.5));
    nested += inner;
  }
  CHECK(std::abs(volume_of(pgdr::make_mesh_3<C3t3>(nested, pgdr::Uniform_sizing_field(0.3))) - (1 - 0.216 + 0.008)) < 1e-12);
}

TEST_CASE("A polygon soup with parts that share a face has a region for each", "[cgal]") {
  std::vector<Point> points;
  for (int x = 0; x < 3; ++x)
    for (int i = 0; i < 4; ++i) points.emplace_back(x, i & 1, i >> 1);
  std::vector<std::vector<std::size_t>> polygons;
  for (std::size_t x = 0; x < 3; ++x) polygons.push_back({4 * x, 4 * x + 1, 4 * x + 3, 4 * x + 2});
  for (std::size_t x = 0; x < 2; ++x)
    for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 3}, {3, 2}, {2, 0}}) polygons.push_back({4 * x + a, 4 * x + b, 4 * x + 4 + b, 4 * x + 4 + a});
  const auto plc = pgdr::plc_from_polygon_soup(points, polygons, [](std::size_t i) { return i == 1 ? 2 : 1; });
  const auto c3t3 = pgdr::make_mesh_3<C3t3>(plc, pgdr::Uniform_sizing_field(0.4));
  std::set<int> regions;
  for (auto c = c3t3.cells_in_complex_begin(); c != c3t3.cells_in_complex_end(); ++c) regions.insert(c->subdomain_index());
  CHECK(regions == std::set<int>{1, 2});
  for (auto f = c3t3.facets_in_complex_begin(); f != c3t3.facets_in_complex_end(); ++f) {
    const bool is_between = f->first->subdomain_index() != 0 && f->first->neighbor(f->second)->subdomain_index() != 0;
    CHECK(c3t3.surface_patch_index(*f) == (is_between ? 2 : 1));
  }
  const std::vector<std::array<int, 3>> wrong{{0, 1, 12}}, negative{{0, -1, 2}};
  CHECK_THROWS_AS(pgdr::plc_from_polygon_soup(points, wrong), std::out_of_range);
  CHECK_THROWS_AS(pgdr::plc_from_polygon_soup(points, negative), std::out_of_range);
}
