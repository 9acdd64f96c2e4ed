// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_TRIANGLE_SOUP_H
#define PGDR_DOMAIN_DETAIL_TRIANGLE_SOUP_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include <CGAL/Exact_rational.h>

#include <pgdr/domain/detail/aabb_trees.h>
#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/domain_3.h>

namespace pgdr::domain_detail {

/// All facet triangles of a domain in one list, facet by facet.
struct Triangle_soup {
  std::vector<Vec_3> points;
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> facet;         ///< of each triangle
  std::vector<std::size_t> offset;  ///< of each facet's first triangle, and the end

  template <class K>
  explicit Triangle_soup(const Domain_3<K>& domain) {
    points.reserve(domain.vertices.size());
    for (const auto& p : domain.vertices) points.push_back(to_vec(p));
    offset.push_back(0);
    for (Index f = 0; f < domain.facets.size(); ++f) {
      const auto& own = domain.facets[f].triangles;
      triangles.insert(triangles.end(), own.begin(), own.end());
      facet.insert(facet.end(), own.size(), f);
      offset.push_back(triangles.size());
    }
  }

  Work_point point(Index v) const { return to_work_point(points[v]); }
  Work_kernel::Triangle_3 triangle(std::size_t t) const {
    return {point(triangles[t][0]), point(triangles[t][1]), point(triangles[t][2])};
  }
  Vec_3 centroid(std::size_t t) const {
    return (1.0 / 3) * (points[triangles[t][0]] + points[triangles[t][1]] + points[triangles[t][2]]);
  }
  /// Where the line through two points crosses the plane of a triangle, in double precision.
  Vec_3 crossing(const Vec_3& source, const Vec_3& target, std::size_t t) const {
    const Vec_3& o = points[triangles[t][0]];
    const Vec_3 n = cross(points[triangles[t][1]] - o, points[triangles[t][2]] - o);
    return source + (dot(o - source, n) / dot(target - source, n)) * (target - source);
  }
};

/// Where a ray passes through the triangles of a soup, decided exactly.
class Ray_caster {
  using Triangles = std::vector<Work_kernel::Triangle_3>;
  using Tree = Aabb_triangle_tree<Work_kernel>;

 public:
  struct Hit {
    std::size_t triangle;
    bool from_front;  ///< the ray comes from the side that the triangle's normal points to
  };
  enum class Outcome { proper, degenerate, starts_on_triangle };
  struct Result {
    Outcome outcome = Outcome::proper;
    std::vector<Hit> hits;  ///< when `proper`: from the ray's source on; when `starts_on_triangle`: that one
  };

  explicit Ray_caster(const Triangle_soup& soup) {
    triangles_.reserve(soup.triangles.size());
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) triangles_.push_back(soup.triangle(t));
    tree_ = std::make_unique<Tree>(triangles_.cbegin(), triangles_.cend());
  }

  /// All triangles on the ray from `source` through `target`, in order.
  /// `degenerate` where it meets an edge or a vertex or lies in a triangle's plane: try another target.
  Result cast(const Work_point& source, const Work_point& target) const {
    Result result;
    if (triangles_.empty()) return result;
    std::vector<Triangles::const_iterator> met;
    tree_->all_intersected_primitives(Work_kernel::Ray_3(source, target), std::back_inserter(met));
    std::sort(met.begin(), met.end());
    for (const auto& t : met) {
      const CGAL::Orientation at_source = CGAL::orientation((*t)[0], (*t)[1], (*t)[2], source);
      const CGAL::Orientation sides[3] = {CGAL::orientation(source, target, (*t)[0], (*t)[1]),
                                          CGAL::orientation(source, target, (*t)[1], (*t)[2]),
                                          CGAL::orientation(source, target, (*t)[2], (*t)[0])};
      if (at_source == CGAL::COPLANAR && !CGAL::coplanar((*t)[0], (*t)[1], (*t)[2], target)) {
        result.outcome = Outcome::starts_on_triangle;
        result.hits = {{static_cast<std::size_t>(t - triangles_.cbegin()), true}};
        return result;
      }
      if (at_source == CGAL::COPLANAR || sides[0] == CGAL::COPLANAR || sides[0] != sides[1] ||
          sides[1] != sides[2])
        result.outcome = Outcome::degenerate;
      result.hits.push_back({static_cast<std::size_t>(t - triangles_.cbegin()), at_source == CGAL::POSITIVE});
    }
    if (result.outcome == Outcome::proper) sort_along(source, target, result.hits);
    return result;
  }

 private:
  /// Exact, because sheets may lie arbitrarily close together.
  void sort_along(const Work_point& source, const Work_point& target, std::vector<Hit>& hits) const {
    using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
    const auto exact = [](const Work_point& p) { return Exact::Point_3(p.x(), p.y(), p.z()); };
    const Exact::Point_3 o = exact(source);
    const Exact::Vector_3 d = exact(target) - o;
    std::vector<std::pair<CGAL::Exact_rational, Hit>> keyed;
    for (const Hit& h : hits) {
      const auto& t = triangles_[h.triangle];
      const Exact::Vector_3 n = CGAL::normal(exact(t[0]), exact(t[1]), exact(t[2]));
      keyed.push_back({((exact(t[0]) - o) * n) / (d * n), h});
    }
    std::stable_sort(keyed.begin(), keyed.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = keyed[i].second;
  }

  Triangles triangles_;
  std::unique_ptr<Tree> tree_;
};

/// The i-th of a fixed sequence of directions without any pattern.
inline Vec_3 scattered_direction(std::size_t i) {
  std::uint64_t state = 0x9E3779B97F4A7C15ull * (i + 1);
  const auto next = [&state] {
    state ^= state >> 30;
    state *= 0xBF58476D1CE4E5B9ull;
    state ^= state >> 27;
    state *= 0x94D049BB133111EBull;
    state ^= state >> 31;
    return static_cast<double>(state >> 11) * 0x1p-52 - 1;
  };
  const double x = next(), y = next(), z = next();
  return {x, y, z + (z < 0 ? -0.5 : 0.5)};
}

}  // namespace pgdr::domain_detail

#endif
