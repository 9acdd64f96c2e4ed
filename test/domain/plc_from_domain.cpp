// SPDX-License-Identifier: GPL-3.0-or-later
#include "catch.h"

#include <algorithm>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/plc_from_domain_3.h>
#include <pgdr/domain/volumes_3.h>

#include "domain/shapes.h"

using namespace pgdr_test;
using pgdr::make_domain_3;
using pgdr::plc_from_domain_3;

namespace {

/// Understanding what was written changes nothing.
Plc check_round_trip(const Plc& plc) {
  const auto d = make_domain_3(plc);
  const Plc written = plc_from_domain_3(d);
  const auto again = make_domain_3(written);
  CHECK(again.vertices == d.vertices);
  CHECK(again.vertex_markers == d.vertex_markers);
  REQUIRE(again.segments.size() == d.segments.size());
  for (std::size_t s = 0; s < d.segments.size(); ++s) {
    CHECK(again.segments[s].vertices == d.segments[s].vertices);
    CHECK(again.segments[s].facets == d.segments[s].facets);
    CHECK(again.segments[s].marker == d.segments[s].marker);
  }
  REQUIRE(again.facets.size() == d.facets.size());
  for (std::size_t f = 0; f < d.facets.size(); ++f) {
    CHECK(again.facets[f].segments == d.facets[f].segments);
    CHECK(again.facets[f].vertices == d.facets[f].vertices);
    CHECK(again.facets[f].marker == d.facets[f].marker);
    CHECK(facet_area(again, f) == Approx(facet_area(d, f)));
    CHECK(dot(pgdr::to_vec(again.facets[f].normal), pgdr::to_vec(d.facets[f].normal)) > 0.999);
  }
  const auto before = pgdr::volumes_3(d), after = pgdr::volumes_3(again);
  CHECK(after.total_material_volume() == Approx(before.total_material_volume()));
  return written;
}

}  // namespace

TEST_CASE("a fused cube is written as six quadrilaterals") {
  const Plc written = check_round_trip(tilted(triangulated(box())));
  REQUIRE(written.facets.size() == 6);
  for (const Facet& f : written.facets) {
    REQUIRE(f.polygons.size() == 1);
    CHECK(f.polygons[0].size() == 4);
  }
  CHECK(written.segments.empty());
}

TEST_CASE("facet holes are written with a seed") {
  Plc plc;
  frame(plc);
  for (Index i = 0; i < 4; ++i) {
    const Index j = (i + 1) % 4;
    plc.facets.push_back({{{i, j, 4 + j}}, {}, 2});
    plc.facets.push_back({{{4 + j, i, 4 + i}}, {}, 2});
  }
  const Plc written = check_round_trip(tilted(plc));
  REQUIRE(written.facets.size() == 1);
  CHECK(written.facets[0].polygons.size() == 2);
  CHECK(written.facets[0].holes.size() == 1);
}

TEST_CASE("an island in a hole of a facet") {
  Plc plc;
  Facet f = frame(plc);
  for (const auto& [x, y] : {std::pair{1.25, 1.25}, {1.75, 1.25}, {1.75, 1.75}, {1.25, 1.75}})
    plc.vertices.emplace_back(x, y, 0);
  f.polygons.push_back({8, 9, 10, 11});
  f.holes = {{1.1, 1.1, 0}};
  plc.facets.push_back(f);
  CHECK(facet_area(make_domain_3(plc), 0) == Approx(8.25));
  const Plc written = check_round_trip(tilted(plc));
  CHECK(written.facets[0].polygons.size() == 3);
  CHECK(written.facets[0].holes.size() == 1);
}

TEST_CASE("internal segments, isolated vertices and explicit segments survive") {
  Plc plc = box({0, 0, 0}, {4, 4, 4});
  plc.vertices.emplace_back(1, 1, 0);
  plc.vertices.emplace_back(2, 1, 0);
  plc.vertices.emplace_back(3, 3, 0);
  plc.vertices.emplace_back(2, 2, 2);
  plc.vertices.emplace_back(2, 2, 3);
  plc.vertex_markers = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};
  plc.facets[0].polygons.push_back({8, 9});
  plc.facets[0].polygons.push_back({10});
  plc.facets[1].marker = 3;
  plc.segments.push_back({11, 12, 0});
  plc.segments.push_back({0, 1, 6});
  check_round_trip(plc);
  check_round_trip(tilted(plc));
}

TEST_CASE("what markers and explicit segments kept apart stays apart") {
  Plc plc = triangulated(box());
  plc.facets[0].marker = 7;
  plc.segments.push_back({4, 7, 0});
  const Plc written = check_round_trip(tilted(plc));
  CHECK(written.facets.size() == 8);
}

TEST_CASE("voids between nested shells get hole seeds") {
  Plc plc;
  for (int i = 0; i < 4; ++i) add_box(plc, {0.0 + i, 0.0 + i, 0.0 + i}, {10.0 - i, 10.0 - i, 10.0 - i});
  plc.nesting = pgdr::Nesting::alternate;
  const Plc written = check_round_trip(tilted(triangulated(plc)));
  CHECK(written.nesting == pgdr::Nesting::fill);
  CHECK(written.holes.size() == 2);
}

TEST_CASE("loops that touch in a vertex are written one by one") {
  Plc plc;  // a bow tie of two triangles in one facet
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  plc.facets = {{{{0, 1, 2}, {0, 3, 4}}, {}, 0}};
  const Plc written = check_round_trip(plc);
  REQUIRE(written.facets.size() == 1);
  CHECK(written.facets[0].polygons.size() == 2);
  CHECK(written.facets[0].holes.empty());
}
