// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/mesh/vertex_hole_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/mesh/cavity_3.h>

#include "catch.h"
#include "seeded_random.h"

using namespace pgdr_test;

namespace {

using Tr = pgdr::Mesh_triangulation_3<pgdr::Default_kernel>;
using Point = Tr::Point;
using Cell_handle = Tr::Cell_handle;
using Vertex_handle = Tr::Vertex_handle;

/// A grid, all of whose cubes are cospherical, or random points; in a cube with its corners.
Tr points_in_cube(bool is_grid, unsigned seed) {
  Tr tr;
  for (int k = 0; k < 8; ++k) tr.insert(Point(k & 1 ? 8 : 0, k & 2 ? 8 : 0, k & 4 ? 8 : 0));
  Seeded_random random(seed);
  for (int k = 0; k < 343; ++k)
    tr.insert(is_grid ? Point(1 + k % 7, 1 + k / 7 % 7, 1 + k / 49) : Point(random.between(1, 7), random.between(1, 7), random.between(1, 7)));
  for (auto c = tr.all_cells_begin(); c != tr.all_cells_end(); ++c) c->set_subdomain(1);
  return tr;
}

std::vector<Vertex_handle> inner_vertices(const Tr& tr) {
  std::vector<Vertex_handle> inner;
  for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v) {
    const Point& p = v->point();
    if (std::min({p.x(), p.y(), p.z()}) > 0 && std::max({p.x(), p.y(), p.z()}) < 8) inner.push_back(v);
  }
  return inner;
}

}  // namespace

TEST_CASE("What fills the hole of a vertex is Delaunay, cospherical points or not", "[mesh]") {
  for (const bool is_grid : {false, true}) {
    CAPTURE(is_grid);
    Tr tr = points_in_cube(is_grid, 1);
    pgdr::Vertex_hole_3<Tr> hole(tr);
    std::size_t removed = 0;
    for (const Vertex_handle v : inner_vertices(tr)) {
      if (!hole.find(v) || !hole.fill()) continue;  // next to the hull
      for (const auto& t : hole.filling()) {
        REQUIRE(CGAL::orientation(hole.vertices()[t.corners[0]]->point(), hole.vertices()[t.corners[1]]->point(),
                                  hole.vertices()[t.corners[2]]->point(), hole.vertices()[t.corners[3]]->point()) == CGAL::POSITIVE);
        for (std::size_t u = 0; u < hole.vertices().size(); ++u)
          if (std::ranges::find(t.corners, u) == t.corners.end()) REQUIRE_FALSE(hole.in_conflict(t, hole.vertices()[u]->point()));
      }
      hole.commit();
      tr.tds().delete_vertex(v);
      if (++removed % 20 == 0) REQUIRE(tr.is_valid());
    }
    CHECK(removed > 100);
    CHECK(tr.is_valid());
  }
}

TEST_CASE("A vertex that is put back leaves everything as it was", "[mesh]") {
  for (const bool is_grid : {false, true}) {
    CAPTURE(is_grid);
    Tr tr = points_in_cube(is_grid, 2);
    pgdr::Vertex_hole_3<Tr> hole(tr);
    pgdr::Cavity_3<Tr> cavity(tr);
    for (const Vertex_handle v : inner_vertices(tr)) {
      if (!hole.find(v) || !hole.fill()) continue;
      const std::size_t before = tr.tds().number_of_cells();
      const Point p = v->point();
      const std::vector<Cell_handle> filling = hole.commit();
      const auto c = std::ranges::find_if(filling, [&](Cell_handle d) { return tr.in_conflict(d, p); });
      REQUIRE(c != filling.end());
      REQUIRE(cavity.find(p, *c));
      cavity.commit(p, v);
      REQUIRE(tr.tds().number_of_cells() == before);
    }
    CHECK(tr.is_valid());
  }
}

TEST_CASE("A hole keeps the marks of what is around it, and is refused where they would be lost", "[mesh]") {
  Tr tr = points_in_cube(false, 3);
  pgdr::Vertex_hole_3<Tr> hole(tr);
  const Vertex_handle v = inner_vertices(tr)[50];
  REQUIRE(hole.find(v));
  // A subfacet and a subsegment on the link.
  const Cell_handle c = hole.star()[0];
  const int i = c->index(v), j = (i + 1) % 4, k = (i + 2) % 4;
  const Vertex_handle a = c->vertex(j), b = c->vertex(k);
  c->set_subfacet(i, 7);
  for (const Cell_handle d : hole.star())
    if (d->has_vertex(a) && d->has_vertex(b)) d->set_subsegment_edges(pgdr::edge_bit(d->index(a), d->index(b)));
  REQUIRE(hole.find(v));
  REQUIRE(hole.fill());
  std::size_t subfacets = 0;
  for (const Cell_handle d : hole.commit()) {
    for (int m = 0; m < 4; ++m) subfacets += d->subfacet(m) == 7;
    const bool has_edge = d->has_vertex(a) && d->has_vertex(b);
    CHECK(d->subsegment_edges() == (has_edge ? pgdr::edge_bit(d->index(a), d->index(b)) : 0));
  }
  CHECK(subfacets == 1);

  const Vertex_handle w = inner_vertices(tr)[200];
  const Cell_handle at = w->cell();
  at->set_subfacet((at->index(w) + 1) % 4, 9);
  CHECK(!hole.find(w));
  at->set_subfacet((at->index(w) + 1) % 4, Tr::Cell::no_subfacet);
  at->set_subdomain(2);
  CHECK(!hole.find(w));
}

TEST_CASE("A vertex whose star is not within the territory stays", "[mesh]") {
  Tr tr = points_in_cube(false, 4);
  for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v) v->set_territory(v->point().x() < 4 ? 1 : 2);
  tr.infinite_vertex()->set_territory(pgdr::Territory_3<Tr>::everybody);
  pgdr::Vertex_hole_3<Tr> hole(tr);
  hole.set_territory({1});
  std::size_t own = 0, foreign = 0;
  for (const Vertex_handle v : inner_vertices(tr)) {
    std::vector<Vertex_handle> around;
    tr.adjacent_vertices(v, std::back_inserter(around));
    const bool is_own = v->territory() == 1 && std::ranges::all_of(around, [](Vertex_handle u) { return u->territory() != 2; });
    const bool is_found = hole.find(v);
    CHECK(hole.is_foreign() == !is_own);
    CHECK((is_own || !is_found));
    ++(is_own ? own : foreign);
  }
  CHECK(own > 20);
  CHECK(foreign > 100);
}
