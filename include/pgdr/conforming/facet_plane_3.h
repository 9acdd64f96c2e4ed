// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_FACET_PLANE_3_H
#define PGDR_CONFORMING_FACET_PLANE_3_H

#include <algorithm>
#include <array>
#include <cmath>

#include <CGAL/enum.h>

#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// The reference plane of a facet, and the coordinate plane that it is projected to for exact 2D decisions.
class Facet_plane_3 {
 public:
  Facet_plane_3(const std::array<double, 3>& origin, const std::array<double, 3>& normal)
      : origin_(to_vec(origin)), normal_(to_vec(normal)) {
    for (int i = 1; i < 3; ++i)
      if (std::abs(normal_[i]) > std::abs(normal_[axis_])) axis_ = i;
    aligned_ = normal_[(axis_ + 1) % 3] == 0 && normal_[(axis_ + 2) % 3] == 0;
  }

  const Vec_3& normal() const { return normal_; }

  /// The foot of p's perpendicular; exact on axis-aligned planes, where the plane's coordinate is copied.
  Vec_3 project(const Vec_3& p) const {
    Vec_3 q = p;
    if (aligned_)
      q[axis_] = origin_[axis_];
    else
      q = p - dot(p - origin_, normal_) * normal_;
    return q;
  }

  /// Moves p along the dominant axis onto the plane: for `orientation` it stays where it is.
  Vec_3 project_along_axis(Vec_3 p) const {
    p[axis_] -= dot(p - origin_, normal_) / normal_[axis_];
    return p;
  }

  /// Moves m, a point of the plane, along the dominant axis onto a triangle that it is in as seen along that axis. What is
  /// interpolated is how far the corners are off the plane, which keeps rounding small.
  Vec_3 lift(Vec_3 m, const Vec_3& a, const Vec_3& b, const Vec_3& c) const {
    const int i = (axis_ + 1) % 3, j = (axis_ + 2) % 3;
    const auto offset = [this](const Vec_3& p) { return dot(p - origin_, normal_) / normal_[axis_]; };
    const auto area = [i, j](const Vec_3& u, const Vec_3& v) { return u[i] * v[j] - u[j] * v[i]; };
    const double at_a = offset(a), at_b = offset(b), at_c = offset(c), whole = area(b - a, c - a);
    if (whole == 0) return m;
    const double at_m = at_a + (area(m - a, c - a) * (at_b - at_a) + area(b - a, m - a) * (at_c - at_a)) / whole;
    m[axis_] += std::clamp(at_m, std::min({at_a, at_b, at_c}), std::max({at_a, at_b, at_c}));
    return m;
  }

  /// Sign of the area of (a, b, c) projected along the dominant axis, positive when counterclockwise about the
  /// normal. Exact.
  template <class K>
  CGAL::Orientation orientation(const typename K::Point_3& a, const typename K::Point_3& b,
                                const typename K::Point_3& c) const {
    const CGAL::Orientation o =
        typename K::Orientation_2()(flatten<K>(a), flatten<K>(b), flatten<K>(c));
    return normal_[axis_] > 0 ? o : CGAL::opposite(o);
  }

 private:
  template <class K>
  typename K::Point_2 flatten(const typename K::Point_3& p) const {
    using Point_2 = typename K::Point_2;
    return axis_ == 0 ? Point_2(p.y(), p.z()) : axis_ == 1 ? Point_2(p.z(), p.x()) : Point_2(p.x(), p.y());
  }

  Vec_3 origin_, normal_;
  int axis_ = 0;
  bool aligned_ = false;
};

}  // namespace pgdr

#endif
