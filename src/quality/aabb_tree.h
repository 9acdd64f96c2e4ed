// SPDX-License-Identifier: GPL-3.0-or-later
// Private to src/quality: CGAL's AABB tree over plain doubles.
#ifndef PGDR_SRC_QUALITY_AABB_TREE_H
#define PGDR_SRC_QUALITY_AABB_TREE_H

#include <cstdint>
#include <vector>

#include <CGAL/Simple_cartesian.h>

#include <pgdr/domain/detail/aabb_trees.h>

namespace pgdr::quality_detail {

using Plain = CGAL::Simple_cartesian<double>;

/// A triangle or segment, with the number of what it belongs to.
template <class Shape>
struct Tagged {
  Shape shape;
  std::uint32_t tag;
};

/// Model of CGAL's AABBPrimitive that points into an array of `Tagged`.
template <class Shape>
class Tagged_primitive {
 public:
  using Id = const Tagged<Shape>*;
  using Point = Plain::Point_3;
  using Datum = Shape;

  Tagged_primitive() = default;
  template <class Iterator>
  explicit Tagged_primitive(Iterator it) : item_(&*it) {}
  Id id() const { return item_; }
  const Datum& datum() const { return item_->shape; }
  Point reference_point() const { return item_->shape.vertex(0); }

 private:
  Id item_ = nullptr;
};

template <class Shape>
using Aabb_tree = CGAL::AABB_tree<domain_detail::Aabb_traits<Plain, Tagged_primitive<Shape>>>;

}  // namespace pgdr::quality_detail

#endif
