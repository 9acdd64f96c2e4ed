// SPDX-License-Identifier: GPL-3.0-or-later
// What condition (18) of the paper does not say (buffer_condition.h; docs/theory.md, section 3). The meshes were found
// by constructing, or by searching and then removing points as long as the example remained one.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <set>
#include <vector>

#include <pgdr/independence/buffer_condition.h>
#include <pgdr/independence/strong_independence.h>
#include <pgdr/octree/linear_octree_3.h>

#include "catch.h"
#include "independence/zone_reach.h"

using namespace pgdr_test;
using pgdr::Linear_octree_3;
using pgdr::Octree_box;
using pgdr::Requirement;

namespace {

/// A cube of edge 16; one octant in leaves of edge 1, the others of edge 8.
Linear_octree_3 two_sizes() {
  Linear_octree_3 octree = Linear_octree_3::uniform(Octree_box::around({0, 0, 0}, {16, 16, 16}), 1);
  for (int level = 1; level < 4; ++level) {
    std::vector<std::uint8_t> which(octree.size(), 0);
    for (std::uint32_t i = 0; i < octree.size(); ++i)
      which[i] = std::ranges::max(octree.upper(i)) <= 8 && octree.edge(i) > 1;
    octree = octree.split(which);
  }
  return octree;
}

/// Condition (18), with a margin for rounding on the safe side.
bool satisfies_buffer_condition(const Delaunay& mesh, const Linear_octree_3& octree, std::uint32_t leaf) {
  std::vector<Requirement> all;
  pgdr::Buffer_condition().requirements(octree, leaf, all);
  for (const Delaunay::Cell_handle cell : mesh.finite_cell_handles()) {
    const Point c = mesh.dual(cell);
    const double r2 = CGAL::squared_distance(c, cell->vertex(0)->point());
    for (const Requirement& r : all)
      if (squared_distance_to_box(r.lower, r.upper, c) < r2 * (1 + 1e-6) &&
          r2 * (1 + 1e-6) >= r.bound * r.bound)
        return false;
  }
  return true;
}

bool contains(const Delaunay& mesh, const Point& p) { return !mesh.is_infinite(mesh.locate(p)); }

/// All finite cells with a vertex of the cavity of p: what an insertion writes to.
std::set<Delaunay::Cell_handle> zone(const Delaunay& mesh, const Point& p) {
  const Cavity cavity(mesh, p);
  std::vector<Delaunay::Cell_handle> cells;
  for (const Delaunay::Cell_handle c : cavity.cells)
    for (int i = 0; i < 4; ++i)
      if (!mesh.is_infinite(c->vertex(i)))
        mesh.finite_incident_cells(c->vertex(i), std::back_inserter(cells));
  return {cells.begin(), cells.end()};
}

}  // namespace

TEST_CASE("Condition (18) lets a cavity be larger than the leaf", "[independence]") {
  // One tetrahedron, beside a leaf of edge 1, in a leaf of edge 8 of which a sixth is allowed.
  const Linear_octree_3 octree = two_sizes();
  const std::uint32_t leaf = octree.find(Coordinates{7.5, 0.5, 0.5});
  Delaunay mesh;
  for (const Point& p :
       {Point(7.99, 0.45, 0.45), Point(7.99, 0.55, 0.45), Point(7.99, 0.5, 0.55), Point(10.5, 0.5, 0.5)})
    mesh.insert(p);
  const Point p(7.995, 0.5, 0.48);
  REQUIRE(octree.find(Coordinates{p.x(), p.y(), p.z()}) == leaf);
  REQUIRE(contains(mesh, p));
  CHECK(satisfies_buffer_condition(mesh, octree, leaf));
  Reach reach;
  measure(mesh, zone_requirement(octree, leaf), octree.shortest_touching_edge(leaf), p, reach);
  CHECK(reach.cavity == Approx(10));  // 2.5 from the leaf, instead of d = 1/4
}

TEST_CASE("Condition (18) does not last", "[independence]") {
  // Two tetrahedra on a common triangle, and a point in a leaf beyond the buffer.
  const Linear_octree_3 octree = Linear_octree_3::uniform(Octree_box::around({0, 0, 0}, {4, 4, 4}), 2);
  REQUIRE(octree.edge(0) == 1);
  const std::uint32_t leaf = octree.find(Coordinates{0.5, 1.5, 1.5});
  Delaunay mesh;
  for (const Point& p : {Point(1.9, 1.5, 1.5), Point(2.05, 1.64, 1.5), Point(2.05, 1.43, 1.62),
                         Point(2.05, 1.43, 1.38), Point(3.5, 1.5, 1.5)})
    mesh.insert(p);
  CHECK(satisfies_buffer_condition(mesh, octree, leaf));
  const Point p(2.01, 1.595, 1.5);
  REQUIRE(contains(mesh, p));
  std::vector<std::uint32_t> buffer;
  octree.buffer(leaf, buffer);
  REQUIRE_FALSE(std::ranges::binary_search(buffer, octree.find(Coordinates{p.x(), p.y(), p.z()})));
  mesh.insert(p);
  CHECK_FALSE(satisfies_buffer_condition(mesh, octree, leaf));
}

TEST_CASE("With condition (18), zones of leaves that are not in each other's buffer may overlap",
          "[independence]") {
  const Linear_octree_3 octree = two_sizes();
  const Point p(7.98, 0.82, 0.49), q(7.98, 2.15, 0.59);
  const std::uint32_t at_p = octree.find(Coordinates{p.x(), p.y(), p.z()});
  const std::uint32_t at_q = octree.find(Coordinates{q.x(), q.y(), q.z()});
  std::vector<std::uint32_t> buffer, touching;
  octree.buffer(at_p, buffer);
  octree.touching(at_p, touching);
  REQUIRE_FALSE(std::ranges::binary_search(buffer, at_q));
  REQUIRE_FALSE(std::ranges::binary_search(touching, at_q));
  constexpr double points[][3] = {
      {10.3613, 0.4, 0.6}, {10.439, 0.4, 0.4}, {10.9201, 2.6, 0.4}, {11.13, 2.5, 0.6}, {7.95, 0.72, 0.6},
      {7.95, 0.94, 0.4},   {7.95, 1.01, 0.6},  {7.95, 1.19, 0.4},   {7.95, 1.29, 0.6}, {7.95, 1.34, 0.4},
      {7.95, 1.53, 0.4},   {7.95, 1.56, 0.6},  {7.95, 1.81, 0.4},   {7.95, 1.81, 0.6}, {7.95, 1.97, 0.4},
      {7.95, 2.06, 0.6},   {7.95, 2.23, 0.4},  {7.95, 2.6, 0.6},    {8, 0.51, 0.4},    {8.06, 1.72, 0.4},
      {8.08, 0.93, 0.6},   {8.08, 1.97, 0.6},  {8.09, 2.12, 0.4},   {8.1, 1.02, 0.4},  {8.12, 1.44, 0.6},
      {8.12, 1.52, 0.4},   {8.14, 1.96, 0.4},  {8.15, 1.72, 0.6},   {8.16, 1.21, 0.6}, {8.21, 1.3, 0.4},
      {8.38, 2.05, 0.6},   {8.41, 0.94, 0.4},  {8.54, 0.4, 0.6},    {8.56, 0.8, 0.6},  {8.6, 0.4, 0.4},
      {8.8, 2.6, 0.4},     {8.85, 2.2, 0.4},   {8.91, 2.6, 0.6},    {9.11, 0.4, 0.6},  {9.16, 0.4, 0.4},
      {9.52, 2.6, 0.4},    {9.64, 1.88, 0.4},  {9.69, 2.6, 0.6},    {9.75, 1.94, 0.6}};
  Delaunay mesh;
  for (const auto& x : points) mesh.insert(Point(x[0], x[1], x[2]));
  REQUIRE(contains(mesh, p));
  REQUIRE(contains(mesh, q));
  CHECK(satisfies_buffer_condition(mesh, octree, at_p));
  CHECK(satisfies_buffer_condition(mesh, octree, at_q));
  // As theorem 3 says, the mesh would be right, ...
  CHECK(pgdr::are_strongly_delaunay_independent(mesh, p, q, pgdr::Hull_encroachment<Delaunay>()));
  // ... but two threads would write to the same cells.
  const auto a = zone(mesh, p), b = zone(mesh, q);
  CHECK(std::ranges::any_of(a, [&](const auto& cell) { return b.contains(cell); }));
}
