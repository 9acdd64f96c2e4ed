// SPDX-License-Identifier: GPL-3.0-or-later
#include "catch.h"

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/volumes_3.h>

#include "domain/shapes.h"

using namespace pgdr_test;
using pgdr::make_domain_3;
using pgdr::volumes_3;
using Point = pgdr::Default_kernel::Point_3;

TEST_CASE("a cube has an outside and an inside") {
  for (const Plc& plc : {box(), tilted(triangulated(box()))}) {
    const auto v = volumes_3(make_domain_3(plc));
    REQUIRE(v.volumes().size() == 2);
    CHECK(v.volumes()[0].outside);
    CHECK(v.volumes()[0].depth == 0);
    CHECK(v.volumes()[1].volume == Approx(1));
    CHECK(v.volumes()[1].depth == 1);
    CHECK(v.volumes()[1].region_id == 1);
    CHECK(v.total_material_volume() == Approx(1));
  }
}

TEST_CASE("points are located exactly") {
  const auto v = volumes_3(make_domain_3(box()));
  CHECK(v.locate(Point(0.5, 0.5, 0.5)) == 1);
  CHECK(v.locate(Point(0.5, 0.5, 1e-300)) == 1);
  CHECK(v.locate(Point(0.5, 0.5, -1e-300)) == 0);
  CHECK(v.locate(Point(0.5, 0.25, 0)) == v.none);
  CHECK(v.locate(Point(0.5, 0.5, 0)) == v.none);  // on the diagonal of a facet's triangulation
  CHECK(v.locate(Point(0, 0, 0.5)) == v.none);
  CHECK(v.locate(Point(0, 0, 0)) == v.none);
  CHECK(v.locate(Point(0, 0, 2)) == 0);
  CHECK(v.locate(Point(40, 40, 40)) == 0);
}

TEST_CASE("a cube with a cubic hole") {
  Plc plc = box({0, 0, 0}, {3, 3, 3});
  add_box(plc, {1, 1, 1}, {2, 2, 2});
  plc.holes.emplace_back(1.5, 1.5, 1.5);
  plc.regions.push_back({{0.5, 0.5, 0.5}, 4, 0.25});
  for (const Plc& p : {plc, tilted(plc)}) {
    const auto v = volumes_3(make_domain_3(p));
    REQUIRE(v.volumes().size() == 3);
    CHECK(v.volumes()[1].volume == Approx(26));
    CHECK(v.volumes()[1].region_id == 4);
    CHECK(v.volumes()[1].max_volume == 0.25);
    CHECK(v.volumes()[2].is_hole);
    CHECK_FALSE(v.volumes()[2].material);
    CHECK(v.volumes()[2].depth == 2);
    CHECK(v.total_material_volume() == Approx(26));
  }
}

TEST_CASE("nested shells are filled or alternate") {
  Plc plc;
  for (int i = 0; i < 4; ++i) add_box(plc, {0.0 + i, 0.0 + i, 0.0 + i}, {10.0 - i, 10.0 - i, 10.0 - i});
  CHECK(volumes_3(make_domain_3(plc)).total_material_volume() == Approx(1000));
  plc.nesting = pgdr::Nesting::alternate;
  const auto v = volumes_3(make_domain_3(tilted(triangulated(plc))));
  REQUIRE(v.volumes().size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(v.volumes()[i].depth == static_cast<int>(i));
    CHECK(v.volumes()[i].material == (i % 2 == 1));
  }
  CHECK(v.total_material_volume() == Approx(1000 - 512 + 216 - 64));
  CHECK(v.volumes()[1].region_id == 1);
  CHECK(v.volumes()[3].region_id == 2);
  for (std::size_t i = 1; i < 5; ++i) {
    const auto inside = v.interior_point(i);
    REQUIRE(inside);
    CHECK(v.locate(Point(inside->x, inside->y, inside->z)) == i);
  }
  plc.regions.push_back({{1.5, 5, 5}, 1, 0});  // a seed makes a void material
  const auto seeded = volumes_3(make_domain_3(plc));
  CHECK(seeded.volumes()[2].material);
  CHECK(seeded.volumes()[1].region_id == 2);
}

TEST_CASE("several shells side by side in one void") {
  Plc plc = box({0, 0, 0}, {10, 10, 10});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      add_box(plc, {1.0 + 3 * i, 1.0 + 3 * j, 4.0}, {2.0 + 3 * i, 2.0 + 3 * j, 5.0});
  plc.nesting = pgdr::Nesting::alternate;
  const auto v = volumes_3(make_domain_3(plc));
  REQUIRE(v.volumes().size() == 11);
  CHECK(v.total_material_volume() == Approx(1000 - 9));
}

TEST_CASE("two regions share a facet") {
  Plc plc = box();
  plc.vertices.emplace_back(2, 0, 0);
  plc.vertices.emplace_back(2, 1, 0);
  plc.vertices.emplace_back(2, 0, 1);
  plc.vertices.emplace_back(2, 1, 1);
  for (const std::vector<Index>& q :
       {std::vector<Index>{1, 8, 9, 3}, {5, 10, 11, 7}, {1, 8, 10, 5}, {3, 9, 11, 7}, {8, 9, 11, 10}})
    plc.facets.push_back({{q}, {}, 0});
  plc.regions = {{{0.5, 0.5, 0.5}, 10, 0}, {{1.5, 0.5, 0.5}, 20, 0}};
  const auto d = make_domain_3(plc);
  const auto v = volumes_3(d);
  REQUIRE(v.volumes().size() == 3);
  CHECK(v.volumes()[1].region_id == 10);
  CHECK(v.volumes()[2].region_id == 20);
  CHECK(v.volumes()[2].depth == 1);
  const Index shared = 5;  // x = 1, its normal to +x
  CHECK(v.beside(shared, 0, true) == 2);
  CHECK(v.beside(shared, 0, false) == 1);
}

TEST_CASE("a facet on a segment inside another divides the volume") {
  // The wall x = 1 stands on internal segments of four facets.
  Plc plc = box({0, 0, 0}, {2, 1, 1});
  const Index o = 8;
  for (const auto& p : {Point(1, 0, 0), Point(1, 1, 0), Point(1, 1, 1), Point(1, 0, 1)})
    plc.vertices.push_back(p);
  plc.facets[0].polygons = {{0, 2, o + 1, 3, 1, o}, {o, o + 1}};
  plc.facets[1].polygons = {{4, o + 3, 5, 7, o + 2, 6}, {o + 2, o + 3}};
  plc.facets[2].polygons = {{0, o, 1, 5, o + 3, 4}, {o, o + 3}};
  plc.facets[3].polygons = {{2, 6, o + 2, 7, 3, o + 1}, {o + 1, o + 2}};
  plc.facets.push_back({{{o, o + 1, o + 2, o + 3}}, {}, 0});
  for (const Plc& p : {plc, tilted(plc)}) {
    const auto d = make_domain_3(p);
    CHECK(d.facets.size() == 7);
    const auto v = volumes_3(d);
    REQUIRE(v.volumes().size() == 3);
    CHECK(v.volumes()[1].volume == Approx(1));
    CHECK(v.volumes()[2].volume == Approx(1));
  }
}

TEST_CASE("a dangling facet has one volume on both sides") {
  Plc plc = box({0, 0, 0}, {3, 3, 3});
  plc.vertices.emplace_back(1, 1, 1);
  plc.vertices.emplace_back(2, 1, 1);
  plc.vertices.emplace_back(1, 2, 1.5);
  plc.facets.push_back({{{8, 9, 10}}, {}, 0});
  plc.facets.push_back({{{0, 8, 9}}, {}, 0});
  const auto v = volumes_3(make_domain_3(plc));
  REQUIRE(v.volumes().size() == 2);
  CHECK(v.volumes()[1].volume == Approx(27));
  CHECK(v.beside(6, 0, true) == 1);
  CHECK(v.beside(6, 0, false) == 1);
}

TEST_CASE("shells that touch in a vertex or an edge") {
  Plc plc = box();
  add_box(plc, {1, 1, 1}, {2, 2, 2});    // a common corner
  add_box(plc, {-1, -1, 0}, {0, 0, 1});  // a common edge
  const auto v = volumes_3(make_domain_3(plc));
  REQUIRE(v.volumes().size() == 4);
  CHECK(v.total_material_volume() == Approx(3));
}

TEST_CASE("seeds outside and on facets are told") {
  Plc plc = box();
  plc.holes.emplace_back(5, 5, 5);
  plc.regions.push_back({{0.5, 0.5, 1}, 1, 0});
  const auto v = volumes_3(make_domain_3(plc));
  REQUIRE(v.lost_holes().size() == 1);
  CHECK(v.lost_holes()[0].facet == v.none);
  REQUIRE(v.lost_regions().size() == 1);
  CHECK(v.lost_regions()[0].facet != v.none);
}

TEST_CASE("an open surface encloses nothing") {
  Plc plc = box();
  plc.facets.pop_back();
  const auto v = volumes_3(make_domain_3(plc));
  CHECK_FALSE(v.closed());
  CHECK(v.total_material_volume() == 0);
}
