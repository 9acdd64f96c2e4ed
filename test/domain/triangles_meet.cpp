// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/detail/intersecting_triangles.h>

#include <algorithm>
#include <array>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Object.h>
#include <CGAL/intersections.h>

#include "catch.h"
#include "seeded_random.h"

using namespace pgdr;
using namespace pgdr_test;

namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Triple = std::array<Index, 3>;

/// By what they have in common, constructed exactly.
bool meet_exactly(const Triple& s, const Triple& t, const std::vector<Vec_3>& points) {
  const auto point = [&](Index v) { return Exact::Point_3(points[v].x, points[v].y, points[v].z); };
  const auto triangle = [&](const Triple& c) { return Exact::Triangle_3(point(c[0]), point(c[1]), point(c[2])); };
  std::vector<Index> common;
  for (const Index v : s)
    if (std::ranges::find(t, v) != t.end()) common.push_back(v);
  if (common.size() == 3) return true;
  if (triangle(s).is_degenerate() || triangle(t).is_degenerate()) return false;
  const CGAL::Object all = CGAL::intersection(triangle(s), triangle(t));
  if (all.empty()) return false;
  if (common.empty()) return true;
  if (const auto* p = CGAL::object_cast<Exact::Point_3>(&all)) return std::ranges::none_of(common, [&](Index v) { return point(v) == *p; });
  // Two triangles with an edge in common have no more of a segment than that.
  return common.size() == 1 || !CGAL::object_cast<Exact::Segment_3>(&all);
}

}  // namespace

TEST_CASE("Triangles meet where what they have in common is more than corners and edges", "[domain]") {
  Seeded_random random(7);
  std::array<int, 2> seen{};
  // On a small lattice many are in one plane, touch, or have no area.
  for (int round = 0; round < 20000; ++round) {
    std::vector<Vec_3> points;
    const int depth = round % 3 == 0 ? 1 : 4;
    for (int i = 0; i < 6; ++i)
      points.push_back({double(random.below(4)), double(random.below(4)), double(random.below(depth))});
    const int common = round / 3 % 3;
    Triple s{0, 1, 2}, t{3, 4, 5};
    for (int i = 0; i < common; ++i) t[i] = s[i];
    std::swap(s[random.below(3)], s[0]);
    std::swap(t[random.below(3)], t[1]);
    // Other vertices at one place are not what a complex has.
    bool is_twice = false;
    for (const Index v : s)
      for (const Index w : t) is_twice |= v != w && squared_distance(points[v], points[w]) == 0;
    // Of two common corners only the edge matters; what has no area is what its neighbors have.
    if (is_twice || squared_length(cross(points[s[1]] - points[s[0]], points[s[2]] - points[s[0]])) == 0 ||
        squared_length(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]])) == 0)
      continue;
    const bool meet = domain_detail::triangles_meet(s, t, points);
    ++seen[meet];
    INFO(round);
    CHECK(meet == meet_exactly(s, t, points));
    CHECK(meet == domain_detail::triangles_meet(t, s, points));
  }
  CHECK(seen[0] > 2000);
  CHECK(seen[1] > 2000);
}
