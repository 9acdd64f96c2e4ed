// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include <pgdr/io/read_plc.h>
#include <pgdr/io/write_poly.h>

#include "../catch.h"
#include "temporary_folder.h"

namespace {

using pgdr::Plc;
using Point_3 = Plc::Point_3;

bool same(const Point_3& p, const Point_3& q) {
  for (int i = 0; i < 3; ++i) {
    if (std::bit_cast<std::uint64_t>(p[i]) != std::bit_cast<std::uint64_t>(q[i])) return false;
  }
  return true;
}

bool same(const std::vector<Point_3>& a, const std::vector<Point_3>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!same(a[i], b[i])) return false;
  }
  return true;
}

void check_same(const Plc& a, const Plc& b) {
  CHECK(same(a.vertices, b.vertices));
  CHECK(a.vertex_markers == b.vertex_markers);
  CHECK(same(a.holes, b.holes));
  CHECK(a.first_index == b.first_index);
  CHECK(a.nesting == b.nesting);
  REQUIRE(a.facets.size() == b.facets.size());
  for (std::size_t i = 0; i < a.facets.size(); ++i) {
    CHECK(a.facets[i].polygons == b.facets[i].polygons);
    CHECK(same(a.facets[i].holes, b.facets[i].holes));
    CHECK(a.facets[i].marker == b.facets[i].marker);
  }
  REQUIRE(a.segments.size() == b.segments.size());
  for (std::size_t i = 0; i < a.segments.size(); ++i) {
    CHECK(a.segments[i].source == b.segments[i].source);
    CHECK(a.segments[i].target == b.segments[i].target);
    CHECK(a.segments[i].marker == b.segments[i].marker);
  }
  REQUIRE(a.regions.size() == b.regions.size());
  for (std::size_t i = 0; i < a.regions.size(); ++i) {
    CHECK(same(a.regions[i].point, b.regions[i].point));
    CHECK(a.regions[i].id == b.regions[i].id);
    CHECK(a.regions[i].max_volume == b.regions[i].max_volume);
  }
}

Plc full_plc() {
  Plc plc;
  std::mt19937_64 random(7);
  const auto any_double = [&] {
    for (;;) {
      const double x = std::bit_cast<double>(random());
      if (std::isfinite(x)) return x;
    }
  };
  for (int i = 0; i < 1000; ++i) plc.vertices.emplace_back(any_double(), any_double(), any_double());
  plc.vertices.emplace_back(-0.0, 5e-324, 1.7976931348623157e308);
  for (std::size_t i = 0; i < plc.vertices.size(); ++i)
    plc.vertex_markers.push_back(static_cast<int>(i) - 500);
  plc.facets.resize(2);
  plc.facets[0].polygons = {{0, 1, 2, 3}, {4, 5, 6}, {7, 8}, {9}};
  plc.facets[0].holes = {{0.1, 0.2, 0.3}, {any_double(), 0, 1}};
  plc.facets[0].marker = -7;
  plc.facets[1].polygons = {{1000, 3, 2}};
  plc.segments = {{1, 2, 3}, {10, 20, -2147483647}};
  plc.holes = {{any_double(), any_double(), any_double()}};
  plc.regions.resize(2);
  plc.regions[0] = {Point_3(1, 2, any_double()), 2147483647, 1e-30};
  plc.regions[1] = {Point_3(1, 2, 3), -5, 0};
  return plc;
}

}  // namespace

TEST_CASE("write_poly: what is read back is what was written, bit for bit") {
  const pgdr_test::Temporary_folder folder;
  Plc plc = full_plc();
  for (const std::size_t first : {std::size_t(0), std::size_t(1)}) {
    plc.first_index = first;
    pgdr::write_poly(plc, folder / "a.poly");
    check_same(plc, pgdr::read_plc(folder / "a.poly"));
    CHECK(folder.size() == 1);
  }
  plc.vertex_markers.clear();
  pgdr::write_poly(plc, folder / "a.poly");
  check_same(plc, pgdr::read_plc(folder / "a.poly"));
}

TEST_CASE("write_poly: the text") {
  const pgdr_test::Temporary_folder folder;
  Plc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}};
  plc.facets.resize(1);
  plc.facets[0].polygons = {{0, 1, 2}};
  plc.facets[0].marker = 4;
  plc.first_index = 1;
  plc.regions = {{Point_3(0.5, 0.25, 0), 3, 0}};
  pgdr::write_poly(plc, folder / "a.poly");
  CHECK(pgdr_test::content_of(folder / "a.poly") ==
        "# vertices\n3 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 0.1 0\n"
        "# facets\n1 1\n1 0 4\n3 1 2 3\n"
        "# holes\n0\n"
        "# regions: point, attribute, largest volume or -1\n1\n1 0.5 0.25 0 3 -1\n");
}
