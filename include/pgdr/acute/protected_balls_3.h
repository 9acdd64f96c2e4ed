// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_ACUTE_PROTECTED_BALLS_3_H
#define PGDR_ACUTE_PROTECTED_BALLS_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <pgdr/domain/detail/box_pairs.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// What is asked of the size of tetrahedra, as far as it matters to what is protected at small angles. In the domain's unit.
struct Size_bounds {
  /// Whether the largest circumradius at a point is less than a length; called from several threads. None: unbounded.
  std::function<bool(const Vec_3&, double)> is_field_below;
  std::vector<double> at_vertex;  ///< the largest circumradius in the regions around each vertex of the domain; empty: unbounded

  bool is_below(const Vec_3& p, double length) const { return is_field_below && is_field_below(p, length); }
  bool is_below(Index v, double length) const { return !at_vertex.empty() && at_vertex[v] < length; }
};

/// Balls around the vertices of a domain where features meet at small angles. Features get no points inside, so that they
/// cannot drive each other's points ever closer to a vertex: every segment that ends in it gets a point on the sphere,
/// every facet has triangles from the vertex to an arc of the sphere, and what is missing of these is split on the arc. (The
/// collars of A. Rand and N. Walkington, *Collars and intestines: practical conforming Delaunay refinement*, IMR 2009, for the
/// corners that cannot do without.) The ball through the vertex, two points of the sphere and no other is hardly
/// larger than the protected one, so short arcs are Delaunay whatever there is outside.
class Protected_balls_3 {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Ball = std::pair<Kernel::Point_3, Index>;
  using Search = CGAL::Orthogonal_k_neighbor_search<
      CGAL::Search_traits_adapter<Ball, CGAL::First_of_pair_property_map<Ball>, CGAL::Search_traits_3<Kernel>>>;

 public:
  /// Of the shortest segment at a vertex, the radius of its ball: half of a segment is left between two. With smaller balls features are
  /// driven down to them first, and what angles of a fraction of a degree leave between features on the sphere gets below the
  /// minimum edge length: of six sets of intersecting cones none ends with 0.001, four with 0.05, all with 0.2 and 0.25.
  static constexpr double part = 0.25;

  /// `is_center[v]`: whether vertex v has a ball. Radii are powers of two, like those of the shells, at most half as large as
  /// the distance to any feature that does not contain the vertex, and no larger than the size in the ball: a tetrahedron with its circumcenter there
  /// has no larger circumradius than its distance from the vertex, so that sizes hold although nothing is inserted.
  template <class K>
  Protected_balls_3(const Domain_3<K>& domain, const std::vector<bool>& is_center, const Size_bounds& sizes = {}) : radius_(domain.vertices.size(), 0) {
    for (const auto& p : domain.vertices) position_.push_back(to_vec(p));
    for (Index v = 0; v < radius_.size(); ++v)
      if (is_center[v]) radius_[v] = std::numeric_limits<double>::infinity();
    for (const auto& s : domain.segments)
      for (const Index v : s.vertices)
        radius_[v] = std::min(radius_[v], part * length(position_[s.vertices[1]] - position_[s.vertices[0]]));
    keep_clear(domain);
    for (Index v = 0; v < radius_.size(); ++v) {
      if (!(radius_[v] > 0)) continue;
      radius_[v] = sized(v, floor_power_of_two(radius_[v]), sizes);
      largest_ = std::max(largest_, radius_[v]);
      const Vec_3& p = position_[v];
      centers_.insert({Kernel::Point_3(p.x, p.y, p.z), v});
    }
    if (centers_.size() > 0) centers_.build();
  }

  /// Of the ball around vertex v; 0 where there is none.
  double radius(Index v) const { return radius_[v]; }
  /// Of all balls.
  double largest() const { return largest_; }

  static constexpr Index none = std::numeric_limits<Index>::max();

  /// The vertex in whose ball p is, or none.
  Index find(const Vec_3& p) const {
    if (centers_.size() == 0) return none;
    const auto nearest = *Search(centers_, Kernel::Point_3(p.x, p.y, p.z), 1).begin();
    const double r = (1 - slack) * radius_[nearest.first.second];
    return nearest.second < r * r ? nearest.first.second : none;
  }

  /// The same for the center p of an empty ball, which is not searched for where that ball is larger than all of these.
  Index find(const Vec_3& p, double squared_radius) const {
    return squared_radius < largest_ * largest_ ? find(p) : none;
  }

  /// The point of the sphere around v in the direction of p. \pre p is not v
  Vec_3 on_sphere(Index v, const Vec_3& p) const {
    const Vec_3 d = p - position_[v];
    return position_[v] + (radius_[v] / length(d)) * d;
  }

  /// p, or if that is in a ball, the point of its sphere in the same direction: where features get a point instead.
  Vec_3 outside(const Vec_3& p) const {
    const Index v = find(p);
    return v == none ? p : on_sphere(v, p);
  }

  /// Whether no point of the segment from v to p is outside of v's ball.
  bool contains_segment(Index v, const Vec_3& p) const {
    return length(p - position_[v]) <= (1 + slack) * radius_[v];
  }

 private:
  /// Less than this inside counts as on a sphere: images are as far off like places (`Turn_3`), and if some were moved onto the sphere and others not, four points of two
  /// facets could be a flat tetrahedron.
  static constexpr double slack = 2e-6;

  /// Of a ball around v with this radius one, by halving, in which no size is smaller than its radius, as far as samples tell.
  double sized(Index v, double radius, const Size_bounds& sizes) const {
    constexpr double least_part = 0x1p-20;  // a field may go to 0, and then the minimum edge length ends the refinement, not the ball
    const auto is_finer = [&](double r) {
      if (sizes.is_below(v, r) || sizes.is_below(position_[v], r)) return true;
      return std::ranges::any_of(std::array<Vec_3, 6>{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}},
                                 [&](const Vec_3& d) { return sizes.is_below(position_[v] + r * d, r); });
    };
    double r = radius;
    while (r > least_part * radius && is_finer(r)) r /= 2;
    return r;
  }

  /// Makes balls smaller where a feature is close that does not contain their centers.
  template <class K>
  void keep_clear(const Domain_3<K>& domain) {
    using domain_detail::Box_slabs;
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
    std::vector<Box> balls, simplices;
    std::vector<std::pair<Index, std::array<Index, 3>>> triangles;  // facet, or `none`, and corners, some of them the same
    const auto point = [&](Index v) { return Kernel::Point_3(position_[v].x, position_[v].y, position_[v].z); };
    const auto add = [&](Index facet, const std::array<Index, 3>& t) {
      simplices.emplace_back(point(t[0]).bbox() + point(t[1]).bbox() + point(t[2]).bbox(), triangles.size());
      triangles.emplace_back(facet, t);
    };
    for (Index f = 0; f < domain.facets.size(); ++f)
      for (const auto& t : domain.facets[f].triangles) add(f, t);
    for (const auto& s : domain.segments) add(none, {s.vertices[0], s.vertices[1], s.vertices[1]});
    for (Index v = 0; v < radius_.size(); ++v) add(none, {v, v, v});
    for (Index v = 0; v < radius_.size(); ++v) {
      if (!(radius_[v] > 0) || std::isinf(radius_[v])) continue;
      const Vec_3& p = position_[v];
      const double r = 2 * radius_[v];
      balls.emplace_back(CGAL::Bbox_3(p.x - r, p.y - r, p.z - r, p.x + r, p.y + r, p.z + r), v);
    }
    Box_slabs(std::move(balls)).for_each_with(Box_slabs(std::move(simplices)), [&](const Box& b, const Box& s) {
      const auto v = static_cast<Index>(b.info());
      const auto& [facet, t] = triangles[s.info()];
      if (t[0] == v || t[1] == v || t[2] == v) return;
      if (facet != none && std::ranges::binary_search(domain.facets[facet].vertices, v)) return;
      const double d2 = t[1] == t[0]   ? CGAL::squared_distance(point(v), point(t[0]))
                        : t[2] == t[1] ? CGAL::squared_distance(point(v), Kernel::Segment_3(point(t[0]), point(t[1])))
                                       : CGAL::squared_distance(point(v), Kernel::Triangle_3(point(t[0]), point(t[1]), point(t[2])));
      radius_[v] = std::min(radius_[v], 0.5 * std::sqrt(d2));
    });
  }

  std::vector<Vec_3> position_;
  std::vector<double> radius_;
  double largest_ = 0;
  typename Search::Tree centers_;
};

}  // namespace pgdr

#endif
