// SPDX-License-Identifier: GPL-3.0-or-later
// Theorem 3 (buffer_condition.h): where condition (18) holds, points of leaves that are not in each other's buffer are
// strongly Delaunay-independent (strong_independence.h).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <CGAL/Delaunay_triangulation_3.h>

#include <pgdr/independence/buffer_condition.h>
#include <pgdr/independence/strong_independence.h>
#include <pgdr/octree/linear_octree_3.h>

#include "catch.h"
#include "independence/zone_reach.h"
#include "octree/random_octree.h"
#include "seeded_random.h"

using namespace pgdr_test;
using pgdr::Linear_octree_3;

namespace {

/// What (18) asks of a circumball: the smallest l(L')/6 among the leaves that it meets, times a factor.
double allowed_radius(const Linear_octree_3& octree, const Point& center, double radius, double factor) {
  double allowed = 1e300;
  for (std::uint32_t i = 0; i < octree.size(); ++i) {
    if (squared_distance_to_box(octree.lower(i), octree.upper(i), center) < radius * radius)
      allowed = std::min(allowed, factor * octree.edge(i) / 6);
  }
  return allowed;
}

/// A triangulation of the unit cube in which (18) holds for every leaf, with its constant 1/6 multiplied by `factor`.
Delaunay mesh_for(const Linear_octree_3& octree, double factor, Random& random) {
  Delaunay t;
  for (int k = 0; k < 8; ++k) t.insert(Point(k & 1, k >> 1 & 1, k >> 2));
  for (bool again = true; again;) {
    again = false;
    std::vector<Point> points;
    for (const Delaunay::Cell_handle c : t.finite_cell_handles()) {
      const Point center = t.dual(c);
      const double r = std::sqrt(CGAL::squared_distance(center, c->vertex(0)->point()));
      const double allowed = allowed_radius(octree, center, r * (1 + 1e-9), factor);
      if (r < allowed * (1 - 1e-9)) continue;
      // Near the circumcenter, but on the hull where that is beyond or close to it.
      Coordinates x{};
      for (int k = 0; k < 3; ++k) {
        double& value = x[static_cast<std::size_t>(k)];
        value = center[k] + 0.2 * std::min(allowed, r) * random.between(-1, 1);
        if (value < 0.3 * allowed) value = 0;
        if (value > 1 - 0.3 * allowed) value = 1;
      }
      points.emplace_back(x[0], x[1], x[2]);
    }
    for (const Point& p : points) {
      // Several of one neighbourhood would be too many.
      const auto v = t.nearest_vertex(p);
      const double near = 0.4 * factor * octree.edge(octree.find(Coordinates{p.x(), p.y(), p.z()})) / 6;
      if (CGAL::squared_distance(v->point(), p) < 0.25 * near * near) continue;
      t.insert(p);
      again = true;
    }
    if (!again && !points.empty())
      for (const Point& p : points) again = t.insert(p) != Delaunay::Vertex_handle() || again;
  }
  return t;
}

Point in_leaf(const Linear_octree_3& octree, std::uint32_t i, Random& random) {
  Coordinates x{};
  for (std::size_t k = 0; k < 3; ++k) {
    // Often on the leaf's faces.
    const std::uint32_t where = random.below(4);
    x[k] = where == 0   ? octree.lower(i)[k]
           : where == 1 ? octree.upper(i)[k] - 1e-9
                        : random.between(octree.lower(i)[k], octree.upper(i)[k]);
  }
  return Point(x[0], x[1], x[2]);
}

/// The point of a leaf that is nearest to p, or nearly so.
Point towards(const Linear_octree_3& octree, std::uint32_t i, const Point& p, Random& random) {
  Coordinates x{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double inner = 1e-9 + (random.below(2) ? 0 : random.between(0, 0.2) * octree.edge(i));
    x[k] = std::clamp(p[static_cast<int>(k)], octree.lower(i)[k] + inner, octree.upper(i)[k] - inner);
  }
  return Point(x[0], x[1], x[2]);
}

struct Count {
  std::size_t pairs = 0, dependent = 0, displaced = 0;
};

/// Tries pairs of points of leaves that are close, but not in each other's buffer.
Count try_pairs(const Linear_octree_3& octree, const Delaunay& t, std::size_t pairs, Random& random) {
  const pgdr::Hull_encroachment<Delaunay> rule;
  Count count;
  std::vector<std::uint32_t> buffer, around;
  for (std::size_t n = 0; n < pairs; ++n) {
    const std::uint32_t i = random.below(octree.size());
    octree.buffer(i, buffer);
    // Leaves just beyond the buffer.
    std::vector<std::uint32_t> beyond;
    for (const std::uint32_t b : buffer) {
      octree.touching(b, around);
      for (const std::uint32_t j : around)
        if (j != i && std::find(buffer.begin(), buffer.end(), j) == buffer.end()) beyond.push_back(j);
    }
    if (beyond.empty()) continue;
    const std::uint32_t j = beyond[random.below(static_cast<std::uint32_t>(beyond.size()))];
    const Point p = in_leaf(octree, i, random), q = towards(octree, j, p, random);
    if (is_vertex(t, p) || is_vertex(t, q)) continue;
    ++count.pairs;
    count.displaced += rule(t, p).size() + rule(t, q).size() > 2;
    count.dependent += !pgdr::are_strongly_delaunay_independent(t, p, q, rule);
  }
  return count;
}

/// Uniform, balanced, and with leaves of a quarter of their neighbours' size.
std::vector<Linear_octree_3> octrees(Random& random) {
  std::vector<Linear_octree_3> all{Linear_octree_3::uniform(unit_cube(), 2)};
  Linear_octree_3 corner = Linear_octree_3::uniform(unit_cube(), 1);
  for (int round = 0; round < 2; ++round) {
    std::vector<std::uint8_t> which(corner.size(), 0);
    which[corner.find(Coordinates{0.49, 0.49, 0.49})] = 1;
    corner = corner.split(which);
  }
  all.push_back(corner);  // 4 : 1 at the center of the cube
  all.push_back(balanced(corner));
  all.push_back(balanced(random_octree(random, unit_cube(), 2, 30)));
  return all;
}

}  // namespace

TEST_CASE("Theorem 3: beyond the buffer points are strongly independent", "[independence]") {
  Seeded_random random(18);
  std::size_t pairs = 0, displaced = 0;
  for (const Linear_octree_3& octree : octrees(random)) {
    const Delaunay t = mesh_for(octree, 1, random);
    const Count count = try_pairs(octree, t, 250, random);
    CAPTURE(octree.size(), t.number_of_vertices(), count.pairs, count.displaced);
    CHECK(count.dependent == 0);
    pairs += count.pairs;
    displaced += count.displaced;
  }
  CHECK(pairs > 900);
  CHECK(displaced > 50);
}

TEST_CASE("With a constant of one instead of a sixth theorem 3 is wrong", "[independence]") {
  Seeded_random random(19);
  std::size_t dependent = 0;
  for (const Linear_octree_3& octree : octrees(random))
    for (int k = 0; k < 3; ++k)
      dependent += try_pairs(octree, mesh_for(octree, 6, random), 500, random).dependent;
  CHECK(dependent > 0);
}
