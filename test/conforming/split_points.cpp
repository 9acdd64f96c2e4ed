// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <pgdr/conforming/facet_plane_3.h>
#include <pgdr/conforming/split_point_3.h>
#include <pgdr/domain/default_kernel.h>
#include <pgdr/mesh/triangle_ball.h>

#include "catch.h"
#include "seeded_random.h"

using namespace pgdr_test;
using pgdr::Vec_3;

namespace {

Vec_3 random_vec(Random& random, double size = 1) {
  return {random.between(-size, size), random.between(-size, size), random.between(-size, size)};
}

bool equal(const Vec_3& a, const Vec_3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

}  // namespace

TEST_CASE("A subsegment at one acute corner is split on a shell whose radius is a power of two",
          "[conforming]") {
  Seeded_random random(1);
  for (int k = 0; k < 2000; ++k) {
    const double size = std::pow(10, random.between(-6, 9));
    const Vec_3 a = random_vec(random, size), b = random_vec(random, size);
    CAPTURE(k, size);
    for (const bool at_a : {true, false}) {
      const Vec_3 m = pgdr::subsegment_split_point(a, b, at_a, !at_a);
      const double length = pgdr::length(b - a), radius = pgdr::length(m - (at_a ? a : b));
      CHECK(radius > length / 3 * (1 - 1e-12));
      CHECK(radius <= length * 2 / 3 * (1 + 1e-12));
      const double exponent = std::log2(radius);
      CHECK(std::abs(exponent - std::round(exponent)) < 1e-9);
      CHECK(pgdr::length(pgdr::cross(m - a, b - a)) <= 1e-12 * length * length);
      // The same point from either end.
      CHECK(equal(m, pgdr::subsegment_split_point(b, a, !at_a, at_a)));
    }
  }
}

TEST_CASE("Segments of one acute corner are split at equal distances from it", "[conforming]") {
  Seeded_random random(2);
  const Vec_3 corner{1, 2, 3};
  double first = 0;
  for (int k = 0; k < 100; ++k) {
    Vec_3 d = random_vec(random);
    d = (random.between(1.6, 2.9) / pgdr::length(d)) * d;  // shell 1 for lengths of 1.5 to 3
    const double radius =
        pgdr::length(pgdr::subsegment_split_point(corner, corner + d, true, false) - corner);
    if (k == 0) first = radius;
    CHECK(radius == Approx(first).epsilon(1e-12));
  }
  CHECK(first == Approx(1));
}

TEST_CASE("A segment's factor moves all of its shells but the smallest one", "[conforming]") {
  const Vec_3 corner{1, 2, 3}, end{1, 2, 5};
  const auto shell = [&](double smallest, double factor) { return pgdr::length(pgdr::subsegment_split_point(corner, end, true, false, smallest, factor) - corner); };
  CHECK(shell(0.25, 1 - 1e-7) == Approx(1 - 1e-7).epsilon(1e-12));
  CHECK(shell(1, 1 - 1e-7) == Approx(1).epsilon(1e-12));
}

TEST_CASE("Other subsegments are split at their midpoints", "[conforming]") {
  const Vec_3 a{1, 2, 3}, b{4, 0, -5};
  const Vec_3 m{2.5, 1, -1};
  CHECK(equal(pgdr::subsegment_split_point(a, b, false, false), m));
  CHECK(equal(pgdr::subsegment_split_point(a, b, true, true), m));
}

TEST_CASE("The split point keeps the coordinates that both ends share", "[conforming]") {
  Seeded_random random(3);
  for (int k = 0; k < 1000; ++k) {
    CAPTURE(k);
    const Vec_3 a = random_vec(random, 1e5);
    Vec_3 b = random_vec(random, 1e5);
    const int axis = k % 3;
    b[axis] = a[axis];
    for (const bool acute : {false, true})
      CHECK(pgdr::subsegment_split_point(a, b, acute, false)[axis] == a[axis]);
  }
}

TEST_CASE("The circumcenter is that of the triangle and does not depend on the order of its vertices",
          "[conforming]") {
  Seeded_random random(4);
  for (int k = 0; k < 1000; ++k) {
    CAPTURE(k);
    const Vec_3 p[3] = {random_vec(random), random_vec(random), random_vec(random)};
    const Vec_3 n = pgdr::cross(p[1] - p[0], p[2] - p[0]);
    if (pgdr::length(n) < 1e-2) continue;
    const Vec_3 center = pgdr::triangle_circumcenter(p[0], p[1], p[2]);
    const double radius = pgdr::triangle_circumradius(p[0], p[1], p[2]);
    for (const Vec_3& q : p) CHECK(pgdr::length(q - center) == Approx(radius).epsilon(1e-9));
    CHECK(std::abs(pgdr::dot(center - p[0], n)) <= 1e-9 * radius);
    for (const auto& [i, j, l] : {std::array<int, 3>{0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}})
      CHECK(equal(pgdr::triangle_circumcenter(p[i], p[j], p[l]), center));
  }
}

TEST_CASE("Points are projected to axis-aligned facets exactly", "[conforming]") {
  Seeded_random random(5);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      for (int k = 0; k < 100; ++k) {
        CAPTURE(axis, sign, k);
        const Vec_3 origin = random_vec(random, 1e3), p = random_vec(random, 1e3);
        std::array<double, 3> normal{};
        normal[static_cast<std::size_t>(axis)] = sign;
        const pgdr::Facet_plane_3 plane({origin.x, origin.y, origin.z}, normal);
        const Vec_3 q = plane.project(p);
        CHECK(q[axis] == origin[axis]);
        CHECK(q[(axis + 1) % 3] == p[(axis + 1) % 3]);
        CHECK(q[(axis + 2) % 3] == p[(axis + 2) % 3]);
      }
}

TEST_CASE("A projected point is the foot of the perpendicular", "[conforming]") {
  Seeded_random random(6);
  for (int k = 0; k < 500; ++k) {
    CAPTURE(k);
    const Vec_3 origin = random_vec(random), p = random_vec(random);
    Vec_3 n = random_vec(random);
    n = (1 / pgdr::length(n)) * n;
    const pgdr::Facet_plane_3 plane({origin.x, origin.y, origin.z}, {n.x, n.y, n.z});
    const Vec_3 q = plane.project(p);
    CHECK(std::abs(pgdr::dot(q - origin, n)) < 1e-14);
    CHECK(pgdr::length(pgdr::cross(p - q, n)) < 1e-14);
  }
}

TEST_CASE("A point is lifted along the dominant axis, onto a triangle off the plane", "[conforming]") {
  Seeded_random random(8);
  for (int k = 0; k < 1000; ++k) {
    CAPTURE(k);
    Vec_3 normal = random_vec(random);
    normal = (1 / pgdr::length(normal)) * normal;
    const Vec_3 origin = random_vec(random);
    const pgdr::Facet_plane_3 plane({origin.x, origin.y, origin.z}, {normal.x, normal.y, normal.z});
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    const auto corner = [&] { return plane.project(random_vec(random)) + random.between(-1e-3, 1e-3) * normal; };
    const Vec_3 a = corner(), b = corner(), c = corner();
    const Vec_3 n = pgdr::cross(b - a, c - a);
    if (pgdr::length(n) < 0.1) continue;
    const Vec_3 m = plane.project(0.3 * a + 0.3 * b + 0.4 * c), lifted = plane.lift(m, a, b, c);
    CHECK(std::abs(pgdr::dot(lifted - a, n)) < 1e-13);
    for (int i = 0; i < 3; ++i)
      if (i != axis) CHECK(lifted[i] == m[i]);
  }
}

TEST_CASE("Orientations in a facet are counterclockwise about its normal", "[conforming]") {
  using K = pgdr::Default_kernel;
  Seeded_random random(7);
  int positive = 0;
  for (int k = 0; k < 500; ++k) {
    CAPTURE(k);
    Vec_3 n = random_vec(random);
    if (k < 6) {
      n = {0, 0, 0};
      n[k / 2] = k % 2 ? 1 : -1;
    }
    n = (1 / pgdr::length(n)) * n;
    const pgdr::Facet_plane_3 plane({0, 0, 0}, {n.x, n.y, n.z});
    Vec_3 p[3];
    for (Vec_3& q : p) q = plane.project(random_vec(random));
    const double area = pgdr::dot(pgdr::cross(p[1] - p[0], p[2] - p[0]), n);
    if (std::abs(area) < 1e-6) continue;
    const auto point = [](const Vec_3& v) { return K::Point_3(v.x, v.y, v.z); };
    const auto o = plane.orientation<K>(point(p[0]), point(p[1]), point(p[2]));
    CHECK(o == (area > 0 ? CGAL::POSITIVE : CGAL::NEGATIVE));
    CHECK(plane.orientation<K>(point(p[1]), point(p[0]), point(p[2])) == CGAL::opposite(o));
    CHECK(plane.orientation<K>(point(p[0]), point(p[1]), point(0.5 * (p[0] + p[0]))) == CGAL::ZERO);
    positive += area > 0;
  }
  CHECK(positive > 100);
}
