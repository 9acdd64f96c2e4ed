// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <pgdr/io/read_plc.h>
#include <pgdr/make_mesh_3.h>

#include "c3t3.h"
#include "catch.h"
#include "inputs.h"
#include "thread_counts.h"

namespace {

using pgdr_test::C3t3;
using pgdr_test::data_file;
using Tr = C3t3::Triangulation;
using Coordinates = std::array<double, 3>;

Coordinates at(Tr::Vertex_handle v) { return {v->point().x(), v->point().y(), v->point().z()}; }

/// Points and dimensions of the vertices, in their order.
std::vector<std::pair<Coordinates, int>> vertices_of(const C3t3& c3t3) {
  std::vector<std::pair<Coordinates, int>> result;
  for (const Tr::Vertex_handle v : c3t3.triangulation().finite_vertex_handles()) result.push_back({at(v), v->in_dimension()});
  return result;
}

/// Cells of the complex in their order, each by its corners in their order.
std::vector<std::array<Coordinates, 4>> cells_of(const C3t3& c3t3) {
  std::vector<std::array<Coordinates, 4>> result;
  for (auto c = c3t3.cells_in_complex_begin(); c != c3t3.cells_in_complex_end(); ++c)
    result.push_back({at(c->vertex(0)), at(c->vertex(1)), at(c->vertex(2)), at(c->vertex(3))});
  return result;
}

std::map<int, double> volumes_of(const C3t3& c3t3) {
  std::map<int, double> result;
  for (auto c = c3t3.cells_in_complex_begin(); c != c3t3.cells_in_complex_end(); ++c)
    result[c->subdomain_index()] += c3t3.triangulation().tetrahedron(c).volume();
  return result;
}

}  // namespace

TEST_CASE("A mesh becomes CGAL's complex with all that it has", "[cgal]") {
  for (const char* name : {"two_regions.poly", "cavity.poly", "plate_with_hole.poly"}) {
    INFO(name);
    const auto mesh = pgdr::refine_mesh_3(pgdr::read_plc(data_file(name)), pgdr::Uniform_sizing_field(0.2));
    const auto c3t3 = pgdr::mesh_complex_3<C3t3>(mesh);
    const auto arrays = pgdr::indexed_mesh_3(mesh);
    REQUIRE(c3t3.triangulation().is_valid());  // every cell on an empty sphere, those outside too
    CHECK(c3t3.triangulation().number_of_vertices() == mesh.triangulation().number_of_vertices());
    CHECK(c3t3.number_of_cells_in_complex() == arrays.tetrahedra.size());
    CHECK(c3t3.number_of_facets_in_complex() == arrays.triangles.size());
    CHECK(c3t3.number_of_edges_in_complex() == arrays.edges.size());

    std::map<Coordinates, int> dimension;
    for (std::size_t i = 0; i < arrays.points.size(); ++i) dimension[arrays.points[i]] = arrays.point_dimensions[i];
    std::size_t inside = 0;
    for (const auto& [p, d] : vertices_of(c3t3)) {
      const auto found = dimension.find(p);
      CHECK(d == (found == dimension.end() ? 3 : found->second));
      inside += found != dimension.end();
    }
    CHECK(inside == arrays.points.size());

    std::map<int, double> wanted;
    for (std::size_t i = 0; i < arrays.tetrahedra.size(); ++i) {
      const auto p = [&](std::size_t k) { return pgdr::to_vec(arrays.points[arrays.tetrahedra[i][k]]); };
      wanted[arrays.tetrahedron_references[i]] += dot(p(1) - p(0), cross(p(2) - p(0), p(3) - p(0))) / 6;
    }
    const auto found = volumes_of(c3t3);
    REQUIRE(found.size() == wanted.size());
    for (const auto& [id, volume] : wanted) CHECK(std::abs(found.at(id) - volume) < 1e-12 * volume);
  }
}

TEST_CASE("The complex has the markers of the input, and a number where there is none", "[cgal]") {
  pgdr::Plc cube = pgdr::read_plc(data_file("cube.poly"));
  for (std::size_t f = 0; f < cube.facets.size(); ++f) cube.facets[f].marker = f == 2 ? 0 : 7 + static_cast<int>(f);
  const int most = 6 + static_cast<int>(cube.facets.size());
  const auto [a, b] = std::pair{cube.facets[0].polygons[0][0], cube.facets[0].polygons[0][1]};
  cube.segments.push_back({a, b, 5});
  const auto c3t3 = pgdr::make_mesh_3<C3t3>(cube, pgdr::Uniform_sizing_field(0.2));
  std::set<int> patches, curves;
  for (auto f = c3t3.facets_in_complex_begin(); f != c3t3.facets_in_complex_end(); ++f) {
    patches.insert(c3t3.surface_patch_index(*f));
    CHECK(c3t3.surface_patch_index(*f) == c3t3.surface_patch_index(c3t3.triangulation().mirror_facet(*f)));
  }
  for (auto e = c3t3.edges_in_complex_begin(); e != c3t3.edges_in_complex_end(); ++e) curves.insert(c3t3.curve_index(*e));
  CHECK(patches == std::set<int>{7, 8, 10, 11, 12, most + 1});
  CHECK(curves.size() == 12);
  CHECK(*curves.begin() == 5);
  CHECK(c3t3.number_of_corners() == 8);
  for (auto c = c3t3.cells_in_complex_begin(); c != c3t3.cells_in_complex_end(); ++c) CHECK(c->info().value == 3);
}

TEST_CASE("Numbers for what has no marker do not wrap", "[cgal]") {
  pgdr::Plc cube = pgdr::read_plc(data_file("cube.poly"));
  for (auto& f : cube.facets) f.marker = 0;
  cube.facets[0].marker = std::numeric_limits<int>::max();
  CHECK_THROWS_AS(pgdr::make_mesh_3<C3t3>(cube, pgdr::Uniform_sizing_field(0.5)), std::length_error);
  cube.facets[0].marker = -5;
  const auto c3t3 = pgdr::make_mesh_3<C3t3>(cube, pgdr::Uniform_sizing_field(0.5));
  std::set<int> patches;
  for (auto f = c3t3.facets_in_complex_begin(); f != c3t3.facets_in_complex_end(); ++f) patches.insert(c3t3.surface_patch_index(*f));
  CHECK(patches == std::set<int>{-5, 1});
}

TEST_CASE("The complex and its order are the same for every number of threads", "[cgal]") {
  const auto plc = pgdr::read_plc(data_file("winged_body_in_box.poly"));
  pgdr::Parameters parameters;
  std::vector<std::pair<Coordinates, int>> vertices;
  std::vector<std::array<Coordinates, 4>> cells;
  for (const unsigned threads : pgdr_test::thread_counts()) {
    INFO(threads << " threads");
    parameters.threads = threads;
    const auto c3t3 = pgdr::make_mesh_3<C3t3>(plc, pgdr::Uniform_sizing_field(), parameters);
    if (vertices.empty()) {
      vertices = vertices_of(c3t3);
      cells = cells_of(c3t3);
      REQUIRE(cells.size() > 1000);
    }
    CHECK((vertices_of(c3t3) == vertices));
    CHECK((cells_of(c3t3) == cells));
  }
}

TEST_CASE("The complex is in the user's unit", "[cgal]") {
  pgdr::Plc cube = pgdr::read_plc(data_file("cube.poly"));
  for (auto& p : cube.vertices) p = {1e40 * p.x(), 1e40 * p.y(), 1e40 * p.z()};
  const auto c3t3 = pgdr::make_mesh_3<C3t3>(cube, pgdr::Uniform_sizing_field(4e39));
  const auto box = CGAL::bbox_3(c3t3.triangulation().points_begin(), c3t3.triangulation().points_end());
  CHECK(box.xmin() == 0);
  CHECK(box.xmax() == 1e40);
  CHECK(c3t3.number_of_cells_in_complex() > 50);
}

TEST_CASE("A mesh is refined further", "[cgal]") {
  for (const char* name : {"two_regions.poly", "cavity.poly", "plate_with_hole.poly"}) {
    INFO(name);
    pgdr::Plc plc = pgdr::read_plc(data_file(name));
    for (std::size_t f = 0; f < plc.facets.size(); ++f) plc.facets[f].marker = 1 + static_cast<int>(f);
    C3t3 c3t3 = pgdr::make_mesh_3<C3t3>(plc, pgdr::Uniform_sizing_field(0.4));
    const auto volumes = volumes_of(c3t3);
    const std::size_t cells = c3t3.number_of_cells_in_complex(), corners = c3t3.number_of_corners();
    std::map<int, double> areas;
    const auto areas_of = [](const C3t3& c) {
      std::map<int, double> result;
      for (auto f = c.facets_in_complex_begin(); f != c.facets_in_complex_end(); ++f)
        result[c.surface_patch_index(*f)] += std::sqrt(c.triangulation().triangle(*f).squared_area());
      return result;
    };
    areas = areas_of(c3t3);
    const auto before = vertices_of(c3t3);
    pgdr::refine_mesh_3(c3t3, pgdr::Uniform_sizing_field(0.1));
    REQUIRE(c3t3.triangulation().is_valid());
    CHECK(c3t3.number_of_cells_in_complex() > 4 * cells);
    CHECK(c3t3.number_of_corners() == corners);
    std::map<Coordinates, int> after;
    for (const auto& [p, d] : vertices_of(c3t3)) after[p] = d;
    for (const auto& [p, d] : before)
      if (d != -1) CHECK(after.at(p) == d);
    const auto now = volumes_of(c3t3), areas_now = areas_of(c3t3);
    REQUIRE(now.size() == volumes.size());
    for (const auto& [id, volume] : volumes) CHECK(std::abs(now.at(id) - volume) < 1e-12 * volume);
    REQUIRE(areas_now.size() == areas.size());
    for (const auto& [patch, area] : areas) CHECK(std::abs(areas_now.at(patch) - area) < 1e-12 * area);
  }
}

TEST_CASE("What is not Delaunay, or has no facets between its parts, is not refined further", "[cgal]") {
  const C3t3 mesh = pgdr::make_mesh_3<C3t3>(pgdr::read_plc(data_file("cube.poly")), pgdr::Uniform_sizing_field(0.2));
  C3t3 moved = mesh;
  const auto& tr = moved.triangulation();
  bool is_moved = false;
  for (const Tr::Vertex_handle v : tr.finite_vertex_handles()) {
    if (is_moved || v->in_dimension() != 3) continue;
    std::vector<Tr::Vertex_handle> around;
    tr.adjacent_vertices(v, std::back_inserter(around));
    v->set_point(CGAL::midpoint(v->point(), CGAL::midpoint(v->point(), around[0]->point())));
    is_moved = true;
  }
  REQUIRE(is_moved);
  REQUIRE_THROWS_AS(pgdr::refine_mesh_3(moved, pgdr::Uniform_sizing_field(0.1)), std::invalid_argument);
  CHECK(moved.number_of_cells_in_complex() == mesh.number_of_cells_in_complex());

  C3t3 other = mesh;
  other.cells_in_complex_begin()->set_subdomain_index(9);
  CHECK_THROWS_AS(pgdr::plc_from_mesh_complex_3(other), std::invalid_argument);
}
