// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/conforming/encroachment_3.h>

#include <array>
#include <cstddef>
#include <random>

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <pgdr/domain/default_kernel.h>

#include "catch.h"

namespace {

using Point = pgdr::Default_kernel::Point_3;
using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;

struct Vertex {
  Point at;
  const Point& point() const { return at; }
};
struct Subsegment {
  std::array<const Vertex*, 2> vertices;
  int segment = 0;
};
struct Subfacet {
  std::array<const Vertex*, 3> vertices;
  int facet = 0;
};

Exact::Point_3 exact(const Point& p) { return {p.x(), p.y(), p.z()}; }

bool is_nearer(const Exact::Point_3& center, const Point& p, const Point& on_sphere) {
  return CGAL::squared_distance(center, exact(p)) < CGAL::squared_distance(center, exact(on_sphere));
}

}  // namespace

TEST_CASE("A point encroaches what it sees from inside of its smallest ball, on either side and but for its surface", "[conforming]") {
  std::mt19937 random(1);
  // On a coarse grid many points lie on the sphere.
  std::uniform_int_distribution<int> coordinate(0, 6);
  const auto point = [&] {
    const int x = coordinate(random), y = coordinate(random), z = coordinate(random);
    return Point(x, y, z);
  };
  std::array<std::size_t, 2> segments{}, facets{};
  for (int n = 0; n < 20000; ++n) {
    const Vertex a{point()}, b{point()}, c{point()};
    const Point p = point();
    if (a.at == b.at) continue;
    const bool in_ball = is_nearer(CGAL::midpoint(exact(a.at), exact(b.at)), p, a.at);
    CHECK(pgdr::is_encroached(Subsegment{{&a, &b}}, p) == in_ball);
    ++segments[in_ball];
    if (CGAL::collinear(a.at, b.at, c.at)) continue;
    const bool in_equatorial_ball = is_nearer(CGAL::circumcenter(exact(a.at), exact(b.at), exact(c.at)), p, a.at);
    CHECK(pgdr::is_encroached(Subfacet{{&a, &b, &c}}, p) == in_equatorial_ball);
    ++facets[in_equatorial_ball];
  }
  for (const auto& counts : {segments, facets})
    for (const std::size_t count : counts) CHECK(count > 1000);
}
