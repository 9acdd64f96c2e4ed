// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_FACET_PLANE_3_H
#define PGDR_CONFORMING_FACET_PLANE_3_H

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
