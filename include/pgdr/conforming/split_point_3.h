// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_SPLIT_POINT_3_H
#define PGDR_CONFORMING_SPLIT_POINT_3_H

#include <algorithm>
#include <array>
#include <cmath>

#include <pgdr/conforming/facet_plane_3.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// Where a subsegment (a, b) is split. Next to an acute corner the distance from that corner is a power of two
/// (concentric shells: Ruppert 1995, section "Small angles in the input"), so that subsegments of one corner end
/// at equal distances and stop encroaching each other; with two acute corners, or none, it is the midpoint.
inline Vec_3 subsegment_split_point(const Vec_3& a, const Vec_3& b, bool acute_at_a, bool acute_at_b,
                                    double smallest_shell = 0) {
  if (acute_at_a == acute_at_b) {
    Vec_3 m = 0.5 * (a + b);
    return m;
  }
  const Vec_3& corner = acute_at_a ? a : b;
  const Vec_3& other = acute_at_a ? b : a;
  const double len = length(other - corner);
  // The power of two in (len/3, 2 len/3].
  const double shell = std::max(smallest_shell, std::exp2(std::floor(std::log2(2.0 / 3.0 * len))));
  Vec_3 m = corner + (shell / len) * (other - corner);
  for (int i = 0; i < 3; ++i)
    if (a[i] == b[i]) m[i] = a[i];
  return m;
}

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
