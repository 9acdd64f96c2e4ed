// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/mesh/cavity_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_3.h>

#include <pgdr/domain/default_kernel.h>

#include "catch.h"
#include "seeded_random.h"

using namespace pgdr_test;

namespace {

using K = pgdr::Default_kernel;
using Point = K::Point_3;
using Tr = pgdr::Mesh_triangulation_3<K>;
using Cell_handle = Tr::Cell_handle;
using Vertex_handle = Tr::Vertex_handle;
using Points = std::vector<Point>;

Points box_corners() {
  Points corners;
  for (int k = 0; k < 8; ++k) corners.emplace_back(k & 1 ? 2 : -2, k & 2 ? 2 : -2, k & 4 ? 2 : -2);
  return corners;
}

Points random_points(std::size_t n, std::uint64_t seed) {
  Seeded_random random(seed);
  Points points;
  for (std::size_t i = 0; i < n; ++i)
    points.emplace_back(random.between(-2, 2), random.between(-2, 2), random.between(-2, 2));
  return points;
}

/// Also on the faces, edges and corners of the box.
Points grid_points(int n) {
  Points points;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (int k = 0; k <= n; ++k) points.emplace_back(-2 + 4.0 * i / n, -2 + 4.0 * j / n, -2 + 4.0 * k / n);
  return points;
}

/// Integer points of a sphere, exactly cospherical, and as many that are so up to rounding.
Points cospherical_points(std::size_t rounded, std::uint64_t seed) {
  Points points;
  for (int x = -65; x <= 65; ++x)
    for (int y = -65; y <= 65; ++y)
      for (int z = -65; z <= 65; ++z)
        if (x * x + y * y + z * z == 65 * 65) points.emplace_back(x / 64.0, y / 64.0, z / 64.0);
  Seeded_random random(seed);
  while (rounded > 0) {
    const double x = random.between(-1, 1), y = random.between(-1, 1), z = random.between(-1, 1);
    const double r = std::sqrt(x * x + y * y + z * z);
    if (r > 1 || r < 0.1) continue;
    points.emplace_back(x / r, y / r, z / r);
    --rounded;
  }
  return points;
}

template <class T>
void shuffle(std::vector<T>& items, std::uint64_t seed) {
  Seeded_random random(seed);
  for (std::size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[random.below(static_cast<std::uint32_t>(i))]);
}

/// A triangulation of the box and `points`, all but the box inserted by `Cavity_3`.
void insert(Tr& tr, const Points& points) {
  Vertex_handle on_hull;
  for (const Point& p : box_corners()) on_hull = tr.insert(p);
  pgdr::Cavity_3<Tr> cavity(tr);
  Cell_handle hint = tr.infinite_cell();
  for (const Point& p : points) {
    Tr::Locate_type type;
    int i, j;
    const Cell_handle c = tr.locate(p, type, i, j, hint);
    if (type == Tr::VERTEX) continue;
    REQUIRE(cavity.find(p, c));
    hint = cavity.commit(p)->cell();
  }
  tr.restore_infinite_cell(on_hull);
}

std::array<Vertex_handle, 4> vertices(Cell_handle c) {
  std::array<Vertex_handle, 4> v{c->vertex(0), c->vertex(1), c->vertex(2), c->vertex(3)};
  std::sort(v.begin(), v.end());
  return v;
}

/// The finite cells by the coordinates of their vertices.
template <class Triangulation>
std::vector<std::array<Point, 4>> cells(const Triangulation& tr) {
  std::vector<std::array<Point, 4>> result;
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) {
    result.push_back(
        {c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(), c->vertex(3)->point()});
    std::sort(result.back().begin(), result.back().end());
  }
  std::sort(result.begin(), result.end());
  return result;
}

bool marks_are_clear(const Tr& tr) {
  for (auto c = tr.all_cells_begin(); c != tr.all_cells_end(); ++c)
    if (!c->tds_data().is_clear()) return false;
  return true;
}

}  // namespace

TEST_CASE("Insertion through the cavity gives CGAL's Delaunay triangulation", "[mesh]") {
  const auto [name, points] = GENERATE(table<const char*, Points>({
      {"random", random_points(20000, 1)},
      {"grid", grid_points(16)},
      {"cospherical", cospherical_points(2000, 2)},
  }));
  for (const std::uint64_t seed : {3u, 4u}) {
    CAPTURE(name, points.size(), seed);
    Points shuffled = points;
    shuffle(shuffled, seed);
    Tr tr;
    insert(tr, shuffled);
    CHECK(marks_are_clear(tr));
    REQUIRE(tr.is_valid());
    Points all = box_corners();
    all.insert(all.end(), points.begin(), points.end());
    const CGAL::Delaunay_triangulation_3<K> expected(all.begin(), all.end());
    CHECK(tr.number_of_vertices() == expected.number_of_vertices());
    CHECK(tr.number_of_cells() == expected.number_of_cells());
    // Equal even where points are cospherical: the perturbation depends on coordinates only.
    CHECK(cells(tr) == cells(expected));
  }
}

TEST_CASE("A point that is not in the seed's ball finds no cavity", "[mesh]") {
  Tr tr;
  insert(tr, random_points(200, 5));
  const auto before = cells(tr);
  pgdr::Cavity_3<Tr> cavity(tr);
  int refused = 0;
  const Point p(0.1, 0.2, 0.3);
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) {
    const bool inside =
        CGAL::side_of_bounded_sphere(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(),
                                     c->vertex(3)->point(), p) == CGAL::ON_BOUNDED_SIDE;
    const bool found = cavity.find(p, c);
    CHECK(found == inside);
    if (found) cavity.abandon();
    refused += !found;
    REQUIRE(marks_are_clear(tr));
  }
  CHECK(refused > 0);
  CHECK(cells(tr) == before);
}

TEST_CASE("An abandoned cavity leaves the triangulation as it was", "[mesh]") {
  Tr tr;
  insert(tr, random_points(500, 6));
  std::vector<std::pair<Cell_handle, unsigned int>> ids;
  for (auto c = tr.all_cells_begin(); c != tr.all_cells_end(); ++c) ids.emplace_back(c, c->generation());
  const auto before = cells(tr);
  pgdr::Cavity_3<Tr> cavity(tr);
  for (const Point& p : random_points(200, 7)) {
    REQUIRE(cavity.find(p, tr.locate(p)));
    // The marks are there while the cavity is.
    std::size_t marked = 0;
    for (auto c = tr.all_cells_begin(); c != tr.all_cells_end(); ++c)
      marked += pgdr::Cavity_3<Tr>::contains(c);
    CHECK(marked == cavity.cells().size());
    for (const auto& f : cavity.boundary()) {
      CHECK(pgdr::Cavity_3<Tr>::contains(f.first));
      CHECK(!pgdr::Cavity_3<Tr>::contains(f.first->neighbor(f.second)));
    }
    cavity.abandon();
    REQUIRE(marks_are_clear(tr));
  }
  CHECK(cells(tr) == before);
  for (const auto& [c, generation] : ids) CHECK(c->generation() == generation);
  CHECK(tr.is_valid());
}

TEST_CASE("The insertion radius is the distance to the nearest vertex", "[mesh]") {
  Tr tr;
  insert(tr, random_points(800, 8));
  pgdr::Cavity_3<Tr> cavity(tr);
  Points points = random_points(300, 9);
  points.emplace_back(2, 0.3, -0.7);  // on the hull: an infinite cell is in the cavity
  points.emplace_back(2, 2, 0.123);
  for (const Point& p : points) {
    REQUIRE(cavity.find(p, tr.locate(p)));
    double nearest = std::numeric_limits<double>::infinity();
    for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v)
      nearest = std::min(nearest, pgdr::squared_distance(pgdr::to_vec(p), pgdr::to_vec(v->point())));
    CHECK(cavity.squared_insertion_radius(pgdr::to_vec(p)) == nearest);
    cavity.abandon();
  }
}

TEST_CASE("A remembered tetrahedron is recognised exactly while it exists", "[mesh]") {
  Tr tr;
  insert(tr, random_points(50, 10));
  struct Id {
    Cell_handle cell;
    unsigned int generation;
    std::array<Vertex_handle, 4> vertices;
    bool dead = false;
  };
  std::vector<Id> ids;
  for (auto c = tr.all_cells_begin(); c != tr.all_cells_end(); ++c)
    ids.push_back({c, c->generation(), vertices(c)});
  pgdr::Cavity_3<Tr> cavity(tr);
  std::size_t reused = 0;
  for (const Point& p : random_points(400, 11)) {
    REQUIRE(cavity.find(p, tr.locate(p)));
    for (Id& id : ids)
      if (!id.dead && pgdr::Cavity_3<Tr>::contains(id.cell)) id.dead = true;
    cavity.commit(p);
    bool right = true;
    for (const Id& id : ids) {
      const bool live = id.cell->generation() == id.generation;
      right = right && live == !id.dead && (!live || vertices(id.cell) == id.vertices);
    }
    REQUIRE(right);
    for (const Cell_handle c : cavity.star()) {
      reused += std::any_of(ids.begin(), ids.end(), [&](const Id& id) { return id.dead && id.cell == c; });
      ids.push_back({c, c->generation(), vertices(c)});
    }
  }
  CHECK(reused > 100);
}

TEST_CASE("The generation of a slot survives that the container takes it back", "[mesh]") {
  Tr tr;
  insert(tr, {});
  auto& tds = tr.tds();
  const Cell_handle c = tds.create_cell();
  const unsigned int generation = c->generation();
  tds.delete_cell(c);
  std::vector<Cell_handle> made;
  bool again = false;
  for (int k = 0; k < 100; ++k) {
    made.push_back(tds.create_cell());
    if (made.back() != c) continue;
    again = true;
    CHECK(c->generation() != generation);
    // What else the slot held is gone.
    CHECK(c->subdomain() == 0);
    CHECK(!c->has_subfacet());
    CHECK(c->subsegment_edges() == 0);
  }
  CHECK(again);
  for (const Cell_handle m : made) tds.delete_cell(m);
}

TEST_CASE("The star inherits subdomain, subfacets and subsegments from the cavity", "[mesh]") {
  Tr tr;
  insert(tr, random_points(300, 12));
  Seeded_random random(13);
  // Marks at random, each the same from both sides of a facet and all around an edge.
  for (auto c = tr.all_cells_begin(); c != tr.all_cells_end(); ++c)
    c->set_subdomain(static_cast<std::int32_t>(random.below(5)));
  std::uint32_t next = 0;
  for (auto f = tr.finite_facets_begin(); f != tr.finite_facets_end(); ++f) {
    if (random.below(3) != 0) continue;
    const Cell_handle n = f->first->neighbor(f->second);
    f->first->set_subfacet(f->second, next);
    n->set_subfacet(n->index(f->first), next++);
  }
  for (auto e = tr.finite_edges_begin(); e != tr.finite_edges_end(); ++e) {
    if (random.below(3) != 0) continue;
    const Vertex_handle u = e->first->vertex(e->second), w = e->first->vertex(e->third);
    auto around = tr.incident_cells(*e);
    const auto done = around;
    do {
      const auto bit = pgdr::edge_bit(around->index(u), around->index(w));
      Cell_handle(around)->set_subsegment_edges(static_cast<std::uint8_t>(around->subsegment_edges() | bit));
    } while (++around != done);
  }

  struct Inherited {
    std::int32_t subdomain;
    std::uint32_t subfacet;
    std::vector<std::array<Vertex_handle, 2>> edges;
  };
  const auto edges_without = [](Cell_handle c, int omitted) {
    std::vector<std::array<Vertex_handle, 2>> edges;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        if (i != j && i != omitted && j != omitted && c->vertex(i) < c->vertex(j) &&
            (c->subsegment_edges() & pgdr::edge_bit(i, j)))
          edges.push_back({c->vertex(i), c->vertex(j)});
    std::sort(edges.begin(), edges.end());
    return edges;
  };
  const auto triangle = [](Cell_handle c, int i) {
    std::array<Vertex_handle, 3> t{c->vertex((i + 1) % 4), c->vertex((i + 2) % 4), c->vertex((i + 3) % 4)};
    std::sort(t.begin(), t.end());
    return t;
  };

  pgdr::Cavity_3<Tr> cavity(tr);
  std::size_t facets = 0, edges = 0;
  for (const Point& p : random_points(200, 14)) {
    REQUIRE(cavity.find(p, tr.locate(p)));
    std::map<std::array<Vertex_handle, 3>, Inherited> expected;
    for (const auto& [c, i] : cavity.boundary())
      expected[triangle(c, i)] = {c->subdomain(), c->subfacet(i), edges_without(c, i)};
    const Vertex_handle v = cavity.commit(p);
    REQUIRE(cavity.star().size() == expected.size());
    for (std::size_t k = 0; k < cavity.star().size(); ++k) {
      const Cell_handle c = cavity.star()[k];
      const int apex = cavity.apex(k);
      REQUIRE(c->vertex(apex) == v);
      REQUIRE(expected.count(triangle(c, apex)) == 1);
      const Inherited& e = expected[triangle(c, apex)];
      CHECK(c->subdomain() == e.subdomain);
      CHECK(c->subfacet(apex) == e.subfacet);
      CHECK(c->neighbor(apex)->subfacet(c->neighbor(apex)->index(c)) == e.subfacet);
      CHECK(edges_without(c, apex) == e.edges);
      CHECK((c->subsegment_edges() & pgdr::edges_at(apex)) == 0);
      for (int i = 0; i < 4; ++i) CHECK((i == apex || c->subfacet(i) == Tr::Cell::no_subfacet));
      facets += e.subfacet != Tr::Cell::no_subfacet;
      edges += e.edges.size();
    }
  }
  CHECK(facets > 100);
  CHECK(edges > 100);
}

TEST_CASE("The bits of a cell's edges are distinct and belong to their ends", "[mesh]") {
  int all = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      CHECK(pgdr::edge_bit(i, j) == pgdr::edge_bit(j, i));
      CHECK((all & pgdr::edge_bit(i, j)) == 0);
      all |= pgdr::edge_bit(i, j);
      for (int k = 0; k < 4; ++k)
        CHECK(((pgdr::edges_at(k) & pgdr::edge_bit(i, j)) != 0) == (k == i || k == j));
    }
  CHECK(all == 63);
}
