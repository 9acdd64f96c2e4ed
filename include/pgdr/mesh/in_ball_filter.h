// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_IN_BALL_FILTER_H
#define PGDR_MESH_IN_BALL_FILTER_H

#include <array>
#include <cmath>
#include <limits>

#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// Filters of the in-ball predicates, in floating point: 1 certainly inside, -1 certainly outside, 0 too close to tell.
///
/// They look from a corner, where CGAL's look from the query point. From far away an element loses its volume to rounding once
/// the distance is 10⁵ of its edges, and it takes exact numbers to tell that what is far is outside; from its corner
/// the volume is as good as the edges are.
///
/// The bounds: with unit roundoff e every difference of coordinates is off by e of it, and each product below, of at most seven
/// of them and summed with eight others, by 17 e of its absolute value (Higham, *Accuracy and stability of numerical algorithms*,
/// section 3.1); in a directed rounding mode by twice that.
template <class T>
class In_ball_filter {
 public:
  using Vector = std::array<T, 3>;

  /// The circumball of a positive tetrahedron: the sign of |w|² det(u, v, s) - w·x, x = |u|² v×s + |v|² s×u + |s|² u×v.
  static int side(const Vec_3& a, const Vec_3& b, const Vec_3& c, const Vec_3& d, const Vec_3& p) {
    const Vector u = minus(b, a), v = minus(c, a), s = minus(d, a), w = minus(p, a);
    const Vector vs = cross(v, s);
    const T value = dot(w, w) * dot(u, vs) - (dot(u, u) * dot(w, vs) + dot(v, v) * dot(w, cross(s, u)) + dot(s, s) * dot(w, cross(u, v)));
    const T u1 = norm(u), v1 = norm(v), s1 = norm(s), w1 = norm(w);
    return side(value, u1 * v1 * s1 * w1 * (w1 + u1 + v1 + s1));
  }

  /// The equatorial ball of a triangle: the sign of |w|² n² - w·x, n = u×v, x = (|u|² v - |v|² u)×n.
  static int side(const Vec_3& a, const Vec_3& b, const Vec_3& c, const Vec_3& p) {
    const Vector u = minus(b, a), v = minus(c, a), w = minus(p, a);
    const Vector n = cross(u, v);
    const T value = dot(w, w) * dot(n, n) - (dot(u, u) * dot(w, cross(v, n)) + dot(v, v) * dot(w, cross(n, u)));
    const T u1 = norm(u), v1 = norm(v), w1 = norm(w), uv = u1 * v1;
    // Here n is off by what is no part of itself.
    return side(value, uv * w1 * ((norm(n) + relative_error * uv) * w1 + uv * (u1 + v1)));
  }

 private:
  static constexpr T relative_error = 32 * std::numeric_limits<T>::epsilon();
  static constexpr T smallest = std::numeric_limits<double>::min() * 0x1p60;  ///< below this products may have lost bits to underflow

  static Vector minus(const Vec_3& a, const Vec_3& b) { return {T(a.x) - T(b.x), T(a.y) - T(b.y), T(a.z) - T(b.z)}; }
  static Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static T dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static T norm(const Vector& a) { return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]); }

  static int side(T value, T scale) {
    const T bound = relative_error * scale;
    if (!(bound > smallest)) return 0;
    return value > bound ? -1 : value < -bound ? 1 : 0;
  }
};

/// Whether `long double` has the precision that it claims; under Valgrind, for instance, it is computed as a double.
inline const bool has_extended_precision = [] {
  constexpr long double step = std::numeric_limits<long double>::epsilon();
  volatile long double one = 1;
  const volatile long double next = one + step;
  return std::numeric_limits<long double>::digits > std::numeric_limits<double>::digits && next - one == step;
}();

/// `In_ball_filter::side` in doubles and, where they do not tell, in what is longer if there is anything: tetrahedra between the
/// vertices of a plane facet are flat but for rounding.
template <class... Points>
int side_of_ball(const Points&... points) {
  const int side = In_ball_filter<double>::side(points...);
  return side == 0 && has_extended_precision ? In_ball_filter<long double>::side(points...) : side;
}

}  // namespace pgdr

#endif
