// SPDX-License-Identifier: GPL-3.0-or-later
#include "catch.h"

#include <cmath>
#include <numbers>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/small_angles_3.h>

#include "domain/shapes.h"

using namespace pgdr_test;
using pgdr::make_domain_3;
using pgdr::small_angles_3;

TEST_CASE("all angles of a cube are right") {
  for (const Plc& plc : {box(), tilted(triangulated(box()))}) {
    const auto angles = small_angles_3(make_domain_3(plc));
    for (double a : angles.vertex_deg) CHECK(a == Approx(90));
    for (double a : angles.segment_deg) CHECK(a == Approx(90));
    CHECK(angles.smallest_dihedral_deg == Approx(90));
    CHECK(angles.smallest_plane_angle_deg == Approx(90));
    CHECK(angles.plane_corners_below_14_48 == 0);
  }
}

TEST_CASE("a wedge of 10 degrees") {
  const double h = std::tan(10 * std::numbers::pi / 180);
  Plc plc;
  plc.vertices = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, h}, {1, 1, h}};
  plc.facets = {{{{0, 2, 3, 1}}, {}, 0},
                {{{0, 4, 5, 1}}, {}, 0},
                {{{0, 2, 4}}, {}, 0},
                {{{1, 3, 5}}, {}, 0},
                {{{2, 3, 5, 4}}, {}, 0}};
  const auto d = make_domain_3(tilted(plc));
  const auto angles = small_angles_3(d);
  CHECK(angles.smallest_dihedral_deg == Approx(10));
  CHECK(angles.smallest_plane_angle_deg == Approx(10));
  CHECK(angles.plane_corners_below_14_48 == 2);
  CHECK(angles.vertex_deg[0] == Approx(10));
  CHECK(angles.vertex_deg[2] == Approx(80).margin(11));
}

TEST_CASE("a regular tetrahedron") {
  Plc plc;
  plc.vertices = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  plc.facets = {{{{0, 1, 2}}, {}, 0}, {{{0, 1, 3}}, {}, 0}, {{{0, 3, 2}}, {}, 0}, {{{3, 1, 2}}, {}, 0}};
  const auto angles = small_angles_3(make_domain_3(plc));
  CHECK(angles.smallest_dihedral_deg == Approx(std::acos(1.0 / 3) * 180 / std::numbers::pi));
  CHECK(angles.smallest_plane_angle_deg == Approx(60));
  CHECK(angles.vertex_deg[0] == Approx(std::acos(1 / std::sqrt(3.0)) * 180 / std::numbers::pi));
}

TEST_CASE("a dihedral angle beyond 180 degrees is measured on its inner side") {
  // An L: its reentrant edge has 270 degrees inside and 90 outside.
  Plc plc;
  for (int z : {0, 1})
    for (const auto& p : {std::array<int, 2>{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})
      plc.vertices.emplace_back(p[0], p[1], z);
  plc.facets = {{{{0, 1, 2, 3, 4, 5}}, {}, 0}, {{{6, 7, 8, 9, 10, 11}}, {}, 0}};
  for (Index i = 0; i < 6; ++i) plc.facets.push_back({{{i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i}}, {}, 0});
  const auto angles = small_angles_3(make_domain_3(plc));
  CHECK(angles.smallest_dihedral_deg == Approx(90));
  CHECK(angles.smallest_plane_angle_deg == Approx(90));
}

TEST_CASE("a segment that stands on a facet at 30 degrees") {
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  Plc plc;
  plc.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 0}, {0.6 * c, 0, 0.6 * s}};
  plc.facets = {{{{0, 1, 2, 3}, {4}}, {}, 0}};
  plc.segments = {{4, 5, 0}};
  const auto angles = small_angles_3(make_domain_3(tilted(plc)));
  CHECK(angles.vertex_deg[4] == Approx(30));
  CHECK(angles.vertex_deg[5] == 180);
  CHECK(angles.vertex_deg[0] == Approx(90));
  CHECK(angles.smallest_dihedral_deg == 180);
}

TEST_CASE("a wall on an internal segment meets both sheets of its facet") {
  Plc plc;
  plc.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0},     {0, 1, 0},
                  {1, 0, 0}, {1, 1, 0}, {1.5, 0, 0.5}, {1.5, 1, 0.5}};
  plc.facets = {{{{0, 4, 1, 2, 5, 3}, {4, 5}}, {}, 0}, {{{4, 5, 7, 6}}, {}, 0}};
  const auto d = make_domain_3(tilted(plc));
  REQUIRE(d.facets.size() == 2);
  const auto angles = small_angles_3(d);
  CHECK(angles.smallest_dihedral_deg == Approx(45));
}

TEST_CASE("collinear segments do not make an angle") {
  Plc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  plc.facets = {{{{0, 1, 2, 3, 4}}, {}, 0}};
  const auto angles = small_angles_3(make_domain_3(plc));
  CHECK(angles.vertex_deg[1] == Approx(180));
  CHECK(angles.vertex_deg[0] == Approx(90));
}
