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

struct Surface {
  std::vector<Point> points;
  std::vector<std::array<Index, 3>> corners;  ///< of the triangles
  Triangles triangles;
};

std::optional<Surface> surface_of(const Plc& plc) {
  Surface surface;
  for (const auto& p : plc.vertices) surface.points.emplace_back(p.x(), p.y(), p.z());
  try {
    for (const auto& [c, facet] : facet_triangles(plc)) {
      surface.corners.push_back(c);
      surface.triangles.emplace_back(surface.points[c[0]], surface.points[c[1]], surface.points[c[2]]);
    }
  } catch (const Input_error&) {
    return std::nullopt;
  }
  return surface;
}

/// Of points of one surface from the other.
class One_way {
 public:
  One_way(const Surface& to, double limit) : tree_(to.triangles.begin(), to.triangles.end()), squared_limit_(limit * limit) {
    tree_.build();
    tree_.accelerate_distance_queries();
  }

  Surface_distance from(const Surface& surface) const {
    std::vector<bool> is_corner(surface.points.size(), false);
    for (const auto& c : surface.corners)
      for (const Index v : c) is_corner[v] = true;
    std::vector<Corner> corners(surface.points.size());
    Surface_distance result = all_within(surface.points.size(), [&](std::size_t v, Surface_distance& d, std::size_t&) {
      if (is_corner[v]) corners[v] = corner(surface.points[v], d);
    });
    if (result.seen * result.seen > squared_limit_) result.is_within = false;
    if (!result.is_within) return result;
    add(result, all_within(surface.corners.size(), [&](std::size_t t, Surface_distance& d, std::size_t& looks) {
      const auto& c = surface.corners[t];
      look({corners[c[0]], corners[c[1]], corners[c[2]]}, d, looks);
    }));
    return result;
  }

  static void add(Surface_distance& all, const Surface_distance& part) {
    all.is_within = all.is_within && part.is_within;
    if (part.seen > all.seen) all.seen = part.seen, all.at = part.at;
  }

 private:
  /// At parts of 256 triangles, which take a second. Where a large triangle lies on thousands of needles, each part of it has to be as small as one.
  static constexpr std::size_t most_looks = 50000;

  struct Corner {
    Point at;
    const Triangle* nearest;
  };

  /// \param look called with the number of an item, what to add to, and how many looks its part has left
  template <class Look>
  static Surface_distance all_within(std::size_t n, const Look& look) {
    return parallel_reduce(
        n, 256, Surface_distance{0, true, {}},
        [&](std::size_t first, std::size_t last) {
          Surface_distance d{0, true, {}};
          std::size_t looks = most_looks;
          for (std::size_t i = first; i < last && d.is_within; ++i) look(i, d, looks);
          return d;
        },
        add);
  }

  Corner corner(const Point& p, Surface_distance& d) const {
    const auto found = tree_.closest_point_and_primitive(p);
    const double distance = std::sqrt(CGAL::squared_distance(p, found.first));
    if (distance > d.seen) d.seen = distance, d.at = {p.x(), p.y(), p.z()};
    return {p, &*found.second};
  }

  void look(const std::array<Corner, 3>& triangle, Surface_distance& d, std::size_t& looks) const {
    std::vector<std::array<Corner, 3>> parts{triangle};
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
  const auto from = surface_of(a), to = surface_of(b);
  if (!from || !to || from->corners.empty() || to->corners.empty()) return std::nullopt;
  Surface_distance there = One_way(*to, limit).from(*from);
  One_way::add(there, One_way(*from, limit).from(*to));
  return there;
}

}  // namespace pgdr
