// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_ACUTE_NEIGHBORHOOD_3_H
#define PGDR_CONFORMING_ACUTE_NEIGHBORHOOD_3_H

#include <vector>

#include <CGAL/AABB_tree.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>
#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_segment_primitive_3.h>
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#endif

#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// The vertices and segments of a domain where two features meet at less than `limit` degrees, with distances to
/// them: Delaunay refinement cannot keep its promise next to these, and must not go on for ever there.
class Acute_neighborhood_3 {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Segments = std::vector<Kernel::Segment_3>;
#if CGAL_VERSION_MAJOR >= 6
  using Primitive = CGAL::AABB_segment_primitive_3<Kernel, Segments::const_iterator>;
  using Segment_tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
#else
  using Primitive = CGAL::AABB_segment_primitive<Kernel, Segments::const_iterator>;
  using Segment_tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
#endif
  using Vertex_search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;

 public:
  static constexpr double limit = 60;

  template <class K>
  explicit Acute_neighborhood_3(const Domain_3<K>& domain) {
    const Small_angles angles = small_angles_3(domain);
    is_acute_vertex_.resize(domain.vertices.size(), false);
    const auto point = [&](Index v) {
      const Vec_3 p = to_vec(domain.vertices[v]);
      return Kernel::Point_3(p.x, p.y, p.z);
    };
    for (Index v = 0; v < domain.vertices.size(); ++v) {
      if (angles.vertex_deg[v] >= limit) continue;
      is_acute_vertex_[v] = true;
      vertices_.insert(point(v));
    }
    for (Index s = 0; s < domain.segments.size(); ++s)
      if (angles.segment_deg[s] < limit)
        segments_.emplace_back(point(domain.segments[s].vertices[0]), point(domain.segments[s].vertices[1]));
    segment_tree_.rebuild(segments_.begin(), segments_.end());
    if (!segments_.empty()) segment_tree_.build();
    if (vertices_.size() > 0) vertices_.build();
  }
  Acute_neighborhood_3(const Acute_neighborhood_3&) = delete;
  Acute_neighborhood_3& operator=(const Acute_neighborhood_3&) = delete;

  /// Whether two features meet at less than `limit` degrees in this domain vertex.
  bool is_acute_vertex(Index v) const { return is_acute_vertex_[v]; }

  /// Whether p is within `distance` of such a vertex or segment.
  bool contains(const Vec_3& p, double distance) const {
    const Kernel::Point_3 q(p.x, p.y, p.z);
    if (vertices_.size() > 0 && Vertex_search(vertices_, q, 1).begin()->second <= distance * distance) return true;
    return !segments_.empty() && segment_tree_.squared_distance(q) <= distance * distance;
  }

 private:
  std::vector<bool> is_acute_vertex_;
  Vertex_search::Tree vertices_;
  Segments segments_;
  Segment_tree segment_tree_;
};

}  // namespace pgdr

#endif
