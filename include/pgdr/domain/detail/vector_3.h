// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_VECTOR_3_H
#define PGDR_DOMAIN_DETAIL_VECTOR_3_H

#include <array>
#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr::domain_detail {

/// Kernel in which the domain decides topology, whatever the kernel of its points.
using Work_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Work_point = Work_kernel::Point_3;
inline Vec_3 normalized(const Vec_3& a) {
  const double l = length(a);
  return l > 0 ? (1 / l) * a : a;
}

inline std::array<double, 3> to_array(const Vec_3& a) { return {a.x, a.y, a.z}; }

inline Work_point to_work_point(const Vec_3& p) { return {p.x, p.y, p.z}; }

/// Angle between two directions in degrees, accurate near 0 and 180 too.
inline double angle_deg(const Vec_3& a, const Vec_3& b) {
  return to_degrees(arc_tangent(length(cross(a, b)), dot(a, b)));
}

}  // namespace pgdr::domain_detail

#endif
