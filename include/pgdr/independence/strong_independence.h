// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_INDEPENDENCE_STRONG_INDEPENDENCE_H
#define PGDR_INDEPENDENCE_STRONG_INDEPENDENCE_H

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <optional>
#include <vector>

#include <CGAL/Kernel/global_functions_3.h>

#include <pgdr/independence/delaunay_independence.h>

namespace pgdr {

/// The points that may be inserted in a point's stead: `rule(t, p)` returns p, the circumcenter p' of the subfacet that p
/// encroaches, if it does, and the midpoint p'' of the subsegment that p or p' encroaches, if one does.
template <class R, class Tr>
concept EncroachmentRule = requires(const R& rule, const Tr& t, const typename Tr::Point& p) {
  { rule(t, p) } -> std::same_as<std::vector<typename Tr::Point>>;
};

/// **Definition 2** (A. Chernikov, N. Chrisochoides, ICS 2008). p and q are *strongly* Delaunay-independent if every
/// pair of {p, p', p''} and {q, q', q''} is Delaunay-independent: then it does not matter which of them are inserted.
///
/// Points that are vertices already are not inserted, and no trouble to anybody. \pre p and q are in the convex hull
template <class Tr, EncroachmentRule<Tr> Rule>
bool are_strongly_delaunay_independent(const Tr& t, const typename Tr::Point& p, const typename Tr::Point& q,
                                       const Rule& rule) {
  const auto is_vertex = [&t](const typename Tr::Point& x) {
    typename Tr::Vertex_handle v;
    return t.is_vertex(x, v);
  };
  std::vector<typename Tr::Point> at_p = rule(t, p), at_q = rule(t, q);
  std::erase_if(at_p, is_vertex);
  std::erase_if(at_q, is_vertex);
  return std::all_of(at_p.begin(), at_p.end(), [&](const auto& a) {
    return std::all_of(at_q.begin(), at_q.end(),
                       [&](const auto& b) { return a != b && are_delaunay_independent(t, a, b); });
  });
}

/// The rule for a triangulation whose convex hull is the domain and a polyhedron: its hull triangles are the subfacets, its
/// edges between hull triangles in different planes the subsegments. Looks at the whole hull.
template <class Tr>
struct Hull_encroachment {
  using Point = typename Tr::Point;

  std::vector<Point> operator()(const Tr& t, const Point& p) const {
    const auto center = nearest_encroached_subfacet(t, p);
    auto middle = nearest_encroached_subsegment(t, p);
    if (!middle && center) middle = nearest_encroached_subsegment(t, *center);
    std::vector<Point> points{p};
    // A center beyond the edge of its facet gives way to that edge.
    if (center && !t.is_infinite(t.locate(*center))) points.push_back(*center);
    if (middle) points.push_back(*middle);
    return points;
  }

 private:
  using Cell_handle = typename Tr::Cell_handle;

  /// Of several, the one whose center is nearest.
  static std::optional<Point> nearest_encroached_subfacet(const Tr& t, const Point& p) {
    std::optional<Point> nearest;
    each_hull_triangle(t, [&](Cell_handle, int, const std::array<Point, 3>& f) {
      if (CGAL::side_of_bounded_sphere(f[0], f[1], f[2], p) != CGAL::ON_BOUNDED_SIDE) return;
      const Point center = on_facet(CGAL::circumcenter(f[0], f[1], f[2]), f);
      if (!nearest || CGAL::has_smaller_distance_to_point(p, center, *nearest)) nearest = center;
    });
    return nearest;
  }

  /// Coordinates that a triangle has in common are not left to rounding: beyond the hull there is no point.
  static Point on_facet(const Point& p, const std::array<Point, 3>& f) {
    auto x = p.x(), y = p.y(), z = p.z();
    if (f[0].x() == f[1].x() && f[0].x() == f[2].x()) x = f[0].x();
    if (f[0].y() == f[1].y() && f[0].y() == f[2].y()) y = f[0].y();
    if (f[0].z() == f[1].z() && f[0].z() == f[2].z()) z = f[0].z();
    return Point(x, y, z);
  }

  static std::optional<Point> nearest_encroached_subsegment(const Tr& t, const Point& p) {
    std::optional<Point> nearest;
    each_hull_triangle(t, [&](Cell_handle c, int infinite, const std::array<Point, 3>& f) {
      for (int i = 0, k = 0; i < 4; ++i) {
        if (i == infinite) continue;
        // The hull triangle beyond the edge opposite to this vertex.
        const Point& a = f[static_cast<std::size_t>((k + 1) % 3)];
        const Point& b = f[static_cast<std::size_t>((k + 2) % 3)];
        const Point& own = f[static_cast<std::size_t>(k++)];
        if (CGAL::coplanar(own, a, b, t.mirror_vertex(c, i)->point())) continue;
        if (CGAL::side_of_bounded_sphere(a, b, p) != CGAL::ON_BOUNDED_SIDE) continue;
        const Point middle = CGAL::midpoint(a, b);
        if (!nearest || CGAL::has_smaller_distance_to_point(p, middle, *nearest)) nearest = middle;
      }
    });
    return nearest;
  }

  template <class Visit>
  static void each_hull_triangle(const Tr& t, const Visit& visit) {
    std::vector<Cell_handle> hull;
    t.incident_cells(t.infinite_vertex(), std::back_inserter(hull));
    for (const Cell_handle c : hull) {
      const int infinite = c->index(t.infinite_vertex());
      std::array<Point, 3> f;
      for (int i = 0, k = 0; i < 4; ++i)
        if (i != infinite) f[static_cast<std::size_t>(k++)] = c->vertex(i)->point();
      visit(c, infinite, f);
    }
  }
};

}  // namespace pgdr

#endif
