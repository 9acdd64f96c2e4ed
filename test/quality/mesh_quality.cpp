// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/quality/mesh_quality.h>

#include <cmath>
#include <numeric>

#include "catch.h"
#include "lattice_mesh.h"

namespace {

pgdr::Indexed_mesh_3 two_tetrahedra() {
  pgdr::Indexed_mesh_3 mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.75, 1.1}};
  mesh.point_references = {1, 0, 0, 0, -2};
  mesh.edges = {{0, 1}};
  mesh.edge_references = {5};
  mesh.triangles = {{0, 1, 2}, {1, 2, 3}};
  mesh.triangle_references = {7, 8};
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  mesh.tetrahedron_references = {3, 4};
  return mesh;
}

TEST_CASE("Mesh quality counts and sums", "[quality]") {
  const auto mesh = pgdr_test::lattice_mesh(4);
  const auto q = pgdr::mesh_quality(mesh);
  REQUIRE(q.vertices == 125);
  REQUIRE(q.tetrahedra == mesh.tetrahedra.size());
  REQUIRE(q.volume == Approx(1).epsilon(1e-13));
  REQUIRE(q.region_volumes.at(10) == Approx(0.5).epsilon(1e-13));
  REQUIRE(q.region_volumes.at(20) == Approx(0.5).epsilon(1e-13));
  REQUIRE(q.region_tetrahedra.at(10) + q.region_tetrahedra.at(20) == q.tetrahedra);
  REQUIRE(std::accumulate(q.dihedral_histogram.begin(), q.dihedral_histogram.end(), std::uint64_t(0)) ==
          6 * q.tetrahedra);
  REQUIRE(std::accumulate(q.ratio_histogram.begin(), q.ratio_histogram.end(), std::uint64_t(0)) ==
          q.tetrahedra);
  REQUIRE(q.mean_radius_edge_ratio > std::sqrt(6.0) / 4);
  REQUIRE(q.mean_radius_edge_ratio < q.max_radius_edge_ratio);
  REQUIRE(q.min_dihedral_deg > 0);
}

TEST_CASE("Measures of a mesh with one corner of a cube", "[quality]") {
  auto mesh = two_tetrahedra();
  mesh.tetrahedra.pop_back();
  mesh.tetrahedron_references.pop_back();
  const auto q = pgdr::mesh_quality(mesh);
  REQUIRE(q.max_circumradius == Approx(std::sqrt(0.75)));
  REQUIRE(q.max_radius_edge_ratio == Approx(std::sqrt(0.75)));
  REQUIRE(q.shortest_edge == 1);
  REQUIRE(q.min_dihedral_deg == Approx(std::atan(std::sqrt(2.0)) * 180 / std::acos(-1.0)));
  REQUIRE(q.max_dihedral_deg == Approx(90));
  REQUIRE(q.ratio_histogram[3] == 1);
  REQUIRE(q.dihedral_histogram[5] == 3);
  REQUIRE(pgdr::mesh_quality({}).tetrahedra == 0);
}

TEST_CASE("The checksum is a fixed function of the arrays", "[quality]") {
  const auto mesh = two_tetrahedra();
  const std::uint64_t sum = pgdr::mesh_checksum(mesh);
  REQUIRE(sum == 0x9a9c6f24a93dfcfu);
  REQUIRE(pgdr::mesh_checksum({}) == 0xfd888b6aac473b8bu);

  auto same = mesh;
  same.exempt = {0};
  same.point_dimensions = {0, 1, 1, 1, 3};
  REQUIRE(pgdr::mesh_checksum(same) == sum);

  auto bit = mesh;
  bit.points[4][2] = std::nextafter(bit.points[4][2], 2);
  auto order = mesh;
  std::swap(order.tetrahedra[0], order.tetrahedra[1]);
  auto marker = mesh;
  marker.triangle_references[1] = 9;
  auto zero = mesh;
  zero.points[0][0] = -0.0;
  auto moved = mesh;  // the same numbers, cut into arrays at another place
  moved.edges.clear();
  for (const auto& other : {bit, order, marker, zero, moved}) REQUIRE(pgdr::mesh_checksum(other) != sum);
}

}  // namespace
