// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_SMALL_ANGLES_3_H
#define PGDR_DOMAIN_SMALL_ANGLES_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/detail/facet_edges.h>
#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/detail/vertex_angle.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/parallel/parallel_for.h>

namespace pgdr {

/// Where features of a domain meet at small angles; all angles in degrees.
struct Small_angles {
  /// Plane angle asin(1/4) below which no triangle at the corner can have radius-edge ratio 2 or less.
  static constexpr double critical_plane_angle_deg = 14.477512185929923;

  /// Per vertex, the smallest angle between two segments there, or between a segment and a facet
  /// that it does not belong to; 180 if none.
  std::vector<double> vertex_deg;
  /// Per segment, the smallest dihedral angle between two sheets there (a facet around an internal
  /// segment has two); 180 if fewer than two.
  std::vector<double> segment_deg;
  double smallest_dihedral_deg = 180;         ///< over all segments
  double smallest_plane_angle_deg = 180;      ///< inside facets, between two consecutive segments at a corner
  std::size_t plane_corners_below_14_48 = 0;  ///< such corners below `critical_plane_angle_deg`
};

namespace domain_detail {

/// Smallest angle between consecutive directions around an axis, the gap across 360 degrees included.
inline double smallest_gap_deg(std::vector<double>& angles) {
  if (angles.size() < 2) return 180;
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 360 - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::min(gap, angles[i] - angles[i - 1]);
  return gap;
}

}  // namespace domain_detail

/// Per segment, the smallest dihedral angle between two sheets there, as in `Small_angles::segment_deg`.
template <class K>
std::vector<double> dihedral_angles_3(const Domain_3<K>& domain, const domain_detail::Facet_edges& edges) {
  using namespace domain_detail;
  std::vector<double> result(domain.segments.size(), 180);
  parallel_for_chunks(domain.segments.size(), default_grain, [&](std::size_t first, std::size_t last) {
    std::vector<double> around;  // the directions in which sheets leave, as angles around the segment
    for (std::size_t s = first; s < last; ++s) {
      around.clear();
      const auto [a, b] = domain.segments[s].vertices;
      const Vec_3 axis = normalized(to_vec(domain.vertices[b]) - to_vec(domain.vertices[a]));
      Vec_3 u, v;
      for (const Sheet& sheet : edges.sheets(s)) {
        const Vec_3 leaving = inward(domain, sheet, axis);
        if (around.empty()) {
          u = normalized(leaving - dot(leaving, axis) * axis);
          v = cross(axis, u);
        }
        const double angle = to_degrees(arc_tangent(dot(leaving, v), dot(leaving, u)));
        around.push_back(angle < 0 ? angle + 360 : angle);
      }
      result[s] = smallest_gap_deg(around);
    }
  });
  return result;
}

/// Measures the angles at every vertex, segment and facet corner of a domain.
template <class K>
Small_angles small_angles_3(const Domain_3<K>& domain) {
  using namespace domain_detail;
  std::vector<Vec_3> points;
  points.reserve(domain.vertices.size());
  for (const auto& p : domain.vertices) points.push_back(to_vec(p));
  const Facet_edges edges(domain);

  Small_angles result;
  result.vertex_deg.assign(points.size(), 180);
  result.segment_deg = dihedral_angles_3(domain, edges);
  for (const double angle : result.segment_deg) result.smallest_dihedral_deg = std::min(result.smallest_dihedral_deg, angle);

  // Corners inside facets.
  for (const Facet_corner& corner : edges.corners(points)) {
    result.smallest_plane_angle_deg = std::min(result.smallest_plane_angle_deg, corner.angle_deg);
    if (corner.angle_deg < Small_angles::critical_plane_angle_deg) ++result.plane_corners_below_14_48;
  }

  // Vertices: segments against segments, and against the facet triangles around the vertex.
  const Vertex_features features(domain);
  parallel_for_chunks(points.size(), default_grain, [&](std::size_t first, std::size_t last) {
    Vertex_angle angle;
    for (std::size_t w = first; w < last; ++w) {
      angle.clear();
      for (const Index i : features.segments(w)) {
        const auto& s = domain.segments[i];
        angle.add_segment(points[s.vertices[0] == w ? s.vertices[1] : s.vertices[0]] - points[w], s.facets);
      }
      for (const auto& [facet, triangle] : features.triangles(w)) {
        const auto& t = domain.facets[facet].triangles[triangle];
        const std::size_t k = t[0] == w ? 0 : t[1] == w ? 1 : 2;
        angle.add_triangle(facet, points[t[(k + 1) % 3]] - points[w], points[t[(k + 2) % 3]] - points[w]);
      }
      result.vertex_deg[w] = angle.smallest();
    }
  });
  return result;
}

// Compiled in the library.
extern template Small_angles small_angles_3(const Domain_3<Default_kernel>&);
}  // namespace pgdr

#endif
