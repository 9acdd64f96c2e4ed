// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/patches.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "../catch.h"
#include "shapes.h"

namespace {

std::vector<int> markers_of(const pgdr::Plc& plc) {
  std::vector<int> markers;
  for (const auto& facet : plc.facets) markers.push_back(facet.marker);
  return markers;
}

/// A closed prism over a regular polygon: its sides turn by 360 / n degrees, its ends by 90.
pgdr::Plc prism(pgdr::Index n) {
  pgdr::Plc plc;
  std::vector<pgdr::Index> low, high;
  for (pgdr::Index i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    plc.vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
    plc.vertices.emplace_back(std::cos(angle), std::sin(angle), 1);
    low.insert(low.begin(), 2 * i);
    high.push_back(2 * i + 1);
  }
  plc.facets.push_back({{low}, {}, 0});
  for (pgdr::Index i = 0; i < n; ++i) {
    const pgdr::Index j = (i + 1) % n;
    plc.facets.push_back({{{2 * i, 2 * j, 2 * j + 1, 2 * i + 1}}, {}, 0});
  }
  plc.facets.push_back({{high}, {}, 0});
  return plc;
}

}  // namespace

TEST_CASE("a box has six patches, or one where its edges are not sharp enough") {
  pgdr::Plc plc = pgdr_test::box();
  CHECK(pgdr::mark_patches(plc, 89) == 6);
  CHECK(markers_of(plc) == std::vector{1, 2, 3, 4, 5, 6});
  plc = pgdr_test::box();
  CHECK(pgdr::mark_patches(plc, 91) == 1);
  CHECK(markers_of(plc) == std::vector{1, 1, 1, 1, 1, 1});
}

TEST_CASE("a cylinder has three patches, however its sides are oriented and however its vertices are repeated") {
  pgdr::Plc plc = prism(12);
  std::vector<int> expected(14, 2);
  expected.front() = 1;
  expected.back() = 3;
  for (const bool is_messy : {false, true}) {
    if (is_messy) {
      std::ranges::reverse(plc.facets[4].polygons[0]);
      for (pgdr::Index& v : plc.facets[7].polygons[0]) {
        const pgdr::Plc::Point_3 p = plc.vertices[v];  // a copy: the vector grows
        v = static_cast<pgdr::Index>(plc.vertices.size());
        plc.vertices.push_back(p);
      }
    }
    pgdr::Plc marked = plc;
    CHECK(pgdr::mark_patches(marked, 40) == 3);
    CHECK(markers_of(marked) == expected);
  }
}

TEST_CASE("patches leave markers that are there, and do not use them again") {
  pgdr::Plc plc = prism(12);
  plc.facets[1].marker = 2;
  const std::size_t count = pgdr::mark_patches(plc, 40);
  CHECK(count == 3);
  CHECK(plc.facets[0].marker == 1);
  CHECK(plc.facets[1].marker == 2);
  CHECK(plc.facets[2].marker == 3);
  CHECK(plc.facets[13].marker == 4);
}
