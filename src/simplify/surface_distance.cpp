// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/simplify/surface_distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <CGAL/Simple_cartesian.h>

#include <pgdr/domain/detail/aabb_trees.h>
#include <pgdr/domain/facet_triangles.h>
#include <pgdr/domain/input_error.h>
#include <pgdr/parallel/parallel_reduce.h>

namespace pgdr {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangle = Kernel::Triangle_3;
using Triangles = std::vector<Triangle>;
using Point = Kernel::Point_3;

Point point(const Plc& plc, Index v) {
  const auto& p = plc.vertices[v];
  return {p.x(), p.y(), p.z()};
}

std::optional<Triangles> triangles_of(const Plc& plc) {
  Triangles triangles;
  try {
    for (const auto& [c, facet] : facet_triangles(plc)) triangles.emplace_back(point(plc, c[0]), point(plc, c[1]), point(plc, c[2]));
  } catch (const Input_error&) {
    return std::nullopt;
  }
  return triangles;
}

/// Of points of one surface from the other.
class One_way {
 public:
  One_way(const Triangles& to, double limit) : tree_(to.begin(), to.end()), squared_limit_(limit * limit) {
    tree_.build();
    tree_.accelerate_distance_queries();
  }

  Surface_distance from(const Triangles& triangles) const {
    return parallel_reduce(
        triangles.size(), 256, Surface_distance{0, true, {}},
        [&](std::size_t first, std::size_t last) {
          Surface_distance d{0, true, {}};
          std::size_t looks = most_looks;
          for (std::size_t t = first; t < last && d.is_within; ++t) look(triangles[t], d, looks);
          return d;
        },
        [](Surface_distance& all, const Surface_distance& part) {
          all.is_within = all.is_within && part.is_within;
          if (part.seen > all.seen) all.seen = part.seen, all.at = part.at;
        });
  }

 private:
  /// At parts of 256 triangles, which take a second. Where a large triangle lies on thousands of needles, each part of it has to be as small as one.
  static constexpr std::size_t most_looks = 50000;

  struct Corner {
    Point at;
    const Triangle* nearest;
  };

  Corner corner(const Point& p, Surface_distance& d) const {
    const auto found = tree_.closest_point_and_primitive(p);
    const double distance = std::sqrt(CGAL::squared_distance(p, found.first));
    if (distance > d.seen) d.seen = distance, d.at = {p.x(), p.y(), p.z()};
    return {p, &*found.second};
  }

  void look(const Triangle& triangle, Surface_distance& d, std::size_t& looks) const {
    std::vector<std::array<Corner, 3>> parts{{corner(triangle[0], d), corner(triangle[1], d), corner(triangle[2], d)}};
    while (!parts.empty() && d.seen * d.seen <= squared_limit_) {
      const std::array<Corner, 3> part = parts.back();
      parts.pop_back();
      if (is_near_one(part)) continue;
      std::size_t longest = 0;
      double most = 0;
      for (std::size_t i = 0; i < 3; ++i)
        if (const double l = CGAL::squared_distance(part[(i + 1) % 3].at, part[(i + 2) % 3].at); l > most) most = l, longest = i;
      if (most < 1e-6 * squared_limit_ || looks-- == 0) {
        d.is_within = false;
        return;
      }
      const Corner middle = corner(CGAL::midpoint(part[(longest + 1) % 3].at, part[(longest + 2) % 3].at), d);
      for (const std::size_t end : {1u, 2u}) {
        parts.push_back(part);
        parts.back()[(longest + end) % 3] = middle;
      }
    }
    if (d.seen * d.seen > squared_limit_) d.is_within = false;
  }

  /// Whether all corners are within the limit of what is nearest to one of them.
  bool is_near_one(const std::array<Corner, 3>& part) const {
    return std::ranges::any_of(part, [&](const Corner& c) {
      return std::ranges::all_of(part, [&](const Corner& e) { return CGAL::squared_distance(e.at, *c.nearest) <= squared_limit_; });
    });
  }

  domain_detail::Aabb_triangle_tree<Kernel> tree_;
  double squared_limit_;
};

}  // namespace

std::optional<Surface_distance> surface_distance(const Plc& a, const Plc& b, double limit) {
  const auto from = triangles_of(a), to = triangles_of(b);
  if (!from || !to || from->empty() || to->empty()) return std::nullopt;
  Surface_distance there = One_way(*to, limit).from(*from);
  const Surface_distance back = One_way(*from, limit).from(*to);
  there.is_within = there.is_within && back.is_within;
  if (back.seen > there.seen) there.seen = back.seen, there.at = back.at;
  return there;
}

}  // namespace pgdr
