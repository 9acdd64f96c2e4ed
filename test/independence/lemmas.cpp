// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's lemmas 1 to 3 and corollary 1 (docs/theory.md, section 2), in numbers.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <CGAL/Delaunay_triangulation_3.h>

#include <pgdr/independence/delaunay_independence.h>

#include "catch.h"
#include "independence/random_triangulations.h"
#include "seeded_random.h"

using namespace pgdr_test;

namespace {

double circumradius(const Point& a, const Point& b, const Point& c, const Point& d) {
  return std::sqrt(CGAL::squared_distance(CGAL::circumcenter(a, b, c, d), a));
}

double circumradius(Delaunay::Cell_handle c) {
  return circumradius(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(),
                      c->vertex(3)->point());
}

/// Computed radii of tetrahedra that are not too flat are right to this, relatively.
constexpr double rounding = 1e-6;

bool is_flat(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double longest =
      std::max({CGAL::squared_distance(a, b), CGAL::squared_distance(a, c), CGAL::squared_distance(a, d),
                CGAL::squared_distance(b, c), CGAL::squared_distance(b, d), CGAL::squared_distance(c, d)});
  return std::abs(CGAL::volume(a, b, c, d)) < 1e-6 * longest * std::sqrt(longest);
}

bool is_flat(Delaunay::Cell_handle c) {
  return is_flat(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(), c->vertex(3)->point());
}

}  // namespace

TEST_CASE("Lemma 1: in the plane, between a disk and its reflection a triangle has no larger circumradius",
          "[independence]") {
  // An edge from (-1, 0) to (1, 0), a disk through its ends with the center at height t, the reflected disk, and a point
  // above the edge that is in the disk, but not in the reflected one.
  Seeded_random random(3);
  std::size_t inside = 0;
  for (int k = 0; k < 100000; ++k) {
    const double t = random.between(-3, 3), r = std::hypot(1, t);
    const double x = random.between(-5, 5), y = random.between(1e-3, 6);
    if (std::hypot(x, y - t) >= r || std::hypot(x, y + t) < r) continue;
    ++inside;
    const double height =
        (x * x + y * y - 1) / (2 * y);  // of the center of the circle through the three points
    REQUIRE(std::hypot(1, height) <= r * (1 + 1e-12));
  }
  CHECK(inside > 5000);
}

TEST_CASE("Lemma 2: outside the reflected ball a tetrahedron has no larger circumradius", "[independence]") {
  Seeded_random random(4);
  std::size_t inside = 0, larger_outside_of_both = 0;
  while (inside < 20000) {
    const Point a = random_point(Arrangement::random, random), b = random_point(Arrangement::random, random),
                c = random_point(Arrangement::random, random), m = random_point(Arrangement::random, random);
    if (is_flat(a, b, c, m)) continue;
    const Point center = CGAL::circumcenter(a, b, c, m);
    const Kernel::Plane_3 plane(a, b, c);
    const Point reflected = center + 2 * (plane.projection(center) - center);
    const double r = circumradius(a, b, c, m);
    const Point p(random.between(-3, 3), random.between(-3, 3), random.between(-3, 3));
    if (is_flat(a, b, c, p) || plane.oriented_side(p) != plane.oriented_side(m)) continue;
    const bool in_ball = CGAL::squared_distance(center, p) < r * r,
               in_reflected = CGAL::squared_distance(reflected, p) < r * r;
    if (in_ball && !in_reflected) {
      ++inside;
      REQUIRE(circumradius(a, b, c, p) <= r * (1 + rounding));
    } else if (!in_ball && !in_reflected) {
      larger_outside_of_both += circumradius(a, b, c, p) > r;
    }
  }
  CHECK(larger_outside_of_both > 1000);  // so that the condition is of use
}

TEST_CASE("Lemma 3: no tetrahedron of a star is larger than both that met at its triangle",
          "[independence]") {
  Seeded_random random(5);
  for (const Arrangement arrangement : arrangements) {
    std::size_t triangles = 0, larger_than_inner = 0, larger_than_outer = 0;
    for (int k = 0; k < 100; ++k) {
      const Delaunay t = random_triangulation(arrangement, random);
      for (int n = 0; n < 20; ++n) {
        const auto [p, unused] = random_pair(arrangement, random);
        (void)unused;
        if (is_vertex(t, p)) continue;
        const Cavity cavity(t, p);
        for (const auto& [c, i] : cavity.boundary) {
          const Delaunay::Cell_handle beyond = c->neighbor(i);
          if (t.is_infinite(c) || t.is_infinite(beyond) || is_flat(c) || is_flat(beyond)) continue;
          const Point& u = c->vertex((i + 1) & 3)->point();
          const Point& v = c->vertex((i + 2) & 3)->point();
          const Point& w = c->vertex((i + 3) & 3)->point();
          if (is_flat(u, v, w, p)) continue;
          const double r = circumradius(u, v, w, p), inner = circumradius(c), outer = circumradius(beyond);
          CAPTURE(name(arrangement), p, r, inner, outer);
          REQUIRE(r <= std::max(inner, outer) * (1 + rounding));
          ++triangles;
          larger_than_inner += r > inner * (1 + rounding);
          larger_than_outer += r > outer * (1 + rounding);
        }
      }
    }
    CAPTURE(name(arrangement), triangles, larger_than_inner, larger_than_outer);
    if (arrangement == Arrangement::random) {
      CHECK(triangles > 10000);
      CHECK(larger_than_inner > 100);  // the one inside alone would not do
      CHECK(larger_than_outer > 100);
    }
  }
}

TEST_CASE("Corollary 1: disjoint cavities without a common triangle are enough", "[independence]") {
  Seeded_random random(6);
  std::size_t apart = 0, sharing = 0;
  for (const Arrangement arrangement : arrangements)
    for (int k = 0; k < 100; ++k) {
      const Delaunay t = random_triangulation(arrangement, random);
      for (int n = 0; n < 20; ++n) {
        const auto [p, q] = random_pair(arrangement, random);
        if (p == q || is_vertex(t, p) || is_vertex(t, q)) continue;
        const Cavity at_p(t, p), at_q(t, q);
        if (at_p.meets(at_q)) continue;
        if (at_p.shares_triangle(at_q)) {
          ++sharing;
          continue;
        }
        CAPTURE(name(arrangement), p, q);
        REQUIRE(pgdr::are_delaunay_independent(t, p, q));
        ++apart;
      }
    }
  CHECK(apart > 2000);
  CHECK(sharing > 500);
}
