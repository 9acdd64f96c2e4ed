// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_INDEPENDENCE_SEPARATING_SUBSEGMENT_H
#define PGDR_INDEPENDENCE_SEPARATING_SUBSEGMENT_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <CGAL/number_utils.h>

namespace pgdr {

/// A piece of the segment from p to q, between the points p + t (q - p).
struct Separating_subsegment {
  double from = 0, to = 0;    ///< 0 <= from < to <= 1
  double length = 0;          ///< in the units of the triangulation
  double largest_radius = 0;  ///< of all circumballs that meet the piece: at most half of the length
};

/// **Theorem 2** (A. Chernikov, N. Chrisochoides, ICS 2008). Two points p and q are Delaunay-independent if some
/// subsegment s of the segment pq, of positive length, satisfies
///
/// - (8) 2 r <= |s| for the circumradius r of every tetrahedron whose circumball meets s.
///
/// Returns such a subsegment, the one with the largest circumballs if there are several, or nothing. Circumballs are
/// computed in double precision and taken somewhat too large, so that what is returned is one. Looks at all tetrahedra
/// of `t`, any `CGAL::Delaunay_triangulation_3`; the condition is sufficient only: see `are_delaunay_independent`.
/// The proof is in docs/theory.md, section 2. \pre p and q are different, and strictly inside the convex hull of t.
template <class Tr>
std::optional<Separating_subsegment> find_separating_subsegment(const Tr& t, const typename Tr::Point& p,
                                                                const typename Tr::Point& q) {
  using Vector = std::array<double, 3>;
  const auto vector = [](const typename Tr::Point& x) {
    return Vector{CGAL::to_double(x.x()), CGAL::to_double(x.y()), CGAL::to_double(x.z())};
  };
  const auto minus = [](const Vector& a, const Vector& b) { return Vector{a[0] - b[0], a[1] - b[1], a[2] - b[2]}; };
  const auto dot = [](const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto cross = [](const Vector& a, const Vector& b) {
    return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Vector start = vector(p), way = minus(vector(q), start);
  const double length = std::sqrt(dot(way, way));

  // What each circumball covers of the segment.
  struct Cover {
    double radius, from, to;
  };
  std::vector<Cover> covers;
  for (auto c = t.finite_cells_begin(); c != t.finite_cells_end(); ++c) {
    const Vector a = vector(c->vertex(0)->point()), u = minus(vector(c->vertex(1)->point()), a),
                 v = minus(vector(c->vertex(2)->point()), a), w = minus(vector(c->vertex(3)->point()), a);
    const Vector vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
    const double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w), det = dot(u, vw);
    // Of too flat a tetrahedron nothing is known: it may be anywhere, and of any size.
    if (det * det < 1e-18 * uu * vv * ww) {
      covers.push_back({std::numeric_limits<double>::infinity(), 0, 1});
      continue;
    }
    Vector center;
    for (std::size_t i = 0; i < 3; ++i) center[i] = (uu * vw[i] + vv * wu[i] + ww * uv[i]) / (2 * det);
    const double radius = std::sqrt(dot(center, center)) * (1 + 1e-6);
    for (std::size_t i = 0; i < 3; ++i) center[i] += a[i];
    const Vector to_center = minus(center, start);
    const double middle = dot(to_center, way) / (length * length);
    const double off = dot(to_center, to_center) - middle * middle * length * length;
    const double half = radius * radius - off;
    if (half <= 0) continue;
    const double reach = std::sqrt(half) / length;
    if (middle + reach > 0 && middle - reach < 1)
      covers.push_back({radius, std::max(0.0, middle - reach), std::min(1.0, middle + reach)});
  }
  std::sort(covers.begin(), covers.end(), [](const Cover& a, const Cover& b) {
    return std::array{-a.radius, a.from, a.to} < std::array{-b.radius, b.from, b.to};
  });

  // From the largest balls to the smallest: the gaps that they leave, by where they start. A gap that no ball with a
  // radius above half of its length meets is what is wanted.
  std::map<double, double> gaps{{0, 1}};
  for (std::size_t k = 0; k <= covers.size(); ++k) {
    const double radius = k < covers.size() ? covers[k].radius : 0;
    for (const auto& [from, to] : gaps)
      if ((to - from) * length >= 2 * radius) return Separating_subsegment{from, to, (to - from) * length, radius};
    if (k == covers.size()) break;
    const Cover& c = covers[k];
    auto g = gaps.upper_bound(c.from);
    if (g != gaps.begin() && std::prev(g)->second > c.from) --g;
    while (g != gaps.end() && g->first < c.to) {
      const auto [from, to] = *g;
      g = gaps.erase(g);
      if (from < c.from) gaps.emplace(from, c.from);
      if (c.to < to) gaps.emplace(c.to, to);
    }
    if (gaps.empty()) break;
  }
  return std::nullopt;
}

}  // namespace pgdr

#endif
