// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MIRRORS_GAPS_3_H
#define PGDR_MIRRORS_GAPS_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include <CGAL/Bbox_3.h>
#include <CGAL/Simple_cartesian.h>

#include <pgdr/domain/detail/aabb_trees.h>
#include <pgdr/domain/detail/box_pairs.h>
#include <pgdr/domain/detail/have_common.h>
#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/region_3.h>
#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/domain/volumes_3.h>
#include <pgdr/mirrors/crossing_3.h>
#include <pgdr/mirrors/mirror_image.h>

namespace pgdr {

/// The pairs of facets that face each other across a narrow gap, meshed or not, and of segments on either side of it.
///
/// A vertex on one side is in the equatorial ball of every subfacet across that is wider than the gap, and both sides are divided down to it, unless they
/// have vertices at like places. Then none is, by the lemma of `Facet_wedges_3`: turning about the line in which two planes meet is reflection in the plane
/// halfway, and it holds for planes that meet nowhere as well. Where nothing is meshed in between that spares all of these points, of which the mesh has no
/// need; the triangulation is of all of space. What is meshed is refined down to the gap, but only after both sides are there.
class Gaps_3 {
 public:
  /// How wide a gap is at most, of the smaller one of its sides. Wider ones are as wide as subfacets are anyway.
  static constexpr double widest = 0.1;
  /// The angle between its sides at most, in degrees.
  static constexpr double limit = 5;
  /// How wide a gap is at most, of the insertion radius of a point on one of its sides, for an image on the other: table in docs/robustness.md. On facets,
  /// and where it is not meshed, up to where the balls of subfacets end at the other side, so that points without image are no trouble there.
  static constexpr double across_empty = 1, across_meshed = 0.1;
  /// The same for segments.
  static constexpr double along_empty = 0.25, along_meshed = 0.05;

  template <class K>
  explicit Gaps_3(const Domain_3<K>& domain) : boxes_(facet_boxes(domain)), of_facet_(domain.facets.size()), of_segment_(domain.segments.size()) {
    const std::vector<Pair> near = near_each_other(domain, boxes_);
    if (near.empty()) return;
    const Volumes_3<K> volumes(domain);
    for (const auto& [f, g] : near) {
      const Vec_3 u = to_vec(domain.facets[f].normal), origin = to_vec(domain.facets[f].origin);
      const double sign = dot(u, to_vec(domain.facets[g].normal)) < 0 ? -1 : 1;
      const Vec_3 v = sign * to_vec(domain.facets[g].normal), sum = u + v;
      Reflection mirror{g, domain_detail::normalized(sum), (dot(u, origin) + dot(v, to_vec(domain.facets[g].origin))) / length(sum), false};
      // From f to g is along u or against it.
      const bool is_along = mirror.height(middle_between(boxes_[f], boxes_[g], u, origin)) < 0;
      mirror.is_empty = is_open(domain, volumes, f, is_along) && is_open(domain, volumes, g, is_along == (sign < 0));
      of_facet_[f].push_back(mirror);
      mirror.other = f;
      of_facet_[g].push_back(mirror);
    }
    plant_trees(domain);
    pair_segments(domain);
  }

  /// Calls `found` with each image of m, a point in the plane of the facet with this insertion radius, on a facet across a gap.
  /// \param all also across what is meshed
  template <class Found>
  void for_each_image_on_facets(Index facet, const Vec_3& m, double radius, bool all, const Found& found) const {
    for (const Reflection& r : of_facet_[facet]) {
      if (!r.is_empty && !all) continue;
      const double h = r.height(m);
      if (2 * std::abs(h) > (r.is_empty ? across_empty : across_meshed) * radius) continue;
      if (const Vec_3 at = m - 2 * h * r.normal; is_on(r.other, at)) found(Mirror_image{{2, r.other}, at, r.is_empty});
    }
  }

  /// The same for segments, and a point of one, or an end.
  template <class Found>
  void for_each_image_on_segments(Index segment, const Vec_3& m, double radius, bool all, const Found& found) const {
    for (const Shift& s : of_segment_[segment]) {
      if (!s.is_empty && !all) continue;
      const double x = dot(m, s.axis), most = (s.is_empty ? along_empty : along_meshed) * radius;
      if (!(s.first < x && x < s.last)) continue;
      if (const Vec_3 at = s.origin + (x - s.first) * s.along; squared_distance(at, m) <= most * most) found(Mirror_image{{1, s.other}, at, s.is_empty});
    }
  }

  /// Segments that cross each other across what is not meshed, by their numbers.
  const std::vector<Crossing_3>& crossings() const { return crossings_; }

 private:
  static constexpr double rounding = 1e-12;
  using Kernel = CGAL::Simple_cartesian<double>;
  using Tree = domain_detail::Aabb_triangle_tree<Kernel>;
  using Pair = std::pair<Index, Index>;  ///< the larger index first
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;

  /// In the plane of x with x * normal = offset.
  struct Reflection {
    Index other;
    Vec_3 normal;
    double offset;
    bool is_empty;  ///< nothing is meshed in between
    double height(const Vec_3& x) const { return dot(normal, x) - offset; }
  };

  /// To the point of the other segment that is as far along the axis.
  struct Shift {
    Index other;
    Vec_3 axis, origin, along;
    double first, last;  ///< where the other one's ends are along the axis
    bool is_empty;
  };

  static double diagonal(const Region_3& box) { return length(box.upper - box.lower); }
  static double cosine_of_limit() { return cosine_of_degrees(limit); }

  /// For `overlapping`: the box, grown by `widest / 2` of its diagonal.
  static Box grown(const Region_3& box, Index number) {
    const double d = widest / 2 * diagonal(box);
    const Vec_3 lower = box.lower - Vec_3{d, d, d}, upper = box.upper + Vec_3{d, d, d};
    return {CGAL::Bbox_3(lower.x, lower.y, lower.z, upper.x, upper.y, upper.z), number};
  }

  /// Pairs of boxes that overlap, and for which `accept(i, j)`; in the order of their numbers.
  template <class Accept>
  static std::vector<Pair> overlapping(std::vector<Box> boxes, const Accept& accept) {
    std::vector<Pair> pairs = domain_detail::Box_slabs(std::move(boxes)).template pairs<Pair>([&](const Box& a, const Box& b, std::vector<Pair>& list) {
      const Pair p{std::max(a.info(), b.info()), std::min(a.info(), b.info())};
      if (accept(p.first, p.second)) list.push_back(p);
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  static bool are_near(const Region_3& a, const Region_3& b) {
    const double d = widest * std::min(diagonal(a), diagonal(b));
    for (int k = 0; k < 3; ++k)
      if (a.lower[k] - d > b.upper[k] || b.lower[k] - d > a.upper[k]) return false;
    return true;
  }

  /// Nearly parallel facets without a common vertex that are close to each other.
  template <class K>
  static std::vector<Pair> near_each_other(const Domain_3<K>& domain, const std::vector<Region_3>& boxes) {
    const double cosine = cosine_of_limit();
    std::vector<Box> all;
    for (Index f = 0; f < boxes.size(); ++f) all.push_back(grown(boxes[f], f));
    return overlapping(std::move(all), [&](Index i, Index j) {
      const auto &f = domain.facets[i], &g = domain.facets[j];
      return std::abs(dot(to_vec(f.normal), to_vec(g.normal))) >= cosine && are_near(boxes[i], boxes[j]) &&
             !domain_detail::have_common(f.vertices, g.vertices) && may_face(domain, i, j);
    });
  }

  /// Whether two facets may overlap as seen along the normal of the first: they do not if a line along one of their segments parts them. Without this a
  /// finely tessellated surface has as many pairs as facets.
  template <class K>
  static bool may_face(const Domain_3<K>& domain, Index i, Index j) {
    constexpr std::size_t most = 8;  // segments of each that are tried
    const Vec_3 normal = to_vec(domain.facets[i].normal);
    const auto extent = [&](Index f, const Vec_3& axis) {
      double lower = std::numeric_limits<double>::infinity(), upper = -lower;
      for (const Index v : domain.facets[f].vertices) {
        const double x = dot(to_vec(domain.vertices[v]), axis);
        lower = std::min(lower, x), upper = std::max(upper, x);
      }
      return std::pair(lower, upper);
    };
    return std::ranges::none_of(std::array{i, j}, [&](Index f) {
      const auto& segments = domain.facets[f].segments;
      return std::any_of(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(std::min(most, segments.size())), [&](Index s) {
        const auto [a, b] = domain.segments[s].vertices;
        const Vec_3 axis = cross(normal, to_vec(domain.vertices[b]) - to_vec(domain.vertices[a]));
        const auto [from, to] = extent(i, axis);
        const auto [first, last] = extent(j, axis);
        return to < first || last < from;
      });
    });
  }

  /// A point in the plane of the first facet, in the middle of where the boxes are closest.
  static Vec_3 middle_between(const Region_3& a, const Region_3& b, const Vec_3& normal, const Vec_3& origin) {
    Vec_3 middle;
    for (int k = 0; k < 3; ++k) middle[k] = 0.5 * (std::max(a.lower[k], b.lower[k]) + std::min(a.upper[k], b.upper[k]));
    return middle - dot(middle - origin, normal) * normal;
  }

  /// Whether a facet has what is not meshed in front of it, or behind it, somewhere.
  template <class K>
  static bool is_open(const Domain_3<K>& domain, const Volumes_3<K>& volumes, Index facet, bool front) {
    for (std::size_t t = 0; t < domain.facets[facet].triangles.size(); ++t)
      if (!volumes.volumes()[volumes.beside(facet, t, front)].material) return true;
    return false;
  }

  /// Makes a tree of the triangles of each facet that has a gap.
  template <class K>
  void plant_trees(const Domain_3<K>& domain) {
    const auto point = [&](Index v) {
      const Vec_3 p = to_vec(domain.vertices[v]);
      return Kernel::Point_3(p.x, p.y, p.z);
    };
    triangles_.resize(domain.facets.size());
    trees_.resize(domain.facets.size());
    for (Index f = 0; f < domain.facets.size(); ++f) {
      if (of_facet_[f].empty()) continue;
      for (const auto& t : domain.facets[f].triangles) triangles_[f].emplace_back(point(t[0]), point(t[1]), point(t[2]));
      trees_[f] = std::make_unique<Tree>(triangles_[f].cbegin(), triangles_[f].cend());
      trees_[f]->build();
    }
    tolerance_ = std::max(domain.tolerance, rounding * domain.diagonal);
  }

  /// Whether p is on a facet, up to the tolerance within which that is plane.
  bool is_on(Index facet, const Vec_3& p) const {
    const double d = tolerance_;
    return boxes_[facet].contains_closed(p) && trees_[facet]->do_intersect(CGAL::Bbox_3(p.x - d, p.y - d, p.z - d, p.x + d, p.y + d, p.z + d));
  }

  /// Nearly parallel segments next to each other along some of their length, of facets that face each other.
  template <class K>
  void pair_segments(const Domain_3<K>& domain) {
    std::vector<Box> boxes;
    for (Index s = 0; s < domain.segments.size(); ++s) {
      const auto& segment = domain.segments[s];
      if (std::ranges::all_of(segment.facets, [&](Index f) { return of_facet_[f].empty(); })) continue;
      const Vec_3 a = to_vec(domain.vertices[segment.vertices[0]]), b = to_vec(domain.vertices[segment.vertices[1]]);
      Region_3 box;
      for (int k = 0; k < 3; ++k) std::tie(box.lower[k], box.upper[k]) = std::minmax({a[k], b[k]});
      boxes.push_back(grown(box, s));
    }
    for (const auto& [s, t] : overlapping(std::move(boxes), [](Index, Index) { return true; })) {
      bool face_each_other = false, is_empty = false;
      for (const Index f : domain.segments[s].facets)
        for (const Reflection& r : of_facet_[f])
          if (std::ranges::binary_search(domain.segments[t].facets, r.other)) {
            face_each_other = true;
            is_empty |= r.is_empty;
          }
      if (face_each_other) pair_segments(domain, s, t, is_empty);
    }
  }

  template <class K>
  void pair_segments(const Domain_3<K>& domain, Index s, Index t, bool is_empty) {
    const auto &v = domain.segments[s].vertices, &w = domain.segments[t].vertices;
    if (domain_detail::have_common(v, w)) return;
    const auto point = [&](Index i) { return to_vec(domain.vertices[i]); };
    const Vec_3 a = point(v[0]), e = point(v[1]) - a;
    Vec_3 b = point(w[0]), f = point(w[1]) - b;
    if (is_empty)
      if (const auto crossing = crossing_3(domain, s, t, along_empty)) crossings_.push_back(*crossing);
    if (std::abs(dot(e, f)) < cosine_of_limit() * length(e) * length(f)) return;
    if (dot(e, f) < 0) {
      b = point(w[1]);
      f = -1.0 * f;
    }
    const Vec_3 axis = domain_detail::normalized((1 / length(e)) * e + (1 / length(f)) * f);
    const Shift to_s{s, axis, a, (1 / dot(e, axis)) * e, dot(a, axis), dot(a + e, axis), is_empty};
    const Shift to_t{t, axis, b, (1 / dot(f, axis)) * f, dot(b, axis), dot(b + f, axis), is_empty};
    if (std::min(to_s.last, to_t.last) < std::max(to_s.first, to_t.first)) return;
    of_segment_[s].push_back(to_t);
    of_segment_[t].push_back(to_s);
  }

  std::vector<Region_3> boxes_;  ///< of all facets
  std::vector<std::vector<Reflection>> of_facet_;
  std::vector<std::vector<Shift>> of_segment_;
  std::vector<Crossing_3> crossings_;
  std::vector<std::vector<Kernel::Triangle_3>> triangles_;  ///< of facets with gaps
  std::vector<std::unique_ptr<Tree>> trees_;                ///< of these
  double tolerance_ = 0;
};

}  // namespace pgdr

#endif
