// SPDX-License-Identifier: GPL-3.0-or-later
#include "catch.h"

#include <algorithm>
#include <string>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/summarize_domain_3.h>
#include <pgdr/domain/validate_domain_3.h>

#include "domain/shapes.h"

using namespace pgdr_test;
using pgdr::make_domain_3;
using pgdr::validate_domain_3;
using Kind = pgdr::Input_problem::Kind;
using Point = pgdr::Default_kernel::Point_3;

namespace {

/// Problems of the given triangles within a box around them.
std::vector<pgdr::Input_problem> problems_of(const std::vector<Point>& points,
                                             const std::vector<std::vector<Index>>& polygons,
                                             const std::vector<pgdr::Plc_segment>& segments = {}) {
  Plc plc = box({-9, -9, -9}, {9, 9, 9});
  plc.vertices.insert(plc.vertices.end(), points.begin(), points.end());
  for (std::vector<Index> polygon : polygons) {
    for (Index& v : polygon) v += 8;
    plc.facets.push_back({{polygon}, {}, 0});
  }
  for (pgdr::Plc_segment s : segments) plc.segments.push_back({s.source + 8, s.target + 8, 0});
  return validate_domain_3(make_domain_3(plc));
}

}  // namespace

TEST_CASE("a sound domain has no problems") {
  CHECK(validate_domain_3(make_domain_3(box())).empty());
  CHECK(validate_domain_3(make_domain_3(tilted(triangulated(box())))).empty());
  CHECK(validate_domain_3(make_domain_3(cylinder(50))).empty());
  CHECK(problems_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}).empty());
}

TEST_CASE("facets that pass through each other") {
  Plc plc = box({0, 0, 0}, {2, 2, 2});
  plc.first_index = 1;
  add_box(plc, {1, 0.5, 0.5}, {3, 1.5, 1.5});
  const auto problems = validate_domain_3(make_domain_3(plc));
  REQUIRE(problems.size() == 4);
  CHECK(count(problems, Kind::self_intersection) == 4);
  // In which triangles of the squares, CGAL decides.
  const auto is_between = [](const std::string& s, const std::string& front, const std::string& back) { return s.starts_with(front) && s.ends_with(back); };
  CAPTURE(problems[0].message, problems[3].message);
  CHECK(is_between(problems[0].message, "facets 6 and 7 intersect at (2, ", ", 0.5)"));
  CHECK(problems[0].facets == std::vector<Index>{5, 6});
  CHECK(is_between(problems[3].message, "facets 6 and 10 intersect at (2, 1.5, ", ") (4 pairs in all)"));
  const auto first = validate_domain_3(make_domain_3(plc), 1);
  REQUIRE(first.size() == 1);
  CHECK(first[0].message.find("4 pairs in all") != std::string::npos);
}

TEST_CASE("of many facets that intersect the first hundred pairs have a place") {
  Plc plc = box({-9, -9, -9}, {9, 9, 9});
  const auto add = [&](const std::vector<Point>& triangle) {
    const auto n = static_cast<Index>(plc.vertices.size());
    plc.vertices.insert(plc.vertices.end(), triangle.begin(), triangle.end());
    plc.facets.push_back({{{n, n + 1, n + 2}}, {}, 0});
  };
  add({{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}});
  for (int i = 0; i < 110; ++i) {
    const double x = i / 20.0;
    add({{x, -2, -1}, {x, -1, 1}, {x, -1, -1}});
  }
  const auto problems = validate_domain_3(make_domain_3(plc), 1000);
  CHECK(problems.size() == 110);
  CHECK(std::ranges::count_if(problems, [](const auto& p) { return p.message.find(" at (") != std::string::npos; }) == 100);
}

TEST_CASE("facets that touch other than in vertices and segments") {
  const std::vector<Point> base{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  const auto touching = [&](const std::vector<Point>& more, const std::vector<Index>& polygon) {
    std::vector<Point> points = base;
    points.insert(points.end(), more.begin(), more.end());
    return problems_of(points, {{0, 1, 2}, polygon}).size();
  };
  CHECK(touching({{0.5, 0.5, 0}, {1, 0, 1}, {0, 1, 1}}, {3, 4, 5}) == 1);  // a vertex on the interior
  CHECK(touching({{1, 0, 0}, {1, 0, 1}, {0, 1, 1}}, {3, 4, 5}) == 1);      // a vertex on an edge
  CHECK(touching({{1, 1, 0}, {1, 0, 1}}, {0, 3, 4}) == 1);    // an edge inside, from a common vertex
  CHECK(touching({{0.5, 0.5, 0}}, {0, 1, 3}) == 1);           // folded over a common edge
  CHECK(touching({{3, 0, 0}, {0, 0, 3}}, {0, 3, 4}) == 1);    // edges that overlap
  CHECK(touching({{0, 0, 2}}, {0, 1, 3}) == 0);               // a proper common edge
  CHECK(touching({{-1, 0, 0}, {0, -1, 0}}, {0, 3, 4}) == 0);  // a proper common vertex
  CHECK(touching({}, {0, 2, 1}) == 1);                        // the same facet twice
}

TEST_CASE("segments of their own are checked too") {
  const std::vector<Point> points{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}};
  const std::vector<std::vector<Index>> triangle{{0, 1, 2}};
  const auto through = problems_of(points, triangle, {{3, 4, 0}});
  REQUIRE(through.size() == 1);
  CHECK(through[0].message == "the segment between vertices 11 and 12 intersects facet 6");
  CHECK(problems_of({points[0], points[1], points[2], {0, 0, 1}}, triangle, {{0, 3, 0}}).empty());
  CHECK(problems_of({points[0], points[1], points[2], {0.5, 0.5, 0}}, triangle, {{0, 3, 0}}).size() == 1);
  CHECK(problems_of({points[0], points[1], points[2], {5, 5, 0}}, triangle, {{0, 3, 0}}).size() == 1);
  CHECK(problems_of({{0, 0, 0}, {2, 0, 0}, {1, -1, 0}, {1, 1, 0}}, {}, {{0, 1, 0}, {2, 3, 0}}).size() == 1);
  CHECK(problems_of({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}}, {}, {{0, 1, 0}, {0, 2, 0}}).size() == 1);
  CHECK(problems_of({{0, 0, 0}, {2, 0, 0}, {-1, 0, 0}}, {}, {{0, 1, 0}, {0, 2, 0}}).empty());
}

TEST_CASE("a vertex of its own may not lie on a facet") {
  const std::vector<Point> points{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  const auto on = problems_of({points[0], points[1], points[2], {0.5, 0.5, 0}}, {{0, 1, 2}});
  REQUIRE(on.size() == 1);
  CHECK(on[0].message == "vertex 11 (0.5, 0.5, 0) lies on facet 6, which does not name it");
  CHECK(problems_of({points[0], points[1], points[2], {0.5, 0.5, 1e-9}}, {{0, 1, 2}}).empty());
}

TEST_CASE("an open surface is named by an edge") {
  Plc plc = box();
  plc.facets.pop_back();  // x = 1
  const auto problems = validate_domain_3(make_domain_3(plc));
  REQUIRE(problems.size() == 4);
  CHECK(problems[0].kind == Kind::open_surface);
  CHECK(problems[0].message ==
        "the facets enclose no volume: the edge from vertex 1 (1, 0, 0) to vertex 3 (1, 1, 0) belongs to one "
        "facet only, facet 0");
  CHECK(problems[3].message.ends_with("(4 such edges in all)"));
  const auto first = validate_domain_3(make_domain_3(plc), 1);
  REQUIRE(first.size() == 1);
  CHECK(first[0].message.ends_with("(4 such edges in all)"));
}

TEST_CASE("nothing to mesh") {
  CHECK(count(validate_domain_3(make_domain_3(Plc())), Kind::empty) == 1);
  Plc plc = box();
  plc.holes.emplace_back(0.5, 0.5, 0.5);
  CHECK(count(validate_domain_3(make_domain_3(plc)), Kind::empty) == 1);
}

TEST_CASE("seeds that lie nowhere") {
  Plc plc = box();
  plc.holes.emplace_back(2, 2, 2);
  plc.regions.push_back({{3, 3, 3}, 1, 0});
  const auto problems = validate_domain_3(make_domain_3(plc));
  REQUIRE(problems.size() == 2);
  CHECK(problems[0].kind == Kind::bad_seed);
  CHECK(problems[0].message == "hole seed 1 at (2, 2, 2) lies in no enclosed volume and is left out");
  CHECK(std::ranges::all_of(problems, &pgdr::Input_problem::is_warning));
}

TEST_CASE("seeds on facets, segments and vertices are errors that name them") {
  for (const auto& [point, place] : {std::pair<pgdr::Default_kernel::Point_3, const char*>{{0.5, 0.25, 0}, "lies on facet "},
                                     {{0, 0.3, 0}, "lies on the segment between vertices "},
                                     {{1, 1, 1}, "lies on vertex "}}) {
    Plc plc = box();
    plc.holes.push_back(point);
    plc.regions.push_back({point, 1, 0});
    const auto problems = validate_domain_3(make_domain_3(plc));
    CAPTURE(place);
    REQUIRE(problems.size() == 2);
    for (const auto& problem : problems) {
      CHECK(problem.kind == Kind::ambiguous_seed);
      CHECK_FALSE(problem.is_warning());
      CHECK(problem.message.find(place) != std::string::npos);
      CHECK(problem.facets.size() == 1);
    }
  }
  // As near as doubles can be, but inside: no rounding, no tolerance.
  Plc plc = box();
  plc.regions.push_back({{0.5, 0.5, 5e-324}, 1, 0});
  CHECK(validate_domain_3(make_domain_3(plc)).empty());
}

TEST_CASE("a facet that is given twice is called identical") {
  Plc plc = box();
  plc.facets.push_back(plc.facets.front());
  const auto problems = validate_domain_3(make_domain_3(plc));
  REQUIRE_FALSE(problems.empty());
  CHECK(problems[0].message.find("are identical") != std::string::npos);
}

TEST_CASE("the summary of a domain") {
  Plc plc = triangulated(box({0, 0, 0}, {3, 3, 3}));
  add_box(plc, {1, 1, 1}, {2, 2, 2});
  plc.nesting = pgdr::Nesting::alternate;
  const auto s = pgdr::summarize_domain_3(make_domain_3(plc));
  CHECK(s.vertices == 16);
  CHECK(s.segments == 24);
  CHECK(s.facets == 12);
  CHECK(s.input_facets == 18);
  CHECK(s.fused_facets == 6);
  CHECK(s.triangles == 24);
  CHECK(s.upper == std::array<double, 3>{3, 3, 3});
  CHECK(s.closed);
  CHECK(s.open_edges == 0);
  CHECK(s.non_manifold_edges == 0);
  CHECK(s.smallest_dihedral_deg == Approx(90));
  CHECK(s.volumes.size() == 3);
  CHECK(s.material_volume == Approx(26));
  CHECK(s.problems.empty());
  CHECK(pgdr::summarize_domain_3(make_domain_3(Plc())).problems.size() == 1);
}
