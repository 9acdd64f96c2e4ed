// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_VEC_3_H
#define PGDR_DOMAIN_VEC_3_H

#include <array>
#include <cmath>

#include <CGAL/number_utils.h>

namespace pgdr {

/// Coordinates in double precision, for sizes and constructions; never for a decision about topology.
struct Vec_3 {
  double x = 0, y = 0, z = 0;

  double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  double& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  bool operator==(const Vec_3&) const = default;
  friend Vec_3 operator+(const Vec_3& a, const Vec_3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec_3 operator-(const Vec_3& a, const Vec_3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec_3 operator*(double s, const Vec_3& a) { return {s * a.x, s * a.y, s * a.z}; }
};

inline double dot(const Vec_3& a, const Vec_3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec_3 cross(const Vec_3& a, const Vec_3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double squared_length(const Vec_3& a) { return dot(a, a); }
inline double length(const Vec_3& a) { return std::sqrt(dot(a, a)); }
inline double squared_distance(const Vec_3& a, const Vec_3& b) { return squared_length(a - b); }
/// Of p and the line through a and b, two different points.
inline double squared_distance_to_line(const Vec_3& p, const Vec_3& a, const Vec_3& b) {
  return squared_length(cross(p - a, b - a)) / squared_distance(a, b);
}

/// The coordinates of a point of any kernel, rounded to double.
template <class Point_3>
Vec_3 to_vec(const Point_3& p) {
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}
inline Vec_3 to_vec(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

}  // namespace pgdr

#endif
