// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/distance_sizing_field.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <vector>

#include <CGAL/Simple_cartesian.h>

#include <pgdr/domain/detail/aabb_trees.h>
#include <pgdr/domain/reproducible_functions.h>

namespace pgdr {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A power of two that brings the coordinates near 1, where squares of them are doubles.
template <class Object>
double unit_for(const std::vector<Object>& objects) {
  double largest = 0;
  for (const Object& object : objects)
    for (const auto& p : object)
      for (const double x : p) largest = std::max(largest, std::abs(x));
  return largest > 0 && largest < infinity ? floor_power_of_two(largest) : 1;
}

/// So thin that the distance from it is that from its neighbors, and that doubles have no say.
bool is_degenerate(const Kernel::Triangle_3& t) {
  constexpr double thin = 1e-10;  // height over longest edge
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, CGAL::squared_distance(t.vertex(i), t.vertex(i + 1)));
  return !(4 * t.squared_area() > thin * thin * longest * longest);
}

bool is_degenerate(const Kernel::Segment_3& s) { return !(s.squared_length() > 0); }

struct Triangles {
  using Object = Kernel::Triangle_3;
  using Tree = domain_detail::Aabb_triangle_tree<Kernel>;
  static constexpr const char* none = "a surface to measure distances from has no triangles";
};

struct Segments {
  using Object = Kernel::Segment_3;
  using Tree = domain_detail::Aabb_segment_tree<Kernel>;
  static constexpr const char* none = "there are no segments to measure distances from";
};

}  // namespace

struct Distance_sizing_field::Tree {
  explicit Tree(double unit) : unit(unit) {}
  virtual ~Tree() = default;
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  virtual double squared_distance(const Kernel::Point_3& query) const = 0;
  /// The search begins with `bound`, which need not be on an object, and leaves out what is farther.
  virtual Kernel::Point_3 closest_point(const Kernel::Point_3& query, const Kernel::Point_3& bound) const = 0;

  Kernel::Point_3 scaled(const std::array<double, 3>& p) const { return {p[0] / unit, p[1] / unit, p[2] / unit}; }

  double unit;  ///< of the objects' coordinates
  double scaled_area = 0;
};

template <class Objects>
struct Distance_sizing_field::Tree_of final : Tree {
  template <class Corners>
  explicit Tree_of(const std::vector<Corners>& corners) : Tree(unit_for(corners)) {
    for (const Corners& c : corners) {
      const auto object = std::apply([this](const auto&... p) { return typename Objects::Object(scaled(p)...); }, c);
      if (!is_degenerate(object)) objects.push_back(object);
    }
    if (objects.empty()) throw std::invalid_argument(Objects::none);
    tree.insert(objects.cbegin(), objects.cend());
    tree.build();
    tree.accelerate_distance_queries();  // builds what else the first query would build, on whatever thread
  }

  double squared_distance(const Kernel::Point_3& query) const override { return tree.squared_distance(query); }
  Kernel::Point_3 closest_point(const Kernel::Point_3& query, const Kernel::Point_3& bound) const override { return tree.closest_point(query, bound); }

  std::vector<typename Objects::Object> objects;
  typename Objects::Tree tree;
};

Distance_sizing_field::Distance_sizing_field(double near, double far, double reach) : near_(near), far_(far), reach_(reach) {
  if (!(0 < near && near <= far && far < infinity)) throw std::invalid_argument("sizes near and far from a surface must be positive, the first one no larger");
  if (!(far - near < reach && reach < infinity))
    throw std::invalid_argument("sizes must grow by less than the distance from a surface does: nothing bounds them otherwise");
}

Distance_sizing_field::Distance_sizing_field(const std::vector<Triangle>& triangles, double near, double far, double reach) : Distance_sizing_field(near, far, reach) {
  const auto tree = std::make_shared<Tree_of<Triangles>>(triangles);
  for (const auto& t : tree->objects) tree->scaled_area += std::sqrt(t.squared_area());
  tree_ = tree;
}

Distance_sizing_field Distance_sizing_field::from_segments(const std::vector<Segment>& segments, double near, double far, double reach) {
  Distance_sizing_field field(near, far, reach);
  field.tree_ = std::make_shared<Tree_of<Segments>>(segments);
  return field;
}

double Distance_sizing_field::distance(const std::array<double, 3>& p, double most) const {
  const Kernel::Point_3 query = tree_->scaled(p);
  if (most == infinity) return tree_->unit * std::sqrt(tree_->squared_distance(query));
  const Kernel::Point_3 bound(query.x() + most / tree_->unit, query.y(), query.z());
  const Kernel::Point_3 found = tree_->closest_point(query, bound);
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
