// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/mesh/territory_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/mesh/conflict_walk_3.h>
#include <pgdr/mesh/vertex_star_3.h>
#include <pgdr/mesh/zone_reach_3.h>

#include "catch.h"
#include "seeded_random.h"

using namespace pgdr_test;

namespace {

using Tr = pgdr::Mesh_triangulation_3<pgdr::Default_kernel>;
using Point = Tr::Point;
using Cell_handle = Tr::Cell_handle;
using Vertex_handle = Tr::Vertex_handle;
using Territory = pgdr::Territory_3<Tr>;

constexpr std::uint16_t count = 4;

/// Random points in the cube from 0 to 1, its corners included, in territories side by side along x.
struct Divided {
  explicit Divided(unsigned seed) : random(seed) {
    for (int k = 0; k < 8; ++k) tr.insert(Point(k & 1, k & 2 ? 1 : 0, k & 4 ? 1 : 0));
    for (int k = 0; k < 2000; ++k) tr.insert(inside());
    for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v)
      v->set_territory(std::min<std::uint16_t>(count, static_cast<std::uint16_t>(1 + count * v->point().x())));
    tr.infinite_vertex()->set_territory(Territory::everybody);
  }

  Point inside() { return Point(random.between(0, 1), random.between(0, 1), random.between(0, 1)); }

  Tr tr;
  Seeded_random random;
};

/// Walks from a vertex to p; where it arrives, the tetrahedron has to be in conflict with p and have a vertex of the kind.
template <class Reach>
bool arrives(const Divided& d, const Reach& reach, Vertex_handle from, const Point& p, const auto& is_of_kind) {
  const Cell_handle c = pgdr::walk_to_conflict(d.tr, reach, from, p);
  if (c == Cell_handle()) return false;
  CHECK(d.tr.in_conflict(c, p));
  bool has_one = false;
  for (int i = 0; i < 4; ++i) has_one = has_one || is_of_kind(c->vertex(i));
  CHECK(has_one);
  return true;
}

}  // namespace

TEST_CASE("No tetrahedron has facets of two territories, not even an infinite one", "[mesh]") {
  Divided d(1);
  std::size_t mixed = 0;
  for (auto c = d.tr.all_cells_begin(); c != d.tr.all_cells_end(); ++c) {
    int owners = 0, own_cells = 0;
    for (std::uint16_t t = 1; t <= count; ++t) {
      const Territory territory{t};
      bool owns_a_facet = false;
      for (int i = 0; i < 4; ++i) {
        bool all = true;
        for (int j = 0; j < 4; ++j) all = all && (j == i || territory.owns(c->vertex(j)));
        owns_a_facet = owns_a_facet || all;
      }
      owners += owns_a_facet;
      own_cells += territory.owns(Cell_handle(c));
    }
    CHECK(owners <= 1);
    CHECK(own_cells <= owners);
    mixed += own_cells == 0;
  }
  CHECK(mixed > 100);
}

TEST_CASE("A cavity is found exactly if it is within the territory, and leaves no marks otherwise", "[mesh]") {
  Divided d(2);
  std::size_t own = 0, foreign = 0;
  for (int k = 0; k < 500; ++k) {
    const Point p = d.inside();
    const Cell_handle seed = d.tr.locate(p);
    pgdr::Cavity_3<Tr> whole(d.tr);
    REQUIRE(whole.find(p, seed));
    const std::vector<Cell_handle> cells = whole.cells();
    whole.abandon();
    for (std::uint16_t t = 1; t <= count; ++t) {
      const Territory territory{t};
      bool is_own = true;
      for (const Cell_handle c : cells) is_own = is_own && territory.owns(c);
      pgdr::Cavity_3<Tr> cavity(d.tr);
      cavity.set_territory(territory);
      CHECK(cavity.find(p, seed) == is_own);
      CHECK(cavity.is_foreign() == !is_own);
      if (is_own) {
        CHECK(cavity.cells() == cells);
        cavity.abandon();
      }
      own += is_own;
      foreign += !is_own;
    }
  }
  CHECK(own > 100);
  CHECK(foreign > 100);
  for (auto c = d.tr.all_cells_begin(); c != d.tr.all_cells_end(); ++c) CHECK(c->tds_data().is_clear());
}

TEST_CASE("Cells outside the ball of a point are not foreign, but not in conflict", "[mesh]") {
  Divided d(3);
  pgdr::Cavity_3<Tr> cavity(d.tr);
  cavity.set_territory({1});
  CHECK_FALSE(cavity.find(Point(0.1, 0.5, 0.5), d.tr.locate(Point(0.9, 0.5, 0.5))));
  CHECK_FALSE(cavity.is_foreign());
}

TEST_CASE("New vertices belong to the territory of the task that inserts them", "[mesh]") {
  Divided d(4);
  pgdr::Cavity_3<Tr> cavity(d.tr);
  cavity.set_territory({2});
  // In the middle of the territory most cavities are within it.
  Point p(0.375, 0.5, 0.5);
  bool is_within = cavity.find(p, d.tr.locate(p));
  for (int k = 0; k < 100 && !is_within; ++k) {
    p = Point(0.375, d.random.between(0.25, 0.75), 0.5);
    is_within = cavity.find(p, d.tr.locate(p));
  }
  REQUIRE(is_within);
  CHECK(cavity.commit(p)->territory() == 2);
  for (const Cell_handle c : cavity.star()) CHECK(Territory{2}.owns(c));
  CHECK(d.tr.is_valid());
}

TEST_CASE("A vertex is of the territory that it lies in, unless it was numbered in this division", "[mesh]") {
  Divided d(6);
  const std::uint32_t before = d.tr.reserve_territories(7), first = d.tr.reserve_territories(3);
  CHECK(first == before + 7);
  const double inf = std::numeric_limits<double>::infinity();
  const Territory left{{first + 1, first, {{-inf, -inf, -inf}, {0.5, inf, inf}}}}, right{{first + 2, first, {{0.5, -inf, -inf}, {inf, inf, inf}}}};
  CHECK(left.owns(d.tr.infinite_vertex()));
  CHECK_FALSE(left.leads_on(d.tr.infinite_vertex()));
  for (auto v = d.tr.finite_vertices_begin(); v != d.tr.finite_vertices_end(); ++v) {
    if (d.random.between(0, 1) < 0.3) v->set_territory(before + 1);
    const bool is_left = v->point().x() < 0.5;
    CHECK(left.owns(v) == is_left);
    CHECK(right.leads_on(v) == !is_left);
    CHECK(v->territory() == (is_left ? left : right).number);
    v->set_territory(first);  // given away
    CHECK_FALSE(left.owns(v));
    CHECK_FALSE(right.owns(v));
    v->set_territory(left.number);  // or inserted by the other task
    CHECK(left.owns(v));
    CHECK_FALSE(right.owns(v));
  }
}

TEST_CASE("A walk finds a tetrahedron in conflict, and does not leave its territory", "[mesh]") {
  Divided d(5);
  std::vector<Vertex_handle> vertices;
  for (auto v = d.tr.finite_vertices_begin(); v != d.tr.finite_vertices_end(); ++v) vertices.push_back(v);
  std::size_t found = 0, left = 0;
  for (std::size_t k = 0; k < vertices.size(); k += 3) {
    const Point p = d.inside();
    // Alone, it always arrives.
    const Cell_handle c = pgdr::walk_to_conflict(d.tr, Territory{}, vertices[k], p);
    REQUIRE(c != Cell_handle());
    CHECK(d.tr.in_conflict(c, p));
    const Territory own{vertices[k]->territory()};
    ++(arrives(d, own, vertices[k], p, [&](Vertex_handle v) { return own.leads_on(v); }) ? found : left);
  }
  CHECK(found > 50);
  CHECK(left > 50);
}

TEST_CASE("A walk in the zone of a leaf steps only to tetrahedra with a vertex near the leaf", "[mesh]") {
  Divided d(7);
  const pgdr::Zone_reach_3<Tr> zone{{{0.3, 0.3, 0.3}, {0.6, 0.6, 0.6}}, d.tr.infinite_vertex()};
  std::size_t found = 0, left = 0;
  for (auto v = d.tr.finite_vertices_begin(); v != d.tr.finite_vertices_end(); ++v) {
    if (!zone.is_near(v)) continue;
    const Point q = d.inside(), p = left > found ? Point(0.3 + 0.3 * q.x(), 0.3 + 0.3 * q.y(), 0.3 + 0.3 * q.z()) : q;
    ++(arrives(d, zone, Vertex_handle(v), p, [&](Vertex_handle w) { return zone.is_near(w); }) ? found : left);
  }
  CHECK(found > 20);
  CHECK(left > 20);
  CHECK_FALSE(zone.is_near(d.tr.infinite_vertex()));
  CHECK(pgdr::Zone_reach_3<Tr>{{}, d.tr.infinite_vertex()}.leads_on(d.tr.finite_cells_begin()));
}

TEST_CASE("A walk to where a vertex is ends at it", "[mesh]") {
  Divided d(8);
  const auto from = d.tr.finite_vertices_begin();
  for (auto v = d.tr.finite_vertices_begin(); v != d.tr.finite_vertices_end(); ++v) {
    const Cell_handle c = pgdr::walk_to_conflict(d.tr, Territory{}, Vertex_handle(from), v->point());
    REQUIRE(c != Cell_handle());
    CHECK(c->has_vertex(v));
    CHECK(pgdr::has_vertex_at(d.tr, c, v->point()));
  }
}

TEST_CASE("Edges and triangles are found where CGAL finds them, without marks", "[mesh]") {
  Divided d(6);
  pgdr::Vertex_star_3<Tr> star;
  std::size_t there = 0, missing = 0;
  std::vector<Vertex_handle> vertices;
  for (auto v = d.tr.finite_vertices_begin(); v != d.tr.finite_vertices_end(); ++v) vertices.push_back(v);
  const auto check = [&](Vertex_handle u, Vertex_handle v, Vertex_handle w) {
    Cell_handle c;
    int i, j, k;
    // Which of the cells around them is found first is up to the search.
    const Cell_handle edge = star.find_edge(u, v), facet = star.find_facet(u, v, w);
    CHECK((edge != Cell_handle()) == d.tr.is_edge(u, v, c, i, j));
    CHECK((edge == Cell_handle() || (edge->has_vertex(u) && edge->has_vertex(v))));
    CHECK((facet != Cell_handle()) == d.tr.is_facet(u, v, w, c, i, j, k));
    CHECK((facet == Cell_handle() || (facet->has_vertex(u) && facet->has_vertex(v) && facet->has_vertex(w))));
    ++(facet == Cell_handle() ? missing : there);
  };
  for (auto f = d.tr.finite_facets_begin(); f != d.tr.finite_facets_end(); ++f)
    check(f->first->vertex((f->second + 1) % 4), f->first->vertex((f->second + 2) % 4), f->first->vertex((f->second + 3) % 4));
  for (std::size_t k = 2; k < vertices.size(); ++k) check(vertices[k], vertices[k - 1], vertices[k - 2]);
  // A vertex with many cells around it makes the table grow.
  check(d.tr.infinite_vertex(), vertices[0], vertices[1]);
  CHECK(there > 1000);
  CHECK(missing > 1000);
}
