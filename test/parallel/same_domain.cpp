// SPDX-License-Identifier: GPL-3.0-or-later
// What is found in a large surface: the same for any number of threads, and boxes that meet once each.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include <pgdr/domain/detail/box_pairs.h>
#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/parallel/thread_arena.h>
#include <pgdr/simplify/surface_distance.h>

#include "catch.h"
#include "domain/shapes.h"
#include "thread_counts.h"

using namespace pgdr;
using pgdr_test::thread_counts;

namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
using Pair = std::pair<std::size_t, std::size_t>;

/// A sheet over the unit square, half of it plane, as triangles.
void add_sheet(Plc& plc, Index n, double height, double wave) {
  const Index first = static_cast<Index>(plc.vertices.size());
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      plc.vertices.emplace_back(x, y, height + (2 * i < n ? 0 : wave * std::sin(9 * x) * std::cos(7 * y)));
    }
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const Index a = first + i * (n + 1) + j, b = a + n + 1;
      plc.facets.push_back({{{a, b, a + 1}}, {}, 0});
      plc.facets.push_back({{{b, b + 1, a + 1}}, {}, 0});
    }
}

/// Small boxes, and a large one now and then.
std::vector<Box> boxes(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Box> result;
  for (std::size_t i = 0; i < n; ++i) {
    const double size = i % 500 == 0 ? 0.5 : 0.08, x = 3 * number(), y = number(), z = number();
    result.emplace_back(CGAL::Bbox_3(x, y, z, x + size * number(), y + size * number(), z + size * number()), i);
  }
  return result;
}

bool meet(const Box& a, const Box& b) { return CGAL::do_overlap(a.bbox(), b.bbox()); }

}  // namespace

TEST_CASE("Boxes that meet are found once", "[parallel]") {
  const std::size_t n = 3 * default_grain;  // slabs
  const std::vector<Box> first = boxes(n, 1), second = boxes(n / 2, 2);
  std::vector<Pair> own, both;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j)
      if (meet(first[i], first[j])) own.emplace_back(i, j);
    for (std::size_t j = 0; j < second.size(); ++j)
      if (meet(first[i], second[j])) both.emplace_back(i, j);
  }
  REQUIRE(own.size() > n / 2);
  for (const unsigned threads : thread_counts())
    with_threads(threads, [&] {
      auto pairs = domain_detail::Box_slabs(first).pairs<Pair>([](const Box& a, const Box& b, std::vector<Pair>& list) { list.emplace_back(std::minmax(a.info(), b.info())); });
      std::ranges::sort(pairs);
      CHECK(pairs == own);
      std::vector<std::vector<std::size_t>> others(n);
      domain_detail::Box_slabs(first).for_each_with(domain_detail::Box_slabs(second), [&](const Box& a, const Box& b) { others[a.info()].push_back(b.info()); });
      std::vector<Pair> found;
      for (std::size_t i = 0; i < n; ++i)
        for (const std::size_t j : others[i]) found.emplace_back(i, j);
      std::ranges::sort(found);
      CHECK(found == both);
    });
  CHECK(domain_detail::Box_slabs(std::vector<Box>{}).pairs<Pair>([](const Box&, const Box&, std::vector<Pair>&) {}).empty());
}

TEST_CASE("A large surface is the same domain, with the same faults, for any number of threads", "[parallel]") {
  Plc plc;
  add_sheet(plc, 80, 0, 0.1);
  add_sheet(plc, 70, 0.05, 0.02);  // crosses the first
  plc.segments.push_back({0, 81, 7});
  const auto look = [&](unsigned threads) {
    return with_threads(threads, [&] {
      const auto domain = make_domain_3(plc);
      return std::tuple(domain, validate_domain_3(domain, 10000), small_angles_3(domain), surface_distance(plc, plc, 1e-3));
    });
  };
  const auto [domain, problems, angles, distance] = look(1);
  REQUIRE(plc.facets.size() > 5 * default_grain);
  REQUIRE(domain.facets.size() < plc.facets.size() - 9000);
  REQUIRE(problems.size() > 100);
  REQUIRE(distance);
  CHECK(distance->is_within);
  for (const unsigned threads : thread_counts()) {
    const auto [again, faults, same_angles, same_distance] = look(threads);
    CHECK(again.vertices == domain.vertices);
    CHECK(std::ranges::equal(again.facets, domain.facets, [](const auto& a, const auto& b) {
      return a.input_facets == b.input_facets && a.normal == b.normal && a.segments == b.segments && a.vertices == b.vertices && a.triangles == b.triangles;
    }));
    CHECK(std::ranges::equal(again.segments, domain.segments, [](const auto& a, const auto& b) { return a.vertices == b.vertices && a.marker == b.marker && a.facets == b.facets; }));
    CHECK(std::ranges::equal(faults, problems, {}, &Input_problem::message, &Input_problem::message));
    CHECK(same_angles.vertex_deg == angles.vertex_deg);
    CHECK(same_angles.segment_deg == angles.segment_deg);
    CHECK(same_distance->seen == distance->seen);
  }
}
