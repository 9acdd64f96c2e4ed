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

/// So thin that doubles have no say in what is near it.
bool is_degenerate(const Kernel::Triangle_3& t) {
  constexpr double thin = 1e-10;  // height over longest edge
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, CGAL::squared_distance(t.vertex(i), t.vertex(i + 1)));
  return !(4 * t.squared_area() > thin * thin * longest * longest);
}

bool is_degenerate(const Kernel::Segment_3& s) { return !(s.squared_length() > 0); }

double squared_distance_to_box(const Kernel::Point_3& p, const CGAL::Bbox_3& box) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max({box.min(k) - p[k], p[k] - box.max(k), 0.0});
    sum += d * d;
  }
  return sum;
}

/// A traversal of an AABB tree for the distance from what is nearest, if that is less than a bound. The nearer child of a node comes first, unlike in CGAL's search, which
/// takes up to three times as long.
class Nearest {
 public:
  using Priority = double;

  explicit Nearest(double squared_most) : squared_distance_(squared_most) {}

  bool go_further() const { return true; }
  template <class Primitive>
  void intersection(const Kernel::Point_3& p, const Primitive& primitive) {
    squared_distance_ = std::min(squared_distance_, CGAL::squared_distance(p, Kernel().construct_projected_point_3_object()(*primitive.id(), p)));
  }
  template <class Node>
  bool do_intersect(const Kernel::Point_3& p, const Node& node) const {
    return do_intersect_with_priority(p, node).first;
  }
  /// CGAL's convention: whether, and the child with the larger number first.
  template <class Node>
  std::pair<bool, Priority> do_intersect_with_priority(const Kernel::Point_3& p, const Node& node) const {
    const double d = squared_distance_to_box(p, node.bbox());
    return {d < squared_distance_, -d};
  }

  double squared_distance() const { return squared_distance_; }

 private:
  double squared_distance_;
};

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
  explicit Tree(double unit_of_objects) : unit(unit_of_objects) {}
  virtual ~Tree() = default;
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  /// Or `most` if that is less.
  virtual double squared_distance(const Kernel::Point_3& query, double most) const = 0;

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
  }

  double squared_distance(const Kernel::Point_3& query, double most) const override {
    Nearest search(most);
    tree.traversal_with_priority(query, search);
    return search.squared_distance();
  }

  std::vector<typename Objects::Object> objects;
  typename Objects::Tree tree;
};

void Distance_sizing_field::set_sizes(double near, double far, double reach, double margin) {
  if (!(0 < near && near <= far && far < infinity)) throw std::invalid_argument("sizes near and far from a surface must be positive, the first one no larger");
  if (!(far - near < reach && reach < infinity))
    throw std::invalid_argument("sizes must grow by less than the distance from a surface does: nothing bounds them otherwise");
  if (!(0 <= margin && margin < infinity)) throw std::invalid_argument("the margin around a surface must be finite and not negative");
  near_ = near;
  far_ = far;
  reach_ = reach;
  margin_ = margin;
}

Distance_sizing_field::Distance_sizing_field(const std::vector<Triangle>& triangles, double near, double far, double reach, double margin) {
  set_sizes(near, far, reach, margin);
  const auto tree = std::make_shared<Tree_of<Triangles>>(triangles);
  for (const auto& t : tree->objects) tree->scaled_area += std::sqrt(t.squared_area());
  tree_ = tree;
}

bool Distance_sizing_field::has_area(const Triangle& triangle) {
  const double unit = unit_for(std::vector{triangle});
  const auto at = [&](std::size_t k) { return Kernel::Point_3(triangle[k][0] / unit, triangle[k][1] / unit, triangle[k][2] / unit); };
  return !is_degenerate(Kernel::Triangle_3(at(0), at(1), at(2)));
}

Distance_sizing_field Distance_sizing_field::from_segments(const std::vector<Segment>& segments, double near, double far, double reach, double margin) {
  Distance_sizing_field field;
  field.set_sizes(near, far, reach, margin);
  field.tree_ = std::make_shared<Tree_of<Segments>>(segments);
  return field;
}

double Distance_sizing_field::distance(const std::array<double, 3>& p, double most) const {
  const double scaled = most / tree_->unit;
  return std::min(most, tree_->unit * std::sqrt(tree_->squared_distance(tree_->scaled(p), scaled * scaled)));
}

double Distance_sizing_field::size_within(const std::array<double, 3>& p, double limit) const {
  if (near_ >= limit) return near_;
  if (far_ < limit && limit < infinity) return far_;
  // A hair more, so that what is at the border comes out above the limit.
  const double most = margin_ + (limit < infinity ? (limit - near_) / (far_ - near_) * reach_ * (1 + 1e-9) : reach_);
  const double d = distance(p, most);
  if (d >= most && limit < infinity) return far_;
  return near_ + (far_ - near_) * std::clamp((d - margin_) / reach_, 0.0, 1.0);
}

double Distance_sizing_field::area(double unit) const { return tree_->unit / unit * (tree_->unit / unit) * tree_->scaled_area; }

}  // namespace pgdr
