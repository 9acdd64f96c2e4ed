// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/mesh/edge_table.h>

#include <cstdint>
#include <map>
#include <utility>

#include "catch.h"
#include "seeded_random.h"

TEST_CASE("A table of edges holds what was set, surface after surface", "[mesh]") {
  pgdr_test::Seeded_random random(5);
  pgdr::Edge_table table;
  // Larger and smaller ones in turn, so that what an earlier one left must not show.
  for (const std::uint32_t vertices : {100u, 5000u, 70u, 20000u, 2u, 300u}) {
    const std::uint32_t edges = vertices == 2 ? 1 : 3 * vertices - 6;
    table.reset(edges);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> expected;
    while (expected.size() < edges) {
      // Many of them at one vertex, as around a vertex far away.
      const std::uint32_t a = random.below(2) == 0 ? 0 : random.below(vertices - 1);
      const std::uint32_t b = a + 1 + random.below(vertices - 1 - a);
      std::uint32_t& value = table(a, b);
      REQUIRE(value == expected[{a, b}]);
      expected[{a, b}] = value = 1 + random.below(1000);
    }
    for (const auto& [edge, value] : expected) REQUIRE(table(edge.first, edge.second) == value);
  }
}
