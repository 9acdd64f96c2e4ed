// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_QUALITY_MEASURES_H
#define PGDR_QUALITY_MEASURES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>

#include <pgdr/domain/exact_ring.h>

namespace pgdr {

namespace quality_detail {

using P = std::array<double, 3>;

/// Relative error up to which a value from double arithmetic is taken; anything worse is computed again
/// exactly.
constexpr double accepted_error = 1e-11;
/// Rounding error of the formulas below over the sum of the magnitudes of their terms (a generous bound).
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

template <class T>
using Vector = std::array<T, 3>;

template <class T>
Vector<T> difference(const P& p, const P& q) {
  return {T(p[0]) - T(q[0]), T(p[1]) - T(q[1]), T(p[2]) - T(q[2])};
}

template <class T>
Vector<T> cross(const Vector<T>& u, const Vector<T>& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

template <class T>
T dot(const Vector<T>& u, const Vector<T>& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// `cross` with every minus a plus, of magnitudes: the scale of its rounding error.
inline Vector<double> cross_magnitude(const Vector<double>& u, const Vector<double>& v) {
  const Vector<double> a{std::abs(u[0]), std::abs(u[1]), std::abs(u[2])};
  const Vector<double> b{std::abs(v[0]), std::abs(v[1]), std::abs(v[2])};
  return {a[1] * b[2] + a[2] * b[1], a[2] * b[0] + a[0] * b[2], a[0] * b[1] + a[1] * b[0]};
}

template <class T>
T determinant(const P& a, const P& b, const P& c, const P& d) {
  return dot(difference<T>(b, a), cross(difference<T>(c, a), difference<T>(d, a)));
}

/// Twice the determinant times the vector from `a` to the circumcenter.
template <class T>
Vector<T> center_numerator(const Vector<T>& u, const Vector<T>& v, const Vector<T>& w) {
  const T uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  const Vector<T> vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  Vector<T> n;
  for (std::size_t i = 0; i < 3; ++i) n[i] = uu * vw[i] + vv * wu[i] + ww * uv[i];
  return n;
}

inline double exact_squared_circumradius(const P& a, const P& b, const P& c, const P& d) {
  const Exact_ring det = determinant<Exact_ring>(a, b, c, d);
  if (CGAL::is_zero(det)) return std::numeric_limits<double>::infinity();
  const auto n = center_numerator(difference<Exact_ring>(b, a), difference<Exact_ring>(c, a), difference<Exact_ring>(d, a));
  const double twice = 2 * CGAL::to_double(det);
  double squared = 0;
  for (const Exact_ring& x : n) {
    const double offset = CGAL::to_double(x) / twice;
    squared += offset * offset;
  }
  constexpr double least = 1e-150;  // far from where doubles are denormal
  if (std::abs(twice) > least && std::isfinite(squared)) return squared;
  using Q = CGAL::Exact_rational;
  const Q exact = determinant<Q>(a, b, c, d);
  const auto m = center_numerator(difference<Q>(b, a), difference<Q>(c, a), difference<Q>(d, a));
  return CGAL::to_double(Q(dot(m, m) / (Q(4) * exact * exact)));
}

}  // namespace quality_detail

/// Six times the signed volume, det(b-a, c-a, d-a), with a relative error below 1e-10 and the right sign, 0
/// included.
inline double orientation_determinant(const std::array<double, 3>& a, const std::array<double, 3>& b,
                                      const std::array<double, 3>& c, const std::array<double, 3>& d) {
  namespace q = quality_detail;
  const auto u = q::difference<double>(b, a), v = q::difference<double>(c, a),
             w = q::difference<double>(d, a);
  const auto vw = q::cross(v, w), magnitude = q::cross_magnitude(v, w);
  const double det = q::dot(u, vw);
  const double scale =
      std::abs(u[0]) * magnitude[0] + std::abs(u[1]) * magnitude[1] + std::abs(u[2]) * magnitude[2];
  if (q::rounding * scale <= q::accepted_error * std::abs(det)) return det;
  return CGAL::to_double(q::determinant<Exact_ring>(a, b, c, d));
}

/// Volume of the tetrahedron, positive when det(b-a, c-a, d-a) is; exact fallback as in
/// `orientation_determinant`.
inline double signed_volume(const std::array<double, 3>& a, const std::array<double, 3>& b,
                            const std::array<double, 3>& c, const std::array<double, 3>& d) {
  return orientation_determinant(a, b, c, d) / 6;
}

/// Square of the circumradius; infinity when the four points are coplanar. Relative error below 1e-10: where
/// cancellation in double arithmetic could cost more, it is computed with exact numbers.
inline double squared_circumradius(const std::array<double, 3>& a, const std::array<double, 3>& b,
                                   const std::array<double, 3>& c, const std::array<double, 3>& d) {
  namespace q = quality_detail;
  const auto u = q::difference<double>(b, a), v = q::difference<double>(c, a),
             w = q::difference<double>(d, a);
  const double uu = q::dot(u, u), vv = q::dot(v, v), ww = q::dot(w, w);
  const auto vw = q::cross(v, w), wu = q::cross(w, u), uv = q::cross(u, v);
  const auto vw_m = q::cross_magnitude(v, w), wu_m = q::cross_magnitude(w, u),
             uv_m = q::cross_magnitude(u, v);
  const double det = q::dot(u, vw);
  double det_scale = 0, squared = 0, scale = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    det_scale += std::abs(u[i]) * vw_m[i];
    const double n = uu * vw[i] + vv * wu[i] + ww * uv[i];
    squared += n * n;
    scale += uu * vw_m[i] + vv * wu_m[i] + ww * uv_m[i];
  }
  if (q::rounding * det_scale <= q::accepted_error * std::abs(det) &&
      q::rounding * scale <= q::accepted_error * std::sqrt(squared))
    return squared / (4 * det * det);
  return q::exact_squared_circumradius(a, b, c, d);
}

inline double squared_distance(const std::array<double, 3>& p, const std::array<double, 3>& q) {
  const auto u = quality_detail::difference<double>(p, q);
  return quality_detail::dot(u, u);
}

inline double squared_shortest_edge(const std::array<double, 3>& a, const std::array<double, 3>& b,
                                    const std::array<double, 3>& c, const std::array<double, 3>& d) {
  return std::min({squared_distance(a, b), squared_distance(a, c), squared_distance(a, d),
                   squared_distance(b, c), squared_distance(b, d), squared_distance(c, d)});
}

/// Length of the shortest of the six edges.
inline double shortest_edge(const std::array<double, 3>& a, const std::array<double, 3>& b,
                            const std::array<double, 3>& c, const std::array<double, 3>& d) {
  return std::sqrt(squared_shortest_edge(a, b, c, d));
}

/// Circumradius over shortest edge: sqrt(6)/4 for the regular tetrahedron, infinity for coplanar points.
inline double radius_edge_ratio(const std::array<double, 3>& a, const std::array<double, 3>& b,
                                const std::array<double, 3>& c, const std::array<double, 3>& d) {
  return std::sqrt(squared_circumradius(a, b, c, d) / squared_shortest_edge(a, b, c, d));
}

/// The dihedral angles at the edges ab, ac, ad, bc, bd, cd, in degrees from 0 to 180, whatever the
/// orientation.
inline std::array<double, 6> dihedral_angles_deg(const std::array<double, 3>& a,
                                                 const std::array<double, 3>& b,
                                                 const std::array<double, 3>& c,
                                                 const std::array<double, 3>& d) {
  namespace q = quality_detail;
  const auto u = q::difference<double>(b, a), v = q::difference<double>(c, a),
             w = q::difference<double>(d, a);
  const auto x = q::difference<double>(c, b), y = q::difference<double>(d, b),
             z = q::difference<double>(d, c);
  const auto abc = q::cross(u, v), abd = q::cross(u, w), acd = q::cross(v, w), bcd = q::cross(x, y);
  const double det = std::abs(orientation_determinant(a, b, c, d));
  // tan(angle at edge e) = |e| |det| / (product of the two face normals); it keeps its precision near 0 and
  // 180.
  const auto angle = [det](const q::Vector<double>& edge, double cosine) {
    constexpr double degrees = 57.295779513082320877;
    return degrees * std::atan2(std::sqrt(q::dot(edge, edge)) * det, cosine);
  };
  return {angle(u, q::dot(abc, abd)), angle(v, -q::dot(abc, acd)), angle(w, q::dot(abd, acd)),
          angle(x, q::dot(abc, bcd)), angle(y, -q::dot(abd, bcd)), angle(z, q::dot(acd, bcd))};
}

/// The smallest dihedral angle in degrees: about 70.53 for the regular tetrahedron, 0 for coplanar points.
inline double smallest_dihedral_angle_deg(const std::array<double, 3>& a, const std::array<double, 3>& b,
                                          const std::array<double, 3>& c, const std::array<double, 3>& d) {
  const auto angles = dihedral_angles_deg(a, b, c, d);
  return *std::min_element(angles.begin(), angles.end());
}

}  // namespace pgdr

#endif
