// SPDX-License-Identifier: GPL-3.0-or-later
// The zone theorem (zone_condition.h, docs/theory.md) on random triangulations of the unit cube: once the condition
// of a leaf holds, points are inserted anywhere, and for points of the leaf cavity and star are measured each time.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <optional>
#include <vector>

#include <pgdr/independence/buffer_condition.h>
#include <pgdr/octree/linear_octree_3.h>

#include "catch.h"
#include "independence/zone_reach.h"
#include "octree/random_octree.h"
#include "seeded_random.h"

using namespace pgdr_test;
using pgdr::Linear_octree_3;
using pgdr::Requirement;

namespace {

/// So flat that a computed circumcenter means nothing.
bool is_flat(const std::array<Point, 4>& p) {
  const double l = std::sqrt(std::max({CGAL::squared_distance(p[0], p[1]), CGAL::squared_distance(p[0], p[2]),
                                       CGAL::squared_distance(p[0], p[3])}));
  return std::abs(CGAL::volume(p[0], p[1], p[2], p[3])) < 1e-9 * l * l * l;
}

struct Ball {
  Point center;
  double squared_radius = std::numeric_limits<double>::infinity();
};

/// The smallest ball around four points: the smallest among the balls of two, three and four of them that hold all,
/// with a tolerance that can only make it too large by about 1e-8.
Ball enclosing_ball(const std::array<Point, 4>& p) {
  Ball best;
  const auto offer = [&](const Point& center, double squared) {
    for (const Point& q : p) {
      if (CGAL::squared_distance(center, q) > squared * (1 + 1e-8)) return;
    }
    if (squared * (1 + 1e-8) < best.squared_radius) best = {center, squared * (1 + 1e-8)};
  };
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      offer(CGAL::midpoint(p[i], p[j]), CGAL::squared_distance(p[i], p[j]) / 4);
      for (std::size_t k = j + 1; k < 4; ++k) {
        if (CGAL::collinear(p[i], p[j], p[k])) continue;
        const Point c = CGAL::circumcenter(p[i], p[j], p[k]);
        offer(c, CGAL::squared_distance(c, p[i]));
      }
    }
  }
  if (is_flat(p)) return best;
  const Point c = CGAL::circumcenter(p[0], p[1], p[2], p[3]);
  offer(c, CGAL::squared_distance(c, p[0]));
  return best;
}

std::array<Point, 4> corners(Delaunay::Cell_handle c) {
  return {c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(), c->vertex(3)->point()};
}

/// Meets the box by its bounding box, and does not lie in the hole.
bool concerns(const Requirement& r, const std::array<Point, 4>& p) {
  bool meets = true, inside = true;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    double lower = p[0][axis], upper = p[0][axis];
    for (const Point& q : p) {
      lower = std::min(lower, q[axis]);
      upper = std::max(upper, q[axis]);
    }
    meets = meets && lower <= r.upper[a] && r.lower[a] <= upper;
    inside = inside && r.hole_lower[a] <= lower && upper <= r.hole_upper[a];
  }
  return meets && !inside;
}

/// What the triangulation is made of before it is refined, and what is inserted later.
enum class Kind { uniform, graded, slivers, flat_hull };
constexpr std::array<Kind, 4> kinds{Kind::uniform, Kind::graded, Kind::slivers, Kind::flat_hull};
const char* name(Kind k) {
  constexpr const char* names[] = {"uniform", "graded", "slivers", "flat cells at the hull"};
  return names[static_cast<int>(k)];
}

/// In the box cut off at the cube, now and then snapped to its faces, edges and corners; for `flat_hull`, often a
/// little off.
Point point_in(Kind kind, Random& random, const Coordinates& lower, const Coordinates& upper) {
  Coordinates c{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double lo = std::max(0.0, lower[a]), hi = std::min(1.0, upper[a]);
    c[a] = random.between(lo, hi);
    const std::uint32_t snap = random.below(kind == Kind::flat_hull ? 6 : 12);
    const double off =
        kind == Kind::flat_hull && random.below(2) ? std::pow(10, -random.between(3, 16)) * (hi - lo) : 0;
    if (snap == 0) c[a] = lo + off;
    if (snap == 1) c[a] = hi - off;
  }
  return {c[0], c[1], c[2]};
}

/// Six layers of a grid that is about as fine as the condition asks, each point moved a little: among eight
/// neighbours, which are nearly cospherical, slivers.
void insert_lattice(Delaunay& mesh, const Requirement& r, Random& random) {
  const double h = random.between(0.8, 1.1) * r.bound, move = std::pow(10, -random.between(2, 12)) * h;
  Coordinates start{};
  for (std::size_t a = 0; a < 3; ++a) start[a] = random.between(r.lower[a], r.upper[a] - 3 * h);
  for (int k = 0; k < 216; ++k) {
    const std::array<int, 3> at{k % 6, k / 6 % 6, k / 36};
    Coordinates c{};
    for (std::size_t a = 0; a < 3; ++a)
      c[a] = std::clamp(start[a] + at[a] * h + random.between(-move, move), 0.0, 1.0);
    mesh.insert(Point(c[0], c[1], c[2]));
  }
}

/// The cube, with what makes the kind.
Delaunay beginning(Kind kind, const Requirement& r, Random& random) {
  Delaunay mesh;
  for (int c = 0; c < 8; ++c) mesh.insert(Point(c & 1, c >> 1 & 1, c >> 2 & 1));
  if (kind == Kind::slivers)
    for (int patch = 0; patch < 3; ++patch) insert_lattice(mesh, r, random);
  if (kind == Kind::flat_hull)
    for (int k = 0; k < 100; ++k) mesh.insert(point_in(kind, random, {0, 0, 0}, {1, 1, 1}));
  if (kind == Kind::graded) {
    const Point focus = point_in(Kind::uniform, random, r.lower, r.upper);
    for (int k = 0; k < 100; ++k) {
      const double size = std::pow(2, -random.between(0, 9));
      Coordinates c{};
      for (std::size_t a = 0; a < 3; ++a)
        c[a] = std::clamp(focus[static_cast<int>(a)] + size * random.between(-1, 1), 0.0, 1.0);
      mesh.insert(Point(c[0], c[1], c[2]));
    }
  }
  return mesh;
}

/// What violates the zone condition, and where to split it.
struct Zone_rule {
  Requirement r;
  std::optional<Point> split_point(const std::array<Point, 4>& p) const {
    if (!concerns(r, p)) return {};
    const Ball ball = enclosing_ball(p);
    if (ball.squared_radius < r.bound * r.bound) return {};
    // The circumcenter is far from all vertices, but may be outside.
    if (is_flat(p)) return ball.center;
    const Point c = CGAL::circumcenter(p[0], p[1], p[2], p[3]);
    return squared_distance_to_box({0, 0, 0}, {1, 1, 1}, c) > 0 ? ball.center : c;
  }
};

/// What violates condition (18).
struct Paper_rule {
  std::vector<Requirement> all;
  std::optional<Point> split_point(const std::array<Point, 4>& p) const {
    if (is_flat(p)) return CGAL::centroid(p[0], p[1], p[2], p[3]);
    const Point c = CGAL::circumcenter(p[0], p[1], p[2], p[3]);
    const double r2 = CGAL::squared_distance(c, p[0]);
    for (const Requirement& r : all)
      if (r2 >= r.bound * r.bound && squared_distance_to_box(r.lower, r.upper, c) < r2)
        return squared_distance_to_box({0, 0, 0}, {1, 1, 1}, c) > 0 ? CGAL::centroid(p[0], p[1], p[2], p[3])
                                                                    : c;
    return {};
  }
};

/// Inserts the split points, moved a little, and onto nearby faces of the cube, until nothing violates the rule.
template <class Rule>
void refine_until(Delaunay& mesh, const Rule& rule, double h, Random& random) {
  for (bool again = true; again;) {
    again = false;
    std::vector<Point> points, exact;
    for (const Delaunay::Cell_handle cell : mesh.finite_cell_handles()) {
      const std::optional<Point> p = rule.split_point(corners(cell));
      if (!p) continue;
      Coordinates g{};
      for (int axis = 0; axis < 3; ++axis) {
        double& x = g[static_cast<std::size_t>(axis)];
        x = (*p)[axis] + random.between(-0.1, 0.1) * h;
        if (x < 0.3 * h) x = 0;
        if (x > 1 - 0.3 * h) x = 1;
      }
      points.emplace_back(g[0], g[1], g[2]);
      exact.push_back(*p);
      again = true;
    }
    // A point for many neighbours is enough, if there is one.
    const std::size_t before = mesh.number_of_vertices();
    for (const Point& p : points)
      if (CGAL::squared_distance(mesh.nearest_vertex(p)->point(), p) > 0.09 * h * h) mesh.insert(p);
    if (mesh.number_of_vertices() < before + points.size() / 4 + 1)
      for (const Point& p : exact) mesh.insert(p);
  }
}

/// Inserts points and measures the zones of points of the leaf, in turn.
Reach insert_and_measure(Delaunay& mesh, Kind kind, const Requirement& r, double shortest, Random& random) {
  Reach reach;
  for (int step = 0; step < 150; ++step) {
    measure(mesh, r, shortest, point_in(kind, random, r.hole_lower, r.hole_upper), reach);
    const std::uint32_t where = random.below(3);  // in the leaf, around it, anywhere
    mesh.insert(where == 0   ? point_in(kind, random, r.hole_lower, r.hole_upper)
                : where == 1 ? point_in(kind, random, r.lower, r.upper)
                             : point_in(kind, random, {0, 0, 0}, {1, 1, 1}));
  }
  return reach;
}

struct Leaf_of_an_octree {
  Leaf_of_an_octree(int max_level, Random& random)
      : octree(random_octree(random, unit_cube(), max_level, 30)), leaf(random.below(octree.size())) {}
  Requirement requirement() const { return zone_requirement(octree, leaf); }
  double shortest() const { return octree.shortest_touching_edge(leaf); }
  Linear_octree_3 octree;
  std::uint32_t leaf;
};

/// A random leaf and a triangulation that satisfies its zone condition, with the bound multiplied by `weaker`.
Reach experiment(Kind kind, double weaker, Random& random) {
  const Leaf_of_an_octree leaf(2 + static_cast<int>(random.below(2)), random);
  const Requirement r = leaf.requirement();
  Delaunay mesh = beginning(kind, r, random);
  Zone_rule rule{r};
  rule.r.bound *= weaker;
  refine_until(mesh, rule, rule.r.bound, random);
  return insert_and_measure(mesh, kind, r, leaf.shortest(), random);
}

/// The same with condition (18), on a uniform triangulation.
Reach paper_experiment(Random& random) {
  const Leaf_of_an_octree leaf(2, random);
  const Requirement r = leaf.requirement();
  Delaunay mesh = beginning(Kind::uniform, r, random);
  Paper_rule rule;
  pgdr::Buffer_condition().requirements(leaf.octree, leaf.leaf, rule.all);
  refine_until(mesh, rule, 4 * r.bound / 3, random);  // l*/6
  return insert_and_measure(mesh, Kind::uniform, r, leaf.shortest(), random);
}

void require_zone_theorem(Kind kind, int count) {
  Reach reach;
  for (int i = 0; i < count; ++i) {
    Seeded_random random(static_cast<std::uint64_t>(1000 * static_cast<int>(kind) + 71 + i));
    const Reach one = experiment(kind, 1, random);
    CAPTURE(name(kind), i, one.cavity, one.zone);
    REQUIRE(one.cavity < 1);
    REQUIRE(one.zone < 1);
    reach.include(one);
  }
  std::cout << name(kind) << ": " << count << " triangulations, " << reach.cavities << " cavities, "
            << reach.on_hull << " at the hull; they reach " << reach.cavity << " d, stars " << reach.zone
            << " of 2 d\n";
  CHECK(reach.cavities > 100 * static_cast<std::size_t>(count));
  CHECK(reach.on_hull > 2 * static_cast<std::size_t>(count));
  CHECK(reach.cavity > 0.8);  // the theorem is nearly sharp
}

}  // namespace

TEST_CASE("zone theorem: cavities stay within l*/4 of their leaf, stars within l*/2, whatever comes later",
          "[independence]") {
  for (const Kind kind : kinds) require_zone_theorem(kind, 10);
}

// Thousands of triangulations; a test each, so that they run side by side.
TEST_CASE("zone theorem, swept: uniform", "[independence][sweep]") {
  require_zone_theorem(Kind::uniform, 600);
}
TEST_CASE("zone theorem, swept: graded", "[independence][sweep]") { require_zone_theorem(Kind::graded, 600); }
TEST_CASE("zone theorem, swept: slivers", "[independence][sweep]") {
  require_zone_theorem(Kind::slivers, 600);
}
TEST_CASE("zone theorem, swept: flat cells at the hull", "[independence][sweep]") {
  require_zone_theorem(Kind::flat_hull, 600);
}

TEST_CASE("zone theorem: with twice the bound cavities do leave l*/4", "[independence]") {
  for (const Kind kind : kinds) {
    Reach reach;
    for (std::uint64_t i = 0; i < 10; ++i) {
      Seeded_random random(71 + i);
      reach.include(experiment(kind, 2, random));
    }
    CAPTURE(name(kind), reach.cavities, reach.zone);
    CHECK(reach.cavity > 1);
  }
}

TEST_CASE("zone theorem: condition (18) in the place of the zone condition does not do", "[independence]") {
  Reach reach;
  for (std::uint64_t i = 0; i < 4; ++i) {
    Seeded_random random(171 + i);
    reach.include(paper_experiment(random));
  }
  CAPTURE(reach.cavities, reach.cavity);
  CHECK(reach.cavities > 300);
  CHECK(reach.zone > 1);
}
