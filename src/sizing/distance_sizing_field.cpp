// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/distance_sizing_field.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <CGAL/Simple_cartesian.h>

#include <pgdr/domain/detail/aabb_triangle_tree.h>
#include <pgdr/domain/reproducible_functions.h>

namespace pgdr {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A power of two that brings the coordinates near 1, where squares of them are doubles.
double unit_for(const std::vector<Distance_sizing_field::Triangle>& triangles) {
  double largest = 0;
  for (const auto& t : triangles)
    for (const auto& p : t)
      for (const double x : p) largest = std::max(largest, std::abs(x));
  return largest > 0 && largest < infinity ? floor_power_of_two(largest) : 1;
}

/// So thin that the distance from it is that from its neighbors, and that doubles have no say.
bool is_needle(const Kernel::Triangle_3& t) {
  constexpr double thin = 1e-10;  // height over longest edge
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, CGAL::squared_distance(t.vertex(i), t.vertex(i + 1)));
  return !(4 * t.squared_area() > thin * thin * longest * longest);
}

}  // namespace

struct Distance_sizing_field::Tree {
  double unit = 1;  ///< of the triangles' coordinates
  double scaled_area = 0;
  std::vector<Kernel::Triangle_3> triangles;
  domain_detail::Aabb_triangle_tree<Kernel> tree;

  Kernel::Point_3 scaled(const std::array<double, 3>& p) const { return {p[0] / unit, p[1] / unit, p[2] / unit}; }
};

Distance_sizing_field::Distance_sizing_field(const std::vector<Triangle>& triangles, double near, double far, double reach)
    : near_(near), far_(far), reach_(reach) {
  if (!(0 < near && near <= far && far < infinity)) throw std::invalid_argument("sizes near and far from a surface must be positive, the first one no larger");
  if (!(far - near < reach && reach < infinity))
    throw std::invalid_argument("sizes must grow by less than the distance from a surface does: nothing bounds them otherwise");
  const auto tree = std::make_shared<Tree>();
  tree->unit = unit_for(triangles);
  for (const auto& [a, b, c] : triangles) {
    const Kernel::Triangle_3 t(tree->scaled(a), tree->scaled(b), tree->scaled(c));
    if (is_needle(t)) continue;
    tree->triangles.push_back(t);
    tree->scaled_area += std::sqrt(t.squared_area());
  }
  if (tree->triangles.empty()) throw std::invalid_argument("a surface to measure distances from has no triangles");
  tree->tree.insert(tree->triangles.cbegin(), tree->triangles.cend());
  tree->tree.build();
  tree->tree.accelerate_distance_queries();  // builds what else the first query would build, on whatever thread
  tree_ = tree;
}

double Distance_sizing_field::distance(const std::array<double, 3>& p, double most) const {
  const Kernel::Point_3 query = tree_->scaled(p);
  if (most == infinity) return tree_->unit * std::sqrt(tree_->tree.squared_distance(query));
  // The search begins with a point that need not be on a triangle, and leaves out what is farther.
  const Kernel::Point_3 bound(query.x() + most / tree_->unit, query.y(), query.z());
  const Kernel::Point_3 found = tree_->tree.closest_point(query, bound);
  return found == bound ? most : std::min(most, tree_->unit * std::sqrt(CGAL::squared_distance(query, found)));
}

double Distance_sizing_field::size_within(const std::array<double, 3>& p, double limit) const {
  if (near_ >= limit) return near_;
  if (far_ < limit && limit < infinity) return far_;
  // A hair more, so that what is at the border comes out above the limit.
  const double most = limit < infinity ? (limit - near_) / (far_ - near_) * reach_ * (1 + 1e-9) : reach_;
  const double d = distance(p, most);
  if (d >= most && limit < infinity) return far_;
  return near_ + (far_ - near_) * std::min(d / reach_, 1.0);
}

double Distance_sizing_field::area(double unit) const { return tree_->unit / unit * (tree_->unit / unit) * tree_->scaled_area; }

}  // namespace pgdr
