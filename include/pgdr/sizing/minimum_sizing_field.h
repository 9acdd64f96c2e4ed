// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_MINIMUM_SIZING_FIELD_H
#define PGDR_SIZING_MINIMUM_SIZING_FIELD_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <pgdr/sizing/sizing_field.h>

namespace pgdr {

/// The smallest of several sizing fields: every one of them is a bound. A value that is negative or no number wins, so that it is found.
template <class... Fields>
class Minimum_sizing_field {
 public:
  explicit Minimum_sizing_field(Fields... fields) : fields_(std::move(fields)...) {}

  template <class Point_3>
  double operator()(const Point_3& p) const {
    return std::apply(
        [&p](const Fields&... field) {
          double least = std::numeric_limits<double>::infinity();
          ((least = smaller(least, static_cast<double>(field(p)))), ...);
          return least;
        },
        fields_);
  }

  const std::tuple<Fields...>& fields() const { return fields_; }

 private:
  static double smaller(double a, double b) { return std::isnan(a) || a < b ? a : b; }

  std::tuple<Fields...> fields_;
};

}  // namespace pgdr

#endif
