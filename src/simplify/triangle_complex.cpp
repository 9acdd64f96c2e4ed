// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangle_complex.h"

#include <algorithm>
#include <utility>

#include <pgdr/domain/detail/intersecting_triangles.h>

namespace pgdr::simplify_detail {

namespace {

bool contains(const Corners& c, Index v) { return std::ranges::find(c, v) != c.end(); }

}  // namespace

Triangle_complex::Triangle_complex(std::vector<Vec_3> points, std::vector<Triangle> triangles)
    : points_(std::move(points)), triangles_(std::move(triangles)), at_(points_.size()) {
  std::vector<Entry> entries;
  entries.reserve(triangles_.size());
  for (Index t = 0; t < triangles_.size(); ++t) {
    for (const Index v : triangles_[t].corners) at_[v].push_back(t);
    entries.emplace_back(box(triangles_[t].corners), t);
  }
  tree_ = Tree(entries);
}

std::vector<Index> Triangle_complex::at_edge(Index a, Index b) const {
  std::vector<Index> result;
  for (const Index t : at_[a])
    if (contains(triangles_[t].corners, b)) result.push_back(t);
  return result;
}

bool Triangle_complex::has_edge(Index a, Index b) const {
  return std::ranges::any_of(at_[a], [&](Index t) { return contains(triangles_[t].corners, b); });
}

std::vector<Index> Triangle_complex::neighbors(Index v) const {
  std::vector<Index> result;
  for (const Index t : at_[v])
    for (const Index w : triangles_[t].corners)
      if (w != v) result.push_back(w);
  domain_detail::sort_unique(result);
  return result;
}

bool Triangle_complex::has_triangle(Corners c) const {
  return std::ranges::any_of(at_[c[0]], [&](Index t) {
    return contains(triangles_[t].corners, c[1]) && contains(triangles_[t].corners, c[2]);
  });
}

std::size_t Triangle_complex::apex(const Corners& c) const {
  std::size_t best = 0;
  double longest = -1;
  for (std::size_t i = 0; i < 3; ++i)
    if (const double l = edge_length(c[(i + 1) % 3], c[(i + 2) % 3]); l > longest) {
      longest = l;
      best = i;
    }
  return best;
}

double Triangle_complex::height(const Corners& c) const {
  const std::size_t i = apex(c);
  const Vec_3 &a = points_[c[(i + 1) % 3]], &b = points_[c[(i + 2) % 3]];
  const double base = length(b - a);
  return base > 0 ? length(cross(b - a, points_[c[i]] - a)) / base : 0;
}

double Triangle_complex::sharpest_cosine(std::span<const Triangle> list, std::span<const Index> removed) const {
  double cosine = -1;
  const auto compare = [&](Index a, Index b, const Corners& c, const Corners& d) {
    // Perpendicular to the edge, within the triangles.
    const auto side = [&](const Corners& t) {
      const Index w = *std::ranges::find_if(t, [&](Index v) { return v != a && v != b; });
      const Vec_3 e = points_[b] - points_[a], x = points_[w] - points_[a];
      return x - (dot(x, e) / squared_length(e)) * e;
    };
    const Vec_3 p = side(c), q = side(d);
    cosine = std::max(cosine, dot(p, q) / (length(p) * length(q)));
  };
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Corners& c = list[i].corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = c[k], b = c[(k + 1) % 3];
      for (std::size_t j = 0; j < i; ++j)
        if (contains(list[j].corners, a) && contains(list[j].corners, b)) compare(a, b, c, list[j].corners);
      for (const Index t : at_edge(a, b))
        if (std::ranges::find(removed, t) == removed.end()) compare(a, b, c, triangles_[t].corners);
    }
  }
  return cosine;
}

bool Triangle_complex::would_meet(std::span<const Triangle> made, std::span<const Index> removed) const {
  namespace index = boost::geometry::index;
  const auto work = [&](Index v) { return domain_detail::to_work_point(points_[v]); };
  for (std::size_t i = 0; i < made.size(); ++i) {
    const Corners& c = made[i].corners;
    if (CGAL::collinear(work(c[0]), work(c[1]), work(c[2]))) return true;
    for (std::size_t j = 0; j < i; ++j)
      if (domain_detail::triangles_meet(c, made[j].corners, points_)) return true;
    for (auto e = tree_.qbegin(index::intersects(box(c))); e != tree_.qend(); ++e)
      if (std::ranges::find(removed, e->second) == removed.end() &&
          domain_detail::triangles_meet(c, triangles_[e->second].corners, points_))
        return true;
  }
  return false;
}

void Triangle_complex::replace(std::span<const Index> removed, std::span<const Triangle> made) {
  for (const Index t : removed) {
    triangles_[t].alive = false;
    tree_.remove(Entry(box(triangles_[t].corners), t));
    for (const Index v : triangles_[t].corners) std::erase(at_[v], t);
  }
  for (const Triangle& m : made) {
    const auto t = static_cast<Index>(triangles_.size());
    triangles_.push_back(m);
    tree_.insert(Entry(box(m.corners), t));
    for (const Index v : m.corners) at_[v].push_back(t);
  }
}

Triangle_complex::Box Triangle_complex::box(const Corners& c) const {
  const auto of = [&](Index v) { return domain_detail::to_work_point(points_[v]).bbox(); };
  const CGAL::Bbox_3 b = of(c[0]) + of(c[1]) + of(c[2]);
  return {Point(b.xmin(), b.ymin(), b.zmin()), Point(b.xmax(), b.ymax(), b.zmax())};
}

}  // namespace pgdr::simplify_detail
