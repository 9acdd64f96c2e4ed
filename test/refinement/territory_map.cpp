// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/refinement/territory_map.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "catch.h"
#include "seeded_random.h"

using namespace pgdr_test;
using pgdr::Territory_map;
using pgdr::Vec_3;

namespace {

/// Random points in a box twice as long along y, some of them level with others.
std::vector<Vec_3> points(std::size_t n) {
  Seeded_random random(7);
  std::vector<Vec_3> all;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = random.between(0, 1), y = random.between(0, 2), z = random.between(0, 1);
    all.push_back(k % 4 == 0 ? Vec_3{0.5, y, z} : Vec_3{x, y, z});
  }
  return all;
}

std::vector<Territory_map::Item> items(const std::vector<Vec_3>& points) {
  std::vector<Territory_map::Item> all;
  for (const Vec_3& p : points) all.push_back({p, {p, p}});
  return all;
}

std::vector<std::size_t> sizes(const Territory_map& map, const std::vector<Vec_3>& all) {
  std::vector<std::size_t> n(map.parts(), 0);
  for (const Vec_3& p : all) ++n[map(p)];
  return n;
}

}  // namespace

TEST_CASE("Territories have the shares of points that were asked for", "[refinement]") {
  const auto all = points(4000);
  for (const std::size_t parts : {2u, 4u, 16u, 64u}) {
    const Territory_map map(items(all), parts, 0.5);
    CHECK(map.parts() == parts);
    for (const std::size_t n : sizes(map, all)) {
      CHECK(n > 4000 / parts / 3);
      CHECK(n < 3 * 4000 / parts);
    }
  }
  const auto uneven = sizes(Territory_map(items(all), 2, 0.25), all);
  CHECK(uneven[0] == 1000);
  // The longer side is divided.
  CHECK(Territory_map(items(all), 2, 0.5)(Vec_3{0.9, 0.1, 0.9}) == 0);
  CHECK(Territory_map(items(all), 2, 0.5)(Vec_3{0.1, 1.9, 0.1}) == 1);
}

TEST_CASE("Long items are not cut where their side can be", "[refinement]") {
  auto rods = items(points(400));
  for (auto& rod : rods) {
    rod.box.lower.y = 0;
    rod.box.upper.y = 2;
  }
  const Territory_map map(rods, 8, 0.5);
  for (const auto& rod : rods) CHECK(map({rod.at.x, 0, rod.at.z}) == map({rod.at.x, 2, rod.at.z}));
}

TEST_CASE("The order of the items does not matter", "[refinement]") {
  const auto all = points(3000);
  auto other = all;
  std::ranges::reverse(other);
  std::ranges::rotate(other, other.begin() + 1000);
  const Territory_map a(items(all), 32, 0.4), b(items(other), 32, 0.4);
  for (const Vec_3& p : all) CHECK(a(p) == b(p));
}

TEST_CASE("A point is in the region of its territory and in no other", "[refinement]") {
  const auto all = points(500);
  for (const std::size_t parts : {2u, 8u, 32u}) {
    const Territory_map map(items(all), parts, 0.6);
    for (const Vec_3& p : all)
      for (std::size_t k = 0; k < parts; ++k) CHECK(map.region(k).contains(p) == (map(p) == k));
    CHECK(map.region(map(Vec_3{-1e9, 0, 0})).contains(Vec_3{-1e9, 0, 0}));
  }
}

TEST_CASE("Too few points, or all the same, make territories nobody lives in", "[refinement]") {
  CHECK(Territory_map({}, 4, 0.5)(Vec_3{1, 2, 3}) < 4);
  const std::vector<Vec_3> same(100, Vec_3{1, 1, 1});
  const Territory_map map(items(same), 8, 0.5);
  CHECK(std::ranges::max(sizes(map, same)) == 100);
}
