// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_TRIANGLE_BALL_H
#define PGDR_MESH_TRIANGLE_BALL_H

#include <array>
#include <utility>

#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// Circumcenter of the triangle (a, b, c), in its plane. Vertices are taken in lexicographic order, so that the
/// result does not depend on how the triangle is written.
inline Vec_3 triangle_circumcenter(Vec_3 a, Vec_3 b, Vec_3 c) {
  const auto less = [](const Vec_3& p, const Vec_3& q) {
    return std::array<double, 3>{p.x, p.y, p.z} < std::array<double, 3>{q.x, q.y, q.z};
  };
  if (less(b, a)) std::swap(a, b);
  if (less(c, b)) std::swap(b, c);
  if (less(b, a)) std::swap(a, b);
  const Vec_3 u = b - a, v = c - a, n = cross(u, v);
  const double d = 2 * squared_length(n);
  return a + (1 / d) * cross(squared_length(u) * v - squared_length(v) * u, n);
}

/// Radius of the smallest ball through the vertices of a triangle.
inline double triangle_circumradius(const Vec_3& a, const Vec_3& b, const Vec_3& c) {
  return length(triangle_circumcenter(a, b, c) - a);
}

}  // namespace pgdr

#endif
