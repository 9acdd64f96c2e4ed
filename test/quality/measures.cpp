// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/quality/measures.h>
#include <pgdr/quality/shape_measures.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "catch.h"

namespace {

using P = std::array<double, 3>;

const std::array<P, 4> regular_corners{P{1, 1, 1}, P{-1, 1, -1}, P{1, -1, -1}, P{-1, -1, 1}};  // edges 2 sqrt(2)

TEST_CASE("The regular tetrahedron has its closed-form measures", "[quality]") {
  const auto& [a, b, c, d] = regular_corners;
  REQUIRE(pgdr::signed_volume(a, b, c, d) == Approx(8.0 / 3));
  REQUIRE(pgdr::signed_volume(b, a, c, d) == Approx(-8.0 / 3));
  REQUIRE(pgdr::squared_circumradius(a, b, c, d) == Approx(3));
  REQUIRE(pgdr::shortest_edge(a, b, c, d) == Approx(std::sqrt(8.0)));
  REQUIRE(pgdr::radius_edge_ratio(a, b, c, d) == Approx(std::sqrt(6.0) / 4));
  for (const double angle : pgdr::dihedral_angles_deg(a, b, c, d))
    REQUIRE(angle == Approx(std::acos(1.0 / 3) * 180 / std::acos(-1.0)));
}

TEST_CASE("The corner of a cube has its closed-form measures", "[quality]") {
  const P o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  REQUIRE(pgdr::signed_volume(o, x, y, z) == Approx(1.0 / 6));
  REQUIRE(pgdr::squared_circumradius(o, x, y, z) == Approx(0.75));
  const auto angles = pgdr::dihedral_angles_deg(o, x, y, z);
  const double oblique = std::atan(std::sqrt(2.0)) * 180 / std::acos(-1.0);
  for (std::size_t i = 0; i < 3; ++i) REQUIRE(angles[i] == Approx(90));
  for (std::size_t i = 3; i < 6; ++i) REQUIRE(angles[i] == Approx(oblique));
  REQUIRE(pgdr::smallest_dihedral_angle_deg(o, x, y, z) == Approx(oblique));
}

TEST_CASE("Verdict's measures have their closed forms", "[quality]") {
  const auto& [a, b, c, d] = regular_corners;
  const pgdr::Shape_measures regular = pgdr::shape_measures(a, b, c, d);
  for (const double one : {regular.edge_ratio, regular.aspect_ratio, regular.mean_ratio, regular.scaled_jacobian}) REQUIRE(one == Approx(1));

  std::array<P, 4> corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  do {  // whichever corner comes first
    const P &o = corner[order[0]], &x = corner[order[1]], &y = corner[order[2]], &z = corner[order[3]];
    const double sign = pgdr::signed_volume(o, x, y, z) > 0 ? 1 : -1;
    const pgdr::Shape_measures m = pgdr::shape_measures(o, x, y, z);
    REQUIRE(m.edge_ratio == Approx(std::sqrt(2.0)));
    if (sign > 0)
      REQUIRE(m.aspect_ratio == Approx((3 + std::sqrt(3.0)) / std::sqrt(12.0)));
    else
      REQUIRE(std::isinf(m.aspect_ratio));
    REQUIRE(m.mean_ratio == Approx(sign * 4 / 3.0 * std::pow(0.25, 1 / 3.0)));
    REQUIRE(m.scaled_jacobian == Approx(sign * std::sqrt(0.5)));
  } while (std::ranges::next_permutation(order).found);

  const P flat{1, 1, 0};
  const pgdr::Shape_measures none = pgdr::shape_measures(corner[0], corner[1], corner[2], flat);
  REQUIRE(std::isinf(none.aspect_ratio));
  REQUIRE((none.mean_ratio == 0 && none.scaled_jacobian == 0));
  REQUIRE(none.edge_ratio == Approx(std::sqrt(2.0)));
  const pgdr::Shape_measures point = pgdr::shape_measures(flat, flat, flat, flat);
  REQUIRE((std::isinf(point.edge_ratio) && std::isinf(point.aspect_ratio) && point.mean_ratio == 0 && point.scaled_jacobian == 0));
}

TEST_CASE("Slivers are measured exactly", "[quality]") {
  // A square with diagonal 2, two opposite corners lifted by h.
  for (const double h : {1e-3, 1e-8, 1e-15, 1e-21, 1e-100}) {
    const P p{1, 0, 0}, q{0, 1, h}, r{-1, 0, 0}, s{0, -1, h};
    CAPTURE(h);
    REQUIRE(pgdr::signed_volume(p, q, r, s) == Approx(2 * h / 3).epsilon(1e-12));
    REQUIRE(pgdr::squared_circumradius(p, q, r, s) == Approx(1 + h * h / 4).epsilon(1e-12));
    REQUIRE(pgdr::smallest_dihedral_angle_deg(p, q, r, s) ==
            Approx(std::atan(h * std::sqrt(2 + h * h)) * 180 / std::acos(-1.0)).epsilon(1e-9));
  }
  // The same far from the origin, with coordinates that are multiples of u.
  const double u = std::ldexp(1.0, -30);
  const P p{1000 + 3 * u, 2000, 7}, q{1000, 2000 + 5 * u, 7 + u}, r{1000 - 3 * u, 2000, 7},
      s{1000, 2000 - 5 * u, 7 + u};
  REQUIRE(pgdr::signed_volume(p, q, r, s) == 10 * u * u * u);
}

TEST_CASE("Flat tetrahedra have no volume and an infinite ratio", "[quality]") {
  const P p{0, 0, 0}, q{1, 0, 0}, r{0, 1, 0}, s{0.3, 0.4, 0};
  REQUIRE(pgdr::signed_volume(p, q, r, s) == 0);
  REQUIRE(std::isinf(pgdr::squared_circumradius(p, q, r, s)));
  REQUIRE(std::isinf(pgdr::radius_edge_ratio(p, q, r, s)));
  REQUIRE(pgdr::smallest_dihedral_angle_deg(p, q, r, s) == 0);
  // In the plane x = z, with coordinates that are no dyadic fractions.
  const P t{0.1, 0.1, 0.1}, v{0.7, 0.7, 0.7}, w{0.1, 0.3, 0.1}, x{0.7, 0.9, 0.7};
  REQUIRE(pgdr::signed_volume(t, v, w, x) == 0);
}

TEST_CASE("Measures agree with rational arithmetic on random tetrahedra, thin ones included", "[quality]") {
  std::mt19937_64 random(20240501);
  const auto uniform = [&] { return std::ldexp(double(random() >> 11), -53) - 0.5; };
  for (int i = 0; i < 3000; ++i) {
    const double flat = std::pow(10, -double(i % 18));
    std::array<P, 4> t;
    const P n{uniform(), uniform(), uniform()};
    for (P& p : t) {
      const double x = uniform(), y = uniform(), z = flat * uniform();
      p = {x + z * n[0], y + z * n[1], z * n[2] + 0.3 * x - 0.7 * y};
    }
    const auto& [p, q, r, s] = t;
    const double exact = pgdr::quality_detail::exact_squared_circumradius(p, q, r, s);
    const double det = CGAL::to_double(pgdr::quality_detail::determinant<CGAL::Exact_rational>(p, q, r, s));
    REQUIRE(pgdr::squared_circumradius(p, q, r, s) == Approx(exact).epsilon(1e-10));
    REQUIRE(pgdr::signed_volume(p, q, r, s) == Approx(det / 6).epsilon(1e-10));
  }
}

}  // namespace
