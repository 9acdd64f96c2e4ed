// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/quality/mesh_quality.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>

#include <pgdr/quality/measures.h>
#include <pgdr/quality/shape_measures.h>

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
  REQUIRE((1 < q.aspect_ratio.mean && q.aspect_ratio.mean < q.aspect_ratio.worst));
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
  REQUIRE(q.dihedral_histogram[10] == 3);
  REQUIRE(pgdr::mesh_quality({}).tetrahedra == 0);
}

TEST_CASE("Mesh quality agrees with the measures of the tetrahedra one by one", "[quality]") {
  // Sound ones, needles, slivers, flat and tiny ones, and angles on the boundaries of the bins.
  auto mesh = pgdr_test::lattice_mesh(8, 0.2);
  std::mt19937_64 random(3);
  const auto uniform = [&random] { return std::ldexp(double(random() >> 11), -53); };
  const auto add = [&mesh](const std::array<std::array<double, 3>, 4>& points) {
    const auto v = std::uint32_t(mesh.points.size());
    mesh.points.insert(mesh.points.end(), points.begin(), points.end());
    mesh.tetrahedra.push_back({v, v + 1, v + 2, v + 3});
    mesh.tetrahedron_references.push_back(30);
  };
  for (const double flatness : {1.0, 0.1, 1e-2, 3e-3, 1e-3, 1e-5, 1e-9, 1e-13})
    for (const double size : {1.0, 1e-36, 1e34})
      for (int i = 0; i < 60; ++i) {
        const auto point = [&] {
          return std::array<double, 3>{size * uniform(), size * uniform(), size * flatness * uniform()};
        };
        add({point(), point(), point(), point()});
      }
  for (const double shortness : {1e-2, 1e-4, 1e-7})
    for (int i = 0; i < 60; ++i) {
      const double x = uniform(), y = uniform();
      add({{{0, 0, 0}, {1, 0.3, 0}, {x, y, 1}, {x + shortness * uniform(), y + shortness * uniform(), 1}}});
    }
  for (int k = 1; k < 36; ++k) {
    const double angle = k * std::acos(-1.0) / 36;
    add({{{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {std::cos(angle), std::sin(angle), 0.5}}});
  }

  const auto q = pgdr::mesh_quality(mesh);
  pgdr::Mesh_quality naive;
  naive.min_dihedral_deg = 180;
  naive.shortest_edge = 1e300;
  naive.mean_ratio.worst = naive.scaled_jacobian.worst = 1;
  std::array<double, 3> sums{};
  double volume = 0;
  for (const auto& t : mesh.tetrahedra) {
    const auto &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]], &d = mesh.points[t[3]];
    const double ratio = pgdr::radius_edge_ratio(a, b, c, d);
    naive.max_radius_edge_ratio = std::max(naive.max_radius_edge_ratio, ratio);
    naive.max_circumradius = std::max(naive.max_circumradius, std::sqrt(pgdr::squared_circumradius(a, b, c, d)));
    naive.shortest_edge = std::min(naive.shortest_edge, pgdr::shortest_edge(a, b, c, d));
    ++naive.ratio_histogram[std::size_t(std::min(ratio / 0.25, 15.0))];
    for (const double angle : pgdr::dihedral_angles_deg(a, b, c, d)) {
      naive.min_dihedral_deg = std::min(naive.min_dihedral_deg, angle);
      naive.max_dihedral_deg = std::max(naive.max_dihedral_deg, angle);
      ++naive.dihedral_histogram[std::size_t(std::min(angle / 5, 35.0))];
    }
    volume += pgdr::signed_volume(a, b, c, d);
    const pgdr::Shape_measures m = pgdr::shape_measures(a, b, c, d);
    naive.edge_ratio.worst = std::max(naive.edge_ratio.worst, m.edge_ratio);
    naive.aspect_ratio.worst = std::max(naive.aspect_ratio.worst, m.aspect_ratio);
    naive.mean_ratio.worst = std::min(naive.mean_ratio.worst, m.mean_ratio);
    naive.scaled_jacobian.worst = std::min(naive.scaled_jacobian.worst, m.scaled_jacobian);
    sums[0] += m.edge_ratio;
    sums[1] += m.mean_ratio;
    sums[2] += m.scaled_jacobian;
  }
  CHECK(q.edge_ratio.worst == naive.edge_ratio.worst);
  CHECK(q.aspect_ratio.worst == Approx(naive.aspect_ratio.worst).epsilon(1e-9));
  CHECK(q.mean_ratio.worst == Approx(naive.mean_ratio.worst).epsilon(1e-9));
  CHECK(q.scaled_jacobian.worst == Approx(naive.scaled_jacobian.worst).epsilon(1e-9));
  const double count = double(mesh.tetrahedra.size());
  CHECK(q.edge_ratio.mean == Approx(sums[0] / count).epsilon(1e-9));
  CHECK(q.mean_ratio.mean == Approx(sums[1] / count).epsilon(1e-9));
  CHECK(q.scaled_jacobian.mean == Approx(sums[2] / count).epsilon(1e-9));
  CHECK(q.dihedral_histogram == naive.dihedral_histogram);
  CHECK(q.ratio_histogram == naive.ratio_histogram);
  CHECK(q.max_radius_edge_ratio == naive.max_radius_edge_ratio);
  CHECK(q.max_circumradius == naive.max_circumradius);
  CHECK(q.shortest_edge == naive.shortest_edge);
  CHECK(q.min_dihedral_deg == naive.min_dihedral_deg);
  CHECK(q.max_dihedral_deg == naive.max_dihedral_deg);
  CHECK(q.volume == Approx(volume));
}

TEST_CASE("The checksum is a fixed function of the arrays", "[quality]") {
  const auto mesh = two_tetrahedra();
  const std::uint64_t sum = pgdr::mesh_checksum(mesh);
  REQUIRE(sum == 0x6a616ad84f5bbfdu);  // this one and the next: from the definition, by another program
  REQUIRE(pgdr::mesh_checksum({}) == 0xfd888b6aac473b8bu);

  pgdr::Indexed_mesh_3 large;  // of several blocks, the last ones with an odd number of numbers
  for (int i = 0; i < 20001; ++i) {
    large.points.push_back({double(i), 0.5 * i, double(-i)});
    large.point_references.push_back(i);
    const auto v = std::uint32_t(i);
    large.tetrahedra.push_back({v, v + 1, v + 2, v + 3});
    large.tetrahedron_references.push_back(7);
  }
  REQUIRE(pgdr::mesh_checksum(large) == 0xc933798bdbf6f32du);

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
