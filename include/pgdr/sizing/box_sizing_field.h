// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_BOX_SIZING_FIELD_H
#define PGDR_SIZING_BOX_SIZING_FIELD_H

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

#include <CGAL/number_utils.h>

#include <pgdr/sizing/uniform_sizing_field.h>

namespace pgdr {

/// A closed axis-aligned box in which circumradii are at most `radius`.
struct Sizing_box {
  std::array<double, 3> lower{};
  std::array<double, 3> upper{};
  double radius = 0;

  bool contains(const std::array<double, 3>& p) const {
    return lower[0] <= p[0] && p[0] <= upper[0] && lower[1] <= p[1] && p[1] <= upper[1] && lower[2] <= p[2] && p[2] <= upper[2];
  }
};

/// A sizing field with boxes in which it is finer: every bound holds, so the smallest one wins where boxes
/// overlap each other, and inside a box where `Outer` is finer still.
template <class Outer = Uniform_sizing_field>
class Box_sizing_field {
 public:
  Box_sizing_field() = default;

  /// Throws `std::invalid_argument` if a box is empty or NaN in some direction or its radius not positive.
  explicit Box_sizing_field(Outer outer, std::vector<Sizing_box> boxes = {})
      : outer_(std::move(outer)), boxes_(std::move(boxes)) {
    for (const Sizing_box& box : boxes_) {
      if (!(box.radius > 0)) throw std::invalid_argument("the size in a refined box must be positive");
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(box.lower[axis] < box.upper[axis])) throw std::invalid_argument("a refined box is empty");
      }
    }
    // Finest first: the first box that holds a point then decides.
    std::stable_sort(boxes_.begin(), boxes_.end(),
                     [](const Sizing_box& a, const Sizing_box& b) { return a.radius < b.radius; });
  }

  template <class Point_3>
  double operator()(const Point_3& p) const {
    const double bound = outer_(p);
    if (boxes_.empty()) return bound;
    const std::array<double, 3> c{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
    for (const Sizing_box& box : boxes_) {
      if (box.contains(c)) return std::min(bound, box.radius);
    }
    return bound;
  }

  const Outer& outer() const { return outer_; }

  /// Ascending by radius.
  const std::vector<Sizing_box>& boxes() const { return boxes_; }

 private:
  Outer outer_;
  std::vector<Sizing_box> boxes_;
};

/// What `pgdr mesh --size R --refine-box ...` means: boxes over one base value, infinity without `--size`.
using Command_line_sizing = Box_sizing_field<Uniform_sizing_field>;

}  // namespace pgdr

#endif
