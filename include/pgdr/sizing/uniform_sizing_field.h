// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_UNIFORM_SIZING_FIELD_H
#define PGDR_SIZING_UNIFORM_SIZING_FIELD_H

#include <limits>
#include <stdexcept>

namespace pgdr {

/// The same bound of the circumradius everywhere; a default-constructed one bounds nothing.
class Uniform_sizing_field {
 public:
  Uniform_sizing_field() = default;

  /// Throws `std::invalid_argument` unless `radius` > 0; infinity is allowed.
  explicit Uniform_sizing_field(double radius) : radius_(radius) {
    if (!(radius > 0)) throw std::invalid_argument("the size must be positive");
  }

  template <class Point_3>
  double operator()(const Point_3&) const {
    return radius_;
  }

  double radius() const { return radius_; }

 private:
  double radius_ = std::numeric_limits<double>::infinity();
};

/// The field that leaves the size of tetrahedra to their radius-edge ratio alone.
inline Uniform_sizing_field unbounded_sizing_field() { return {}; }

}  // namespace pgdr

#endif
