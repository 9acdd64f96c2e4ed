// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/simplify/simplify.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <map>
#include <utility>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/summarize_domain_3.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "domain/shapes.h"
#include "inputs.h"
#include "seeded_random.h"

using namespace pgdr;
using namespace pgdr_test;

namespace {

using Point = Default_kernel::Point_3;

/// How far the points of one surface, sampled, are from the other at most.
double one_sided_distance(const Plc& from, const Plc& to, Random& random) {
  std::vector<Default_kernel::Triangle_3> triangles;
  for (const Facet& f : to.facets)
    triangles.emplace_back(to.vertices[f.polygons[0][0]], to.vertices[f.polygons[0][1]], to.vertices[f.polygons[0][2]]);
  double farthest = 0;
  for (const Facet& f : from.facets)
    for (int k = 0; k < 20; ++k) {
      double u = random.between(0, 1), v = random.between(0, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      if (k < 3) u = k == 1, v = k == 2;  // the corners
      const auto& p = f.polygons[0];
      const Vec_3 a = to_vec(from.vertices[p[0]]), b = to_vec(from.vertices[p[1]]), c = to_vec(from.vertices[p[2]]);
      const Vec_3 q = a + u * (b - a) + v * (c - a);
      double nearest = 1e300;
      for (const auto& t : triangles) nearest = std::min(nearest, CGAL::squared_distance(Point(q.x, q.y, q.z), t));
      farthest = std::max(farthest, std::sqrt(nearest));
    }
  return farthest;
}

/// A closed strip of `n` quadrilaterals around a cylinder with a top and a bottom, like a part on a print bed; the side has a band of the
/// given height at its foot, with vertices of its own.
Plc cylinder_with_band(int n, double band) {
  Plc plc;
  plc.nesting = Nesting::alternate;
  for (const double z : {0.0, band, 1.0})
    for (int i = 0; i < n; ++i) plc.vertices.emplace_back(std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n), z);
  const auto at = [&](int layer, int i) { return static_cast<Index>(layer * n + i % n); };
  const auto add = [&](Index a, Index b, Index c) { plc.facets.push_back({{{a, b, c}}, {}, 0}); };
  for (int i = 0; i < n; ++i)
    for (int layer : {0, 1}) {
      add(at(layer, i), at(layer, i + 1), at(layer + 1, i + 1));
      add(at(layer, i), at(layer + 1, i + 1), at(layer + 1, i));
    }
  for (int i = 1; i + 1 < n; ++i) {
    add(at(0, 0), at(0, i + 1), at(0, i));
    add(at(2, 0), at(2, i), at(2, i + 1));
  }
  return plc;
}

std::size_t triangles_at_other_edges(const Plc& plc) {
  std::map<std::pair<Index, Index>, int> count;
  for (const Facet& f : plc.facets)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index a = f.polygons[0][i], b = f.polygons[0][(i + 1) % 3];
      ++count[{std::min(a, b), std::max(a, b)}];
    }
  return static_cast<std::size_t>(std::ranges::count_if(count, [](const auto& e) { return e.second != 2; }));
}

bool is_valid(const Plc& plc) { return validate_domain_3(make_domain_3(plc)).empty(); }

}  // namespace

TEST_CASE("what has nothing smaller than the tolerance stays as it is") {
  const Plc cube = triangulated(tilted(box()));
  Simplification done;
  const Plc same = simplify(cube, 1e-3, &done);
  CHECK(done.is_none());
  CHECK(same.vertices == cube.vertices);
  CHECK(same.facets.size() == cube.facets.size());
  CHECK(simplify(cylinder_with_band(16, 1e-7), 0, &done).facets.size() == cylinder_with_band(16, 1e-7).facets.size());
  CHECK(done.is_none());
}

TEST_CASE("a band below the tolerance is closed all around") {
  const Plc part = cylinder_with_band(24, 1e-7);
  Simplification done;
  const Plc plc = simplify(part, 1e-6, &done);
  CHECK(done.collapsed_edges == 24);
  CHECK(plc.vertices.size() == 48);
  CHECK(plc.facets.size() == part.facets.size() - 48);
  CHECK(done.largest_change <= 1e-6);
  CHECK(done.largest_change >= 1e-7);
  CHECK(triangles_at_other_edges(plc) == 0);
  CHECK(is_valid(plc));
  Seeded_random random(1);
  CHECK(one_sided_distance(part, plc, random) <= 1.01e-7);
  CHECK(one_sided_distance(plc, part, random) <= 1.01e-7);
}

TEST_CASE("a band above the tolerance stays") {
  Simplification done;
  simplify(cylinder_with_band(24, 1e-3), 1e-4, &done);
  CHECK(done.is_none());
}

TEST_CASE("an edge goes through a vertex that is next to it, and no vertex moves") {
  // The top of a cube has a vertex just beside its diagonal.
  Plc plc = triangulated(box());
  const auto top = [&](Index v) { return plc.vertices[v].z() == 1; };
  std::erase_if(plc.facets, [&](const Facet& f) { return std::ranges::all_of(f.polygons[0], top); });
  plc.vertices.emplace_back(0.5, 0.5 + 1e-8, 1.0);
  for (const std::vector<Index>& t : {std::vector<Index>{4, 7, 8}, {7, 6, 8}, {6, 4, 8}, {4, 5, 7}})
    plc.facets.push_back({{t}, {}, t[0] == 4 && t[1] == 5 ? 5 : 7});
  Simplification done;
  const Plc simpler = simplify(plc, 1e-6, &done);
  CHECK(done.removed_needles == 1);
  CHECK(done.collapsed_edges == 0);
  CHECK(simpler.vertices == plc.vertices);
  CHECK(triangles_at_other_edges(simpler) == 0);
  CHECK(std::ranges::count_if(simpler.facets, [](const Facet& f) { return f.marker == 5; }) == 2);
  CHECK(done.largest_change == 0);  // in its plane
}

TEST_CASE("explicit segments and polygons keep their vertices") {
  Plc plc = cylinder_with_band(12, 1e-7);
  plc.segments.push_back({0, 1, 3});
  plc.segments.push_back({12, 13, 4});  // 1e-7 above
  Simplification done;
  const Plc simpler = simplify(plc, 1e-6, &done);
  REQUIRE(simpler.segments.size() == 2);
  for (std::size_t s = 0; s < 2; ++s) {
    CHECK(simpler.vertices[simpler.segments[s].source] == plc.vertices[plc.segments[s].source]);
    CHECK(simpler.vertices[simpler.segments[s].target] == plc.vertices[plc.segments[s].target]);
  }
}

TEST_CASE("nothing is joined that was apart, and no handle or component goes away") {
  // A tetrahedron smaller than the tolerance beside a cube, and another cube so close that it could be merged.
  Plc plc = [&] {
    Plc all = triangulated(box());
    Plc other = triangulated(box({1 + 1e-7, 0, 0}, {2, 1, 1}));
    for (Facet& f : other.facets)
      for (Index& v : f.polygons[0]) v += static_cast<Index>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), other.vertices.begin(), other.vertices.end());
    all.facets.insert(all.facets.end(), other.facets.begin(), other.facets.end());
    return all;
  }();
  const auto o = static_cast<Index>(plc.vertices.size());
  for (const Point& p : {Point(5, 5, 5), Point(5 + 1e-7, 5, 5), Point(5, 5 + 1e-7, 5), Point(5, 5, 5 + 1e-7)}) plc.vertices.push_back(p);
  for (const std::array<Index, 3>& t : {std::array<Index, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    plc.facets.push_back({{{o + t[0], o + t[1], o + t[2]}}, {}, 0});
  Simplification done;
  const Plc simpler = simplify(plc, 1e-5, &done);
  CHECK(simpler.facets.size() == plc.facets.size());
  CHECK(simpler.vertices == plc.vertices);
}

TEST_CASE("noisy spheres stay closed, without intersections and within the tolerance") {
  // Every triangle of an octahedron's sphere gets a vertex near one of its edges, its corners or its middle.
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Seeded_random random(seed);
    Plc plc;
    plc.nesting = Nesting::alternate;
    for (const Point& p : {Point(1, 0, 0), Point(0, 1, 0), Point(-1, 0, 0), Point(0, -1, 0), Point(0, 0, 1), Point(0, 0, -1)}) plc.vertices.push_back(p);
    std::vector<std::array<Index, 3>> list{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
    constexpr double tolerance = 1e-3;
    for (int round = 0; round < 3; ++round) {
      const auto old = std::exchange(list, {});
      for (const auto& t : old) {
        const double e = 1e-3 * random.between(0, 1), u = random.between(0.2, 0.8);
        const int kind = random.below(3);
        const Vec_3 a = to_vec(plc.vertices[t[0]]), b = to_vec(plc.vertices[t[1]]), c = to_vec(plc.vertices[t[2]]);
        const Vec_3 p = kind == 0 ? a + e * (b - a) + e * (c - a) : kind == 1 ? a + u * (b - a) + e * (c - a) : (1.0 / 3) * (a + b + c);
        plc.vertices.emplace_back(p.x, p.y, p.z);
        const auto v = static_cast<Index>(plc.vertices.size() - 1);
        for (std::size_t i = 0; i < 3; ++i) list.push_back({t[i], t[(i + 1) % 3], v});
      }
    }
    for (const auto& t : list) plc.facets.push_back({{{t[0], t[1], t[2]}}, {}, 0});
    Simplification done;
    const Plc simpler = simplify(plc, tolerance, &done);
    CHECK(done.collapsed_edges + done.removed_needles > 10);
    CHECK(done.largest_change <= tolerance);
    CHECK(triangles_at_other_edges(simpler) == 0);
    CHECK(is_valid(simpler));
    CHECK(one_sided_distance(plc, simpler, random) <= done.largest_change + 1e-9);
    CHECK(one_sided_distance(simpler, plc, random) <= done.largest_change + 1e-9);
  }
}

TEST_CASE("the smallest plane angle of a printed part is not that of the noise in its file") {
  const auto path = inputs_folder().parent_path() / "cad" / "mendel90_ribbon_clamp_20_33N.stl";
  if (!std::filesystem::is_regular_file(path)) PGDR_SKIP("no folder of printed parts");
  const Plc plc = read_plc(path);
  Simplification done;
  const Plc simpler = simplify(plc, 1e-6 * bounding_diagonal(plc), &done);
  CHECK(done.collapsed_edges == 30);
  CHECK(summarize_domain_3(make_domain_3(plc)).smallest_plane_angle_deg < 1e-4);
  CHECK(summarize_domain_3(make_domain_3(simpler)).smallest_plane_angle_deg > 1);
}
