// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/simplify/planarize.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/parallel/thread_arena.h>

#include "catch.h"
#include "domain/shapes.h"
#include "seeded_random.h"
#include "thread_counts.h"

using namespace pgdr;
using namespace pgdr_test;

namespace {

constexpr double tolerance = 1e-6;  // of the diagonal
constexpr double rounding = 1e-13;

/// As a file of single precision has it.
Plc in_single_precision(Plc plc) {
  for (auto& p : plc.vertices) p = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
  return plc;
}

std::size_t facets_within(const Plc& plc, double distance) { return make_domain_3(plc, distance).facets.size(); }

double farthest_move(const Plc& a, const Plc& b) {
  double farthest = 0;
  for (std::size_t v = 0; v < a.vertices.size(); ++v)
    farthest = std::max(farthest, length(to_vec(a.vertices[v]) - to_vec(b.vertices[v])));
  return farthest;
}

bool meets_nowhere(const Plc& plc) { return validate_domain_3(make_domain_3(plc)).empty(); }

}  // namespace

TEST_CASE("plane facets stay as they are") {
  for (const Plc& plc : {triangulated(box()), triangulated(tilted(box())), triangulated(tilted(cylinder(20)))}) {
    Planarization done;
    const Plc same = planarize(plc, tolerance, false, &done);
    CHECK(done.is_none());
    CHECK(same.vertices == plc.vertices);
  }
}

TEST_CASE("facets of a file in single precision become plane, by moves of that size") {
  const Plc rounded = in_single_precision(triangulated(tilted(cylinder(20))));
  REQUIRE(facets_within(rounded, tolerance) == 22);
  REQUIRE(facets_within(rounded, rounding) > 22);
  Planarization done;
  const Plc plc = planarize(rounded, tolerance, false, &done);
  CHECK(facets_within(plc, rounding) == 22);
  CHECK(meets_nowhere(plc));
  CHECK(done.flattened_facets > 0);
  CHECK(done.flattened_facets <= 22);
  CHECK(done.bent_facets == 0);
  CHECK(done.moved_vertices > 20);
  CHECK(done.largest_change > 1e-9);
  CHECK(done.largest_change <= farthest_move(rounded, plc));
  CHECK(farthest_move(rounded, plc) < 3e-7);  // a few ulps of numbers up to 2
}

TEST_CASE("bodies apart become plane at once, alike for any number of threads") {
  Plc bodies;
  for (int i = 0; i < 12; ++i) {
    Plc body = triangulated(tilted(cylinder(static_cast<Index>(8 + i))));
    const Index first = static_cast<Index>(bodies.vertices.size());
    for (const auto& p : body.vertices) bodies.vertices.emplace_back(p.x() + 5.1 * i, p.y() - 3.3 * i, p.z());
    for (auto& facet : body.facets) {
      for (auto& polygon : facet.polygons)
        for (Index& v : polygon) v += first;
      bodies.facets.push_back(facet);
    }
  }
  const Plc rounded = in_single_precision(bodies);
  const std::size_t facets = facets_within(rounded, tolerance);
  REQUIRE(facets_within(rounded, rounding) > facets);
  const Plc plane = with_threads(1, [&] { return planarize(rounded, tolerance); });
  CHECK(facets_within(plane, rounding) == facets);
  for (const unsigned threads : thread_counts()) CHECK(with_threads(threads, [&] { return planarize(rounded, tolerance); }).vertices == plane.vertices);
}

TEST_CASE("what is in an axis-aligned plane stays there") {
  Plc slanted = cylinder(20);
  for (auto& p : slanted.vertices)
    if (p.z() == 1) p = {0.7 * p.x() + 0.1, 0.7 * p.y(), 1};
  const Plc rounded = in_single_precision(triangulated(slanted));
  Planarization done;
  const Plc plc = planarize(rounded, tolerance, false, &done);
  REQUIRE(!done.is_none());
  CHECK(facets_within(plc, rounding) == 22);
  std::set<double> heights;
  for (const auto& p : plc.vertices) heights.insert(p.z());
  CHECK(heights == std::set<double>{0, 1});
}

TEST_CASE("vertices move as far as the tolerance and no farther") {
  // A cube with two pyramids, 4e-7 and 1e-9 of an edge high, on two of its faces: each apex can move into its face alone.
  Plc plc = triangulated(box());
  const auto raise = [&](double height, bool is_top) {
    const double z = is_top ? 1 : 0;
    std::erase_if(plc.facets, [&](const Facet& f) {
      return std::ranges::all_of(f.polygons[0], [&](Index v) { return plc.vertices[v].z() == z; });
    });
    const Index apex = static_cast<Index>(plc.vertices.size());
    plc.vertices.emplace_back(0.5, 0.5, z + (is_top ? height : -height));
    const Index base = is_top ? 4 : 0;
    for (const auto& [a, b] : {std::pair<Index, Index>{0, 1}, {1, 3}, {3, 2}, {2, 0}}) plc.facets.push_back({{{base + a, base + b, apex}}, {}, 0});
  };
  raise(4e-7, true);
  raise(1e-9, false);
  REQUIRE(facets_within(plc, tolerance) == 6);
  Planarization done;
  const Plc flat = planarize(plc, tolerance, false, &done);
  CHECK(facets_within(flat, rounding) == 6);
  CHECK(done.largest_change <= tolerance * std::sqrt(3.0));
  CHECK(done.bent_facets == 0);
  CHECK(meets_nowhere(flat));

  // With less tolerance than the pyramid is high, it is a pyramid.
  const Plc still = planarize(plc, 1e-7, false, &done);
  CHECK(facets_within(still, 1e-7) == 9);
  CHECK(still.vertices[8] == plc.vertices[8]);
  CHECK(still.vertices[9].z() == Approx(0).margin(rounding));
}

TEST_CASE("a needle that stood upright does not fall onto the edge it stands on") {
  // A vertex at the edge of a cube's top, 12 billionths inside: in the plane it would be nearly on the edge.
  for (const double height : {5e-9, 1.8e-8}) {  // the needle is part of the top, or of the side
    Plc plc = triangulated(box());
    std::erase_if(plc.facets, [&](const Facet& f) {
      return std::ranges::all_of(f.polygons[0], [&](Index v) { return plc.vertices[v].z() == 1; });
    });
    plc.vertices.emplace_back(0.5, 1.2e-8, 1 + height);
    for (const std::vector<Index>& t : {std::vector<Index>{4, 5, 8}, {5, 7, 8}, {7, 6, 8}, {6, 4, 8}}) plc.facets.push_back({{t}, {}, 0});
    REQUIRE(meets_nowhere(plc));
    REQUIRE(facets_within(plc, tolerance) == 6);
    const Plc flat = planarize(plc, tolerance);
    CHECK(meets_nowhere(flat));
    CHECK(flat.vertices.size() == 8);
    CHECK(facets_within(flat, rounding) == 6);
  }
}

TEST_CASE("what stays bent stays triangles") {
  // A box with a dome for a top; each of its triangles has a vertex next to an edge.
  constexpr Index n = 8;
  constexpr double wide = 1e-3, radius = 60;
  Seeded_random random(1);
  Plc plc;
  const auto at = [](Index i, Index j) { return i * (n + 1) + j; };
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) {
      const double x = i - n / 2.0, y = j - n / 2.0;
      plc.vertices.emplace_back(x, y, -(x * x + y * y) / (2 * radius));
    }
  std::vector<std::vector<Index>> sides(4);
  const auto top = static_cast<Index>(plc.vertices.size());
  for (const Index i : {Index{0}, n})
    for (const Index j : {Index{0}, n}) plc.vertices.emplace_back(i - n / 2.0, j - n / 2.0, -5);
  for (Index i = 0; i <= n; ++i) {
    sides[0].push_back(at(i, 0));
    sides[1].push_back(at(i, n));
    sides[2].push_back(at(0, i));
    sides[3].push_back(at(n, i));
  }
  const std::vector<std::vector<Index>> feet{{2, 0}, {3, 1}, {1, 0}, {3, 2}};
  for (std::size_t k = 0; k < 4; ++k) {
    for (const Index v : feet[k]) sides[k].push_back(top + v);
    plc.facets.push_back({{sides[k]}, {}, 0});
  }
  plc.facets.push_back({{{top, top + 1, top + 3, top + 2}}, {}, 0});
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      for (const std::vector<Index>& t : {std::vector<Index>{at(i, j), at(i + 1, j), at(i + 1, j + 1)}, {at(i, j), at(i + 1, j + 1), at(i, j + 1)}}) {
        const Vec_3 a = to_vec(plc.vertices[t[0]]), b = to_vec(plc.vertices[t[1]]), c = to_vec(plc.vertices[t[2]]);
        const Vec_3 p = a + random.between(0.3, 0.7) * (b - a) + 1e-5 * (c - a);
        const auto v = static_cast<Index>(plc.vertices.size());
        plc.vertices.emplace_back(p.x, p.y, p.z);
        for (std::size_t k = 0; k < 3; ++k) plc.facets.push_back({{{t[k], t[(k + 1) % 3], v}}, {}, 0});
      }
  REQUIRE(meets_nowhere(plc));
  Planarization done;
  const Plc flat = planarize(plc, wide, false, &done);
  CHECK(done.bent_facets > 0);
  CHECK(done.flattened_facets > 0);
  CHECK(std::ranges::count_if(flat.facets, [](const Facet& f) { return f.polygons[0].size() != 3; }) == 5);  // sides and bottom
  CHECK(meets_nowhere(flat));
  for (const double within : {wide, tolerance}) CHECK(meets_nowhere(planarize(flat, within)));
}

TEST_CASE("what was made plane together is what is fused") {
  // A bar whose top is bent so little that several strips fit within the tolerance, and others once the first ones are plane.
  constexpr Index strips = 60;
  constexpr double radius = 1e5, half = strips / 2.0;
  Plc plc;
  const auto add = [&](double x, double z) {
    for (const double y : {0.0, 30.0}) plc.vertices.emplace_back(0.8 * x - 0.6 * z, y, 0.6 * x + 0.8 * z);
  };
  for (Index i = 0; i <= strips; ++i) add(i - half, radius - std::sqrt(radius * radius - (i - half) * (i - half)));
  add(half, -10);
  add(-half, -10);
  const Index columns = strips + 3;
  std::vector<Index> front, back;
  for (Index i = 0; i < columns; ++i) {
    const Index a = 2 * i, b = 2 * ((i + 1) % columns);
    for (const std::vector<Index>& t : {std::vector<Index>{a, b, a + 1}, {a + 1, b, b + 1}}) plc.facets.push_back({{t}, {}, 0});
    front.push_back(a);
    back.push_back(a + 1);
  }
  plc.facets.push_back({{front}, {}, 0});
  plc.facets.push_back({{back}, {}, 0});
  plc = in_single_precision(std::move(plc));
  Planarization done;
  const Plc flat = planarize(plc, tolerance, false, &done);
  CHECK(done.bent_facets == 0);
  const std::size_t facets = facets_within(flat, tolerance);
  CHECK(facets < strips / 2);
  CHECK(facets_within(flat, rounding) == facets);
  CHECK(meets_nowhere(flat));

  // Otherwise, others would be fused.
  Plc free = flat;
  for (auto& f : free.facets) f.group = 0;
  CHECK(facets_within(free, tolerance) < facets);
}

TEST_CASE("more facets that hang together than are decomposed at once become plane, too") {
  constexpr Index around = 130, across = 90;
  constexpr double turn = 2 * 3.14159265358979323846, wide = 2e-5;
  Seeded_random random(7);
  Plc torus;
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      const double u = turn * i / around, v = turn * j / across, r = 1 + random.between(-2e-5, 2e-5);
      torus.vertices.emplace_back((3 + r * std::cos(v)) * std::cos(u), (3 + r * std::cos(v)) * std::sin(u), r * std::sin(v));
    }
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      const Index next_i = (i + 1) % around, next_j = (j + 1) % across;
      const Index a = i * across + j, b = next_i * across + j, c = next_i * across + next_j, d = i * across + next_j;
      for (const std::vector<Index>& triangle : {std::vector{a, b, c}, {a, c, d}}) torus.facets.push_back({{triangle}, {}, 0, 0});
    }
  const std::size_t facets = facets_within(torus, wide);
  REQUIRE(facets > 10'000);
  REQUIRE(facets_within(torus, rounding) == torus.facets.size());
  Planarization done;
  const Plc plane = planarize(torus, wide, false, &done);
  CHECK(done.bent_facets < facets / 100);
  CHECK(facets_within(plane, rounding) < facets + facets / 10);
  CHECK(farthest_move(torus, plane) < 16 * wide * make_domain_3(torus).diagonal);
  CHECK(meets_nowhere(plane));
  CHECK(with_threads(2, [&] { return planarize(torus, wide); }).vertices == plane.vertices);
}
