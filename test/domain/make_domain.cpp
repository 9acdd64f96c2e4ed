// SPDX-License-Identifier: GPL-3.0-or-later
#include "catch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <pgdr/domain/make_domain_3.h>

#include "domain/shapes.h"

using namespace pgdr_test;
using pgdr::make_domain_3;
using Kind = pgdr::Input_problem::Kind;

namespace {

/// What every domain promises.
template <class K>
void check_invariants(const pgdr::Domain_3<K>& d) {
  std::vector<std::vector<Index>> bounded(d.segments.size());
  for (Index f = 0; f < d.facets.size(); ++f) {
    const auto& facet = d.facets[f];
    CHECK(std::is_sorted(facet.segments.begin(), facet.segments.end()));
    CHECK(std::is_sorted(facet.vertices.begin(), facet.vertices.end()));
    CHECK(std::is_sorted(facet.input_facets.begin(), facet.input_facets.end()));
    std::vector<std::array<Index, 2>> edges;
    const pgdr::Vec_3 normal = pgdr::to_vec(facet.normal), origin = pgdr::to_vec(facet.origin);
    CHECK(length(normal) == Approx(1));
    for (const auto& t : facet.triangles) {
      const pgdr::Vec_3 a = pgdr::to_vec(d.vertices[t[0]]), b = pgdr::to_vec(d.vertices[t[1]]),
                        c = pgdr::to_vec(d.vertices[t[2]]);
      CHECK(dot(cross(b - a, c - a), normal) > 0);
      CHECK(std::abs(dot(a - origin, normal)) <= d.tolerance);
      for (std::size_t i = 0; i < 3; ++i)
        edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& e : edges) {
      const auto n = std::count(edges.begin(), edges.end(), e);
      const bool segment = std::any_of(facet.segments.begin(), facet.segments.end(),
                                       [&](Index s) { return d.segments[s].vertices == e; });
      CHECK(n <= 2);
      CHECK((n == 2 || segment));
    }
    for (Index s : facet.segments) bounded[s].push_back(f);
  }
  for (std::size_t s = 0; s < d.segments.size(); ++s) {
    CHECK(d.segments[s].vertices[0] < d.segments[s].vertices[1]);
    CHECK(d.segments[s].facets == bounded[s]);
  }
}

std::vector<pgdr::Input_problem> problems_of(const Plc& plc, bool triangulate = false) {
  try {
    make_domain_3(plc, 1e-6, triangulate);
  } catch (const pgdr::Input_error& e) {
    return e.problems();
  }
  return {};
}

}  // namespace

TEST_CASE("a triangulated cube has 6 facets and 12 segments") {
  for (const Plc& plc : {box(), triangulated(box()), tilted(triangulated(box())), tilted(box())}) {
    const auto d = make_domain_3(plc);
    check_invariants(d);
    CHECK(d.vertices.size() == 8);
    CHECK(d.facets.size() == 6);
    CHECK(d.segments.size() == 12);
    for (std::size_t f = 0; f < 6; ++f) CHECK(facet_area(d, f) == Approx(1));
  }
}

TEST_CASE("facets on coordinate planes have exact normals") {
  for (const auto& f : make_domain_3(triangulated(box({0.1, 0.2, 0.3}, {0.7, 1.1, 1.3}))).facets)
    CHECK(std::abs(f.normal[0]) + std::abs(f.normal[1]) + std::abs(f.normal[2]) == 1.0);
}

TEST_CASE("facets oriented at random fuse all the same") {
  Plc plc = tilted(triangulated(box()));
  for (std::size_t f = 0; f < plc.facets.size(); f += 3)
    std::reverse(plc.facets[f].polygons[0].begin(), plc.facets[f].polygons[0].end());
  const auto d = make_domain_3(plc);
  check_invariants(d);
  CHECK(d.facets.size() == 6);
  CHECK(d.segments.size() == 12);
}

TEST_CASE("a triangle soup is put together again") {
  const Plc whole = triangulated(box());
  Plc soup;
  for (const Facet& f : whole.facets) {
    const Index o = static_cast<Index>(soup.vertices.size());
    for (Index v : f.polygons[0]) soup.vertices.push_back(whole.vertices[v]);
    soup.facets.push_back({{{o, o + 1, o + 2}}, {}, 0});
  }
  soup.vertices[0] = {-0.0, -0.0, 0.0};
  const auto d = make_domain_3(soup);
  CHECK(d.vertices.size() == 8);
  CHECK(d.duplicate_vertices == 28);
  CHECK(d.input_vertex[0] == 0);
  CHECK(d.facets.size() == 6);
}

TEST_CASE("a fine cylinder is not fused around") {
  // 4000 sides turn by 0.09 degrees each: neighbours leave a side's plane by 2.5e-6, which adds up.
  const auto fine = make_domain_3(cylinder(4000), 5e-7);
  const auto d = make_domain_3(cylinder(4000), 1e-5);
  CHECK(fine.facets.size() == 4002);
  CHECK(d.facets.size() > 400);
  CHECK(d.facets.size() < 2000);
  for (const auto& f : d.facets)
    for (Index v : f.vertices)
      CHECK(std::abs(dot(pgdr::to_vec(f.normal), pgdr::to_vec(d.vertices[v]) - pgdr::to_vec(f.origin))) <=
            d.tolerance);
}

TEST_CASE("different markers stay apart") {
  Plc plc = triangulated(box());
  plc.facets[0].marker = 7;
  const auto d = make_domain_3(plc);
  check_invariants(d);
  CHECK(d.facets.size() == 7);
  CHECK(d.segments.size() == 13);
  CHECK(d.facets[0].marker == 7);
}

TEST_CASE("nothing is fused across an explicit segment") {
  Plc plc = triangulated(box());
  plc.segments.push_back({3, 0, 5});  // the diagonal of the bottom
  const auto d = make_domain_3(plc);
  check_invariants(d);
  CHECK(d.facets.size() == 7);
  REQUIRE(d.segments.size() == 13);
  std::size_t marked = 0;
  for (const auto& s : d.segments) marked += s.marker == 5 && s.vertices == std::array<Index, 2>{0, 3};
  CHECK(marked == 1);
}

TEST_CASE("an explicit segment inside a polygon is inside the facet") {
  Plc plc = box();
  plc.segments.push_back({0, 3, 5});
  Plc polygon = box();
  polygon.facets[0].polygons.push_back({0, 3});
  Plc elsewhere = box();
  elsewhere.facets.push_back({{{0, 3}}, {}, 0});
  for (const Plc& p : {plc, polygon, elsewhere}) {
    const auto d = make_domain_3(p);
    check_invariants(d);
    CHECK(d.facets.size() == 6);
    CHECK(d.segments.size() == 13);
    CHECK(d.facets[0].segments.size() == 5);
    CHECK(d.facets[0].triangles.size() == 2);
  }
}

TEST_CASE("a segment through a vertex of its facet becomes two") {
  Plc plc;
  plc.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}};
  plc.facets = {{{{0, 1, 2, 3}, {4}}, {}, 0}};
  plc.segments.push_back({0, 2, 9});
  const auto d = make_domain_3(tilted(plc));
  check_invariants(d);
  CHECK(d.segments.size() == 6);
  CHECK(std::count_if(d.segments.begin(), d.segments.end(), [](const auto& s) { return s.marker == 9; }) ==
        2);
}

TEST_CASE("segments and vertices of their own are kept") {
  Plc plc = box();
  plc.vertices.emplace_back(0.5, 0.5, 0.5);
  plc.vertices.emplace_back(0.5, 0.5, 0.7);
  plc.vertices.emplace_back(0.3, 0.3, 0.3);
  plc.segments.push_back({9, 8, 3});
  Plc facet = plc;
  facet.segments.clear();
  facet.facets.push_back({{{8, 9}}, {}, 3});  // a facet that is only a segment
  for (const Plc& p : {plc, facet}) {
    const auto d = make_domain_3(p);
    CHECK(d.vertices.size() == 11);
    CHECK(d.segments.size() == 13);
    CHECK(d.segments.back().facets.empty());
    CHECK(d.segments.back().marker == 3);
    CHECK(d.facets.size() == 6);
  }
}

TEST_CASE("a facet with a hole leaves the hole out") {
  Plc plc;
  plc.facets.push_back(frame(plc));
  for (const Plc& p : {plc, tilted(plc)}) {
    const auto d = make_domain_3(p);
    check_invariants(d);
    CHECK(d.facets.size() == 1);
    CHECK(d.segments.size() == 8);
    CHECK(facet_area(d, 0) == Approx(8));
  }
  // Without a seed the inner polygon is four internal segments.
  plc.facets[0].holes.clear();
  const auto d = make_domain_3(tilted(plc));
  check_invariants(d);
  CHECK(facet_area(d, 0) == Approx(9));
  CHECK(d.facets[0].segments.size() == 8);
}

TEST_CASE("triangles around a hole fuse into a facet with a hole") {
  Plc plc;
  frame(plc);
  for (Index i = 0; i < 4; ++i) {
    const Index j = (i + 1) % 4;
    plc.facets.push_back({{{i, j, 4 + j}}, {}, 0});
    plc.facets.push_back({{{4 + j, i, 4 + i}}, {}, 0});
  }
  const auto d = make_domain_3(tilted(plc));
  check_invariants(d);
  REQUIRE(d.facets.size() == 1);
  CHECK(d.segments.size() == 8);
  CHECK(facet_area(d, 0) == Approx(8));
}

TEST_CASE("an interior vertex of a fused facet stays") {
  Plc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.4, 0.3, 0}};
  for (Index i = 0; i < 4; ++i) plc.facets.push_back({{{i, (i + 1) % 4, 4}}, {}, 0});
  const auto d = make_domain_3(tilted(plc));
  check_invariants(d);
  REQUIRE(d.facets.size() == 1);
  CHECK(d.facets[0].vertices.size() == 5);
  CHECK(d.segments.size() == 4);
  CHECK(d.facets[0].triangles.size() == 4);
}

TEST_CASE("a third facet on an edge keeps it") {
  Plc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0, 1}, {1, 1, 1}};
  plc.facets = {{{{0, 1, 2, 3}}, {}, 0}, {{{1, 4, 5, 2}}, {}, 0}};
  CHECK(make_domain_3(plc).facets.size() == 1);
  plc.facets.push_back({{{1, 2, 7, 6}}, {}, 0});
  const auto d = make_domain_3(plc);
  check_invariants(d);
  CHECK(d.facets.size() == 3);
  CHECK(std::count_if(d.segments.begin(), d.segments.end(),
                      [](const auto& s) { return s.facets.size() == 3; }) == 1);
}

TEST_CASE("a facet folded back over its neighbour is not fused") {
  Plc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.4, 0.5, 0}};
  plc.facets = {{{{0, 1, 2}}, {}, 0}, {{{1, 0, 3}}, {}, 0}};
  CHECK(make_domain_3(plc).facets.size() == 2);
}

TEST_CASE("a spiral ramp that overlaps itself in projection is left alone") {
  Plc plc;
  const Index n = 14;  // one turn and a half, all within the tolerance of one plane
  for (Index i = 0; i <= n; ++i) {
    const double angle = 0.7 * i, z = 1e-7 * i;
    plc.vertices.emplace_back(std::cos(angle), std::sin(angle), z);
    plc.vertices.emplace_back(2 * std::cos(angle), 2 * std::sin(angle), z);
  }
  for (Index i = 0; i < n; ++i) {
    plc.facets.push_back({{{2 * i, 2 * i + 1, 2 * i + 3}}, {}, 0});
    plc.facets.push_back({{{2 * i, 2 * i + 3, 2 * i + 2}}, {}, 0});
  }
  const auto d = make_domain_3(plc, 1e-5);
  check_invariants(d);
  CHECK(d.facets.size() == 2 * n);
}

TEST_CASE("all problems of an input are told in one pass") {
  Plc plc = box();
  plc.first_index = 1;
  plc.vertices.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  plc.vertices.emplace_back(0, 0, std::numeric_limits<double>::infinity());
  plc.facets.push_back({{{0, 1, 99}}, {}, 0});    // facet 7
  plc.facets.push_back({{{0, 1, 0}}, {}, 0});     // facet 8
  plc.facets.push_back({{{0, 1, 3, 6}}, {}, 0});  // facet 9
  const auto problems = problems_of(plc);
  CHECK(count(problems, Kind::bad_coordinate) == 2);
  CHECK(count(problems, Kind::bad_index) == 1);
  CHECK(count(problems, Kind::degenerate_facet) == 1);
  CHECK(count(problems, Kind::non_planar_facet) == 1);
  REQUIRE(problems.size() == 5);
  CHECK(problems[2].message == "facet 7 names vertex 100, which does not exist");
  CHECK(problems[2].facets == std::vector<Index>{6});
  CHECK(problems[3].message.find("facet 8 ") == 0);
  CHECK(problems[4].message.find("facet 9 is not planar") == 0);
}

TEST_CASE("facets without area are errors, needles are not") {
  Plc plc;
  plc.vertices = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {3, 3, 3.0000000000000004}, {2, 2, 2}};
  plc.facets = {{{{0, 1, 2}}, {}, 0}};
  CHECK(count(problems_of(plc), Kind::degenerate_facet) == 1);
  plc.facets = {{{{0, 1, 2, 4}}, {}, 0}};
  CHECK(count(problems_of(plc), Kind::degenerate_facet) == 1);
  plc.facets = {{{{0, 1, 3}}, {}, 0}};
  CHECK(problems_of(plc).empty());
  CHECK(make_domain_3(plc).facets.size() == 1);
}

TEST_CASE("a polygon that crosses itself is an error") {
  Plc plc;
  plc.vertices = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 2, 0}};
  plc.facets = {{{{0, 1, 2, 3}}, {}, 0}};
  const auto problems = problems_of(plc);
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].kind == Kind::self_intersection);
}

TEST_CASE("a polygon that is not planar is accepted as triangles") {
  Plc plc = box();
  plc.vertices[7] = {1, 1, 1.25};
  const auto problems = problems_of(plc);
  CHECK(count(problems, Kind::non_planar_facet) == 1);  // the two others stay planar
  const auto d = make_domain_3(plc, 1e-6, true);
  check_invariants(d);
  CHECK(d.facets.size() == 7);
  CHECK(d.segments.size() == 13);
}

TEST_CASE("the tolerance never falls below rounding") {
  Plc plc = box({1e9, 1e9, 1e9}, {1e9 + 1, 1e9 + 1, 1e9 + 1});
  CHECK(make_domain_3(plc, 0).tolerance == 16 * std::ldexp(1.0, -23));
}

TEST_CASE("domains of another kernel") {
  using K = CGAL::Exact_predicates_exact_constructions_kernel;
  pgdr::Piecewise_linear_complex_3<K> plc;
  for (const auto& p : triangulated(box()).vertices) plc.vertices.emplace_back(p.x(), p.y(), p.z());
  for (const auto& f : triangulated(box()).facets) plc.facets.push_back({f.polygons, {}, 0});
  const auto d = make_domain_3(plc);
  check_invariants(d);
  CHECK(d.facets.size() == 6);
}
