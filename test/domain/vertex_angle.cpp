// SPDX-License-Identifier: GPL-3.0-or-later
#include "catch.h"

#include <cmath>
#include <vector>

#include <pgdr/domain/detail/vertex_angle.h>

#include "seeded_random.h"

using pgdr::Index;
using pgdr::Vec_3;
using namespace pgdr::domain_detail;

TEST_CASE("the smallest angle at a vertex is that of all pairs, however many there are") {
  pgdr_test::Seeded_random random(7);
  const auto number = [&random] { return random.below(1u << 20) / double(1u << 19) - 1; };
  for (int round = 0; round < 60; ++round) {
    // Directions all over, or around a cone as thousands of needles have them; sectors between neighbours and elsewhere.
    const std::size_t n = round < 30 ? 5 + static_cast<std::size_t>(round) : 40 + 7 * static_cast<std::size_t>(round);
    const double flatness = std::pow(10, -(round % 6));
    std::vector<Vec_3> along;
    std::vector<std::vector<Index>> facets;
    for (std::size_t i = 0; i < n; ++i) {
      along.push_back({number(), number(), flatness * number()});
      facets.push_back({static_cast<Index>(i), static_cast<Index>(n + i)});
    }
    Vertex_angle angle;
    double expected = 180;
    for (std::size_t i = 0; i < n; ++i) angle.add_segment(along[i], facets[i]);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) expected = std::min(expected, angle_deg(along[i], along[j]));
    CHECK(angle.smallest() == expected);
    for (std::size_t k = 0; k < n; ++k) {
      const Vec_3 &p = along[k], &q = along[(k * 17 + 5) % n];
      const auto facet = static_cast<Index>(k);
      angle.add_triangle(facet, p, 3 * q);
      for (std::size_t i = 0; i < n; ++i)
        if (!std::ranges::binary_search(facets[i], facet)) expected = std::min(expected, angle_to_sector_deg(along[i], p, 3 * q));
    }
    CHECK(angle.smallest() == expected);
  }
}
