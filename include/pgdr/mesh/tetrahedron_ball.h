// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_TETRAHEDRON_BALL_H
#define PGDR_MESH_TETRAHEDRON_BALL_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <pgdr/domain/exact_ring.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// What the refinement asks of a tetrahedron.
struct Tetrahedron_ball {
  Vec_3 center;                 ///< of the circumball
  double squared_radius = 0;    ///< of the circumball
  double squared_shortest = 0;  ///< length of the shortest edge, squared
  double volume = 0;

  double squared_ratio() const { return squared_radius / squared_shortest; }  ///< radius over shortest edge, squared
};

using Tetrahedron_points = std::array<Vec_3, 4>;

inline double squared_shortest_edge(const Tetrahedron_points& p) {
  return std::min({squared_distance(p[0], p[1]), squared_distance(p[0], p[2]), squared_distance(p[0], p[3]),
                   squared_distance(p[1], p[2]), squared_distance(p[1], p[3]), squared_distance(p[2], p[3])});
}

/// Which corners are the ends of the shortest edge, of equal ones the first.
inline std::array<std::size_t, 2> shortest_edge(const Tetrahedron_points& p) {
  std::array<std::size_t, 2> ends{0, 1};
  double shortest = squared_distance(p[0], p[1]);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      if (const double d = squared_distance(p[i], p[j]); d < shortest) {
        shortest = d;
        ends = {i, j};
      }
  return ends;
}

namespace internal {

/// The ball by rational arithmetic, each figure rounded once.
inline Tetrahedron_ball rational_tetrahedron_ball(const Tetrahedron_points& p) {
  using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
  std::array<Exact::Point_3, 4> q;
  for (std::size_t i = 0; i < 4; ++i) q[i] = Exact::Point_3(p[i].x, p[i].y, p[i].z);
  Tetrahedron_ball b;
  b.squared_shortest = squared_shortest_edge(p);
  const auto volume = CGAL::volume(q[0], q[1], q[2], q[3]);
  b.volume = CGAL::to_double(volume);
  if (volume == 0) {
    b.squared_radius = std::numeric_limits<double>::infinity();
    return b;
  }
  const auto c = CGAL::circumcenter(q[0], q[1], q[2], q[3]);
  b.center = {CGAL::to_double(c.x()), CGAL::to_double(c.y()), CGAL::to_double(c.z())};
  b.squared_radius = CGAL::to_double(CGAL::squared_distance(c, q[0]));
  return b;
}

}  // namespace internal

/// The ball by exact determinants, off by a few roundings of their quotients; for cells so flat that doubles have no say.
[[gnu::noinline]] inline Tetrahedron_ball exact_tetrahedron_ball(const Tetrahedron_points& p) {
  using Exact = CGAL::Simple_cartesian<Exact_ring>;
  using Vector = Exact::Vector_3;
  std::array<Exact::Point_3, 4> q;
  for (std::size_t i = 0; i < 4; ++i) q[i] = Exact::Point_3(p[i].x, p[i].y, p[i].z);
  const Vector u = q[1] - q[0], v = q[2] - q[0], w = q[3] - q[0];
  const Vector vw = CGAL::cross_product(v, w), wu = CGAL::cross_product(w, u), uv = CGAL::cross_product(u, v);
  const auto determinant = u * vw;
  Tetrahedron_ball b;
  b.squared_shortest = squared_shortest_edge(p);
  if (CGAL::is_zero(determinant)) {
    b.squared_radius = std::numeric_limits<double>::infinity();
    return b;
  }
  const double det = CGAL::to_double(determinant);
  const Vector n = vw * u.squared_length() + wu * v.squared_length() + uv * w.squared_length();
  const Vec_3 numerator{CGAL::to_double(n.x()), CGAL::to_double(n.y()), CGAL::to_double(n.z())};
  // Twice the determinant times the radius, so not denormal either if the radius is not.
  constexpr double least = 1e-150;
  if (std::abs(det) > least && std::isfinite(squared_length(numerator))) {
    const Vec_3 offset = (0.5 / det) * numerator;
    b.center = p[0] + offset;
    b.squared_radius = squared_length(offset);
    b.volume = det / 6;
    return b;
  }
  return internal::rational_tetrahedron_ball(p);
}

/// Relative to the circumradius: how far center and radius of a `tetrahedron_ball` are off at most.
///
/// Below the threshold on the determinant the figures are exact but for one rounding. Above it, the rounding errors
/// of differences, products and determinant, a few dozen units of 2^-53, are amplified by at most
/// |u||v||w| / det <= 1e6.
constexpr double ball_error = 4e-8;

/// A tetrahedron (a, b, c, d) as what both its ball and its dihedral angles are computed from, once for those who ask for both.
///
/// Inlined by force: handing the points over in memory costs more than half of the arithmetic.
class Tetrahedron_frame {
 public:
  [[gnu::always_inline]] Tetrahedron_frame(const Vec_3& a, const Vec_3& b, const Vec_3& c, const Vec_3& d)
      : a_(a), b_(b), c_(c), d_(d), u_(b - a), v_(c - a), w_(d - a), vw_(cross(v_, w_)), wu_(cross(w_, u_)), uv_(cross(u_, v_)) {}
  [[gnu::always_inline]] explicit Tetrahedron_frame(const Tetrahedron_points& p) : Tetrahedron_frame(p[0], p[1], p[2], p[3]) {}

  /// Whether it is so flat that its ball takes rational arithmetic, hundreds of times as long.
  [[gnu::always_inline]] bool is_flat() const {
    const double det = dot(u_, vw_);
    // The determinant's rounding error is a few units of 1e-16 |u||v||w|.
    return det * det < 1e-12 * squared_length(u_) * squared_length(v_) * squared_length(w_);
  }

  /// Positive where the corners are in positive order; off by a few units of 1e-16 of the product of three edges, flat or not.
  double volume() const { return dot(u_, vw_) / 6; }

  /// Circumball, shortest edge and volume, all to about eight digits.
  [[gnu::always_inline]] Tetrahedron_ball ball() const {
    const double uu = squared_length(u_), vv = squared_length(v_), ww = squared_length(w_);
    const double det = dot(u_, vw_);
    if (is_flat()) [[unlikely]]
      return exact_tetrahedron_ball({a_, b_, c_, d_});
    const Vec_3 offset = (0.5 / det) * (uu * vw_ + vv * wu_ + ww * uv_);
    Tetrahedron_ball ball;
    ball.center = a_ + offset;
    ball.squared_radius = squared_length(offset);
    ball.squared_shortest =
        std::min({uu, vv, ww, squared_distance(b_, c_), squared_distance(b_, d_), squared_distance(c_, d_)});
    ball.volume = det / 6;
    return ball;
  }

  /// Cosine of the smallest of the six dihedral angles; 1 for a flat tetrahedron.
  [[gnu::always_inline]] double largest_dihedral_cosine() const {
    // Inward normals of the four facets of a positive tetrahedron, each opposite to one corner.
    const std::array<Vec_3, 4> n{cross(w_ - u_, v_ - u_), vw_, wu_, uv_};
    std::array<double, 4> inverse;
    for (std::size_t i = 0; i < 4; ++i) {
      const double squared = squared_length(n[i]);
      if (!(squared > 0)) return 1;
      inverse[i] = 1 / squared;
    }
    double worst = -1;  // squared, with its sign: one root is enough
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double d = -dot(n[i], n[j]);
        worst = std::max(worst, d * std::abs(d) * inverse[i] * inverse[j]);
      }
    return worst > 0 ? std::sqrt(worst) : -std::sqrt(-worst);
  }

 private:
  Vec_3 a_, b_, c_, d_;
  Vec_3 u_, v_, w_;
  Vec_3 vw_, wu_, uv_;
};

[[gnu::always_inline]] inline Tetrahedron_ball tetrahedron_ball(const Vec_3& a, const Vec_3& b, const Vec_3& c, const Vec_3& d) {
  return Tetrahedron_frame(a, b, c, d).ball();
}

inline Tetrahedron_ball tetrahedron_ball(const Tetrahedron_points& p) { return Tetrahedron_frame(p).ball(); }

inline double largest_dihedral_cosine(const Tetrahedron_points& p) { return Tetrahedron_frame(p).largest_dihedral_cosine(); }

}  // namespace pgdr

#endif
