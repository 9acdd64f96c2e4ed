// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_LOCAL_SIZING_FIELD_H
#define PGDR_SIZING_LOCAL_SIZING_FIELD_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <CGAL/number_utils.h>

#include <pgdr/sizing/sizing_places.h>
#include <pgdr/sizing/uniform_sizing_field.h>

namespace pgdr {

/// A sizing field that is finer in some places: every bound holds, so that the smallest one wins where places overlap each other, and in a
/// place where `Outer` is finer still.
///
/// Around a place the bound grows by `gradation` for each unit of distance; with infinity, the default, it ends at the place's border. With a
/// finite one the bound of a place holds everywhere, and the field is as Lipschitz as `Outer` and the gradation are.
template <class Outer = Uniform_sizing_field>
class Local_sizing_field {
 public:
  static constexpr double no_gradation = std::numeric_limits<double>::infinity();

  Local_sizing_field() = default;

  /// Throws `std::invalid_argument` if a place is empty or NaN, its bound not positive, or the gradation not positive.
  explicit Local_sizing_field(Outer outer, std::vector<Sizing_box> boxes = {}, std::vector<Sizing_ball> balls = {}, double gradation = no_gradation)
      : outer_(std::move(outer)), boxes_(std::move(boxes)), balls_(std::move(balls)), gradation_(gradation) {
    if (!(gradation > 0)) throw std::invalid_argument("the gradation must be positive");
    for (const Sizing_box& box : boxes_) {
      require_positive(box.radius);
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (!(box.lower[axis] < box.upper[axis])) throw std::invalid_argument("a refined box is empty");
    }
    for (const Sizing_ball& ball : balls_) {
      require_positive(ball.radius);
      if (!(ball.extent >= 0) || std::ranges::any_of(ball.center, [](double x) { return std::isnan(x); })) throw std::invalid_argument("a refined ball is empty");
    }
    // Finest first: none of those that are not finer than what was found need be looked at.
    std::ranges::stable_sort(boxes_, {}, &Sizing_box::radius);
    std::ranges::stable_sort(balls_, {}, &Sizing_ball::radius);
  }

  template <class Point_3>
  double operator()(const Point_3& p) const {
    const double bound = outer_(p);
    if (boxes_.empty() && balls_.empty()) [[likely]] return bound;
    return least_in_places({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())}, bound);
  }

  const Outer& outer() const { return outer_; }
  double gradation() const { return gradation_; }

  /// Ascending by radius.
  const std::vector<Sizing_box>& boxes() const { return boxes_; }
  const std::vector<Sizing_ball>& balls() const { return balls_; }

 private:
  static void require_positive(double radius) {
    if (!(radius > 0)) throw std::invalid_argument("the size in a refined place must be positive");
  }

  // Not inlined, so that what most meshes ask is: the engine asks for every tetrahedron.
  [[gnu::noinline]] double least_in_places(const std::array<double, 3>& p, double bound) const {
    return least(balls_, p, least(boxes_, p, bound));
  }

  template <class Place>
  double least(const std::vector<Place>& places, const std::array<double, 3>& p, double bound) const {
    for (const Place& place : places) {
      if (place.radius >= bound) break;
      if (gradation_ < no_gradation)
        bound = std::min(bound, place.radius + gradation_ * place.distance(p));
      else if (place.contains(p))
        bound = place.radius;
    }
    return bound;
  }

  Outer outer_;
  std::vector<Sizing_box> boxes_;
  std::vector<Sizing_ball> balls_;
  double gradation_ = no_gradation;
};

}  // namespace pgdr

#endif
