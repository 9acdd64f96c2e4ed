// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/mirrors/gaps_3.h>
#include <pgdr/refinement/indexed_mesh_of_3.h>

#include "catch.h"
#include "domain/shapes.h"
#include "refinement/any_threads.h"
#include "seeded_random.h"

using namespace pgdr_test;
using pgdr::Index;
using pgdr::Plc;
using pgdr::Vec_3;

namespace {

/// The facet of a domain that is next to the plane z = middle, on the side below or above, and about as steep as that.
template <class Domain>
Index facet_next_to(const Domain& domain, double middle, bool below) {
  for (Index f = 0; f < domain.facets.size(); ++f) {
    const auto& facet = domain.facets[f];
    if (std::abs(facet.normal[2]) < 0.9) continue;
    const double z = facet.origin[2] - middle;
    if ((below ? -z : z) > 0 && std::abs(z) < 0.1) return f;
  }
  FAIL("there is none");
  return 0;
}

/// A prism on a regular polygon with n corners, stretched along x, from z = lower to z = upper.
void add_prism(Plc& plc, Index n, double radius, const Vec_3& center, double angle, double upper) {
  const auto o = static_cast<Index>(plc.vertices.size());
  std::vector<Index> bottom, top;
  for (const double z : {center.z, upper})
    for (Index i = 0; i < n; ++i) {
      const double a = angle + 2 * std::numbers::pi * i / n;
      plc.vertices.emplace_back(center.x + 1.5 * radius * std::cos(a), center.y + radius * std::sin(a), z);
    }
  for (Index i = 0; i < n; ++i) {
    bottom.push_back(o + n - 1 - i);
    top.push_back(o + n + i);
    const Index j = (i + 1) % n;
    plc.facets.push_back({{{o + i, o + j, o + n + j, o + n + i}}, {}, 0});
  }
  plc.facets.push_back({{bottom}, {}, 0});
  plc.facets.push_back({{top}, {}, 0});
}

/// Two to four prisms on each other, turned and moved at random, with gaps of this width.
Plc stack(Random& random, double gap) {
  Plc plc;
  double z = 0;
  const std::array<Index, 5> corners{3, 4, 5, 6, 12};
  for (auto parts = 2 + static_cast<int>(random.between(0, 3)); parts > 0; --parts) {
    const double upper = z + random.between(0.05, 0.3);
    add_prism(plc, corners[static_cast<std::size_t>(random.between(0, 5))], random.between(0.3, 0.6),
              {random.between(-0.1, 0.1), random.between(-0.1, 0.1), z}, random.between(0, 7), upper);
    z = upper + gap;
  }
  return plc;
}

}  // namespace

TEST_CASE("An image across a gap is its point's reflection, on a facet, and no nearer to a point there than that is", "[conforming]") {
  Seeded_random random(1);
  for (int k = 0; k < 50; ++k) {
    const double tilt = random.between(-0.04, 0.04), gap = random.between(0.06, 0.09);
    Plc plc;
    add_box(plc, {0, 0, 0}, {1, 1, 0.5});
    add_box(plc, {0.25, 0.25, 0.5 + gap}, {2, 2, 1});
    for (const std::size_t i : {9, 11}) plc.vertices[i] = {plc.vertices[i].x(), plc.vertices[i].y(), plc.vertices[i].z() + 1.75 * tilt};
    const auto domain = pgdr::make_domain_3(plc);
    const pgdr::Gaps_3 gaps(domain);
    const Index below = facet_next_to(domain, 0.5 + gap / 2, true), above = facet_next_to(domain, 0.5 + gap / 2, false);
    CAPTURE(k, tilt, gap);
    int found = 0;
    const Vec_3 m{random.between(0.4, 0.8), random.between(0.3, 0.99), 0.5};
    gaps.for_each_image_on_facets(below, m, 1, false, [&](const pgdr::Mirror_image& i) {
      ++found;
      REQUIRE(i.on == pgdr::Feature_id{2, above});
      CHECK(i.inherits);
      const auto& facet = domain.facets[above];
      const Vec_3 normal{facet.normal[0], facet.normal[1], facet.normal[2]}, origin{facet.origin[0], facet.origin[1], facet.origin[2]};
      CHECK(pgdr::dot(i.at - origin, normal) == Approx(0).margin(1e-9));
      const Vec_3 middle = 0.5 * (m + i.at);
      // The plane halfway is as far from both: a point of the facet above is no farther from the image.
      for (int j = 0; j < 10; ++j) {
        Vec_3 c{random.between(0.25, 2), random.between(0.25, 2), 0};
        c.z = origin.z - (normal.x * (c.x - origin.x) + normal.y * (c.y - origin.y)) / normal.z;
        if (pgdr::dot(c - middle, i.at - m) > 0) CHECK(pgdr::squared_distance(i.at, c) < pgdr::squared_distance(m, c));
      }
    });
    CHECK(found == 1);
    const auto fail = [](const pgdr::Mirror_image&) { FAIL("too far"); };
    gaps.for_each_image_on_facets(below, m, 0.5 * gap, false, fail);
    gaps.for_each_image_on_facets(below, {0.1, 0.5, 0.5}, 1, false, fail);  // beside the other box
  }
}

TEST_CASE("What is between facets is meshed, or not", "[conforming]") {
  const auto plate = pgdr::make_domain_3(box({0, 0, 0}, {1, 1, 0.05}));
  const pgdr::Gaps_3 gaps(plate);
  const Index below = facet_next_to(plate, 0.025, true);
  for (const bool all : {false, true}) {
    int found = 0;
    gaps.for_each_image_on_facets(below, {0.5, 0.5, 0}, 1, all, [&](const pgdr::Mirror_image& i) {
      ++found;
      CHECK_FALSE(i.inherits);
    });
    CHECK(found == (all ? 1 : 0));
  }
}

TEST_CASE("Segments that cross each other across a gap have points where they do", "[conforming]") {
  Plc plc;
  add_box(plc, {0, 0, 0}, {3, 1, 0.5});
  add_box(plc, {1, -1, 0.501}, {2, 2, 1});
  const auto domain = pgdr::make_domain_3(plc);
  const pgdr::Gaps_3 gaps(domain);
  CHECK(gaps.crossings().size() == 4);
  for (const auto& c : gaps.crossings()) {
    CHECK(pgdr::length(c.at[0] - c.at[1]) == Approx(0.001));
    for (const std::size_t k : {0, 1}) {
      CHECK((c.at[k].x == Approx(1) || c.at[k].x == Approx(2)));
      CHECK((c.at[k].y == Approx(0).margin(1e-12) || c.at[k].y == Approx(1)));
      const auto [a, b] = domain.segments[c.segments[k]].vertices;
      CHECK(pgdr::squared_distance_to_line(c.at[k], pgdr::to_vec(domain.vertices[a]), pgdr::to_vec(domain.vertices[b])) == Approx(0).margin(1e-24));
    }
  }
}

TEST_CASE("What parts with a gap between them cost does not depend on how narrow it is", "[conforming][refinement]") {
  Seeded_random random(2);
  for (int k = 0; k < 12; ++k)
    for (const double gap : {1e-3, 1e-4, 1e-6}) {
      const Plc plc = stack(random, gap);
      CAPTURE(k, gap);
      mesh_with_any_threads(plc, 30000);
    }
}
