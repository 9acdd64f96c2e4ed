// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_COMMAND_LINE_SIZING_H
#define PGDR_SIZING_COMMAND_LINE_SIZING_H

#include <algorithm>
#include <utility>
#include <vector>

#include <pgdr/sizing/distance_sizing_field.h>
#include <pgdr/sizing/local_sizing_field.h>

namespace pgdr {

/// The sizing field that the options of `pgdr mesh` describe, and the one that the library is compiled for: a bound everywhere, finer ones in
/// places, and by the distance from surfaces. The smallest one wins.
class Command_line_sizing {
 public:
  using Local = Local_sizing_field<Uniform_sizing_field>;

  Command_line_sizing() = default;
  explicit Command_line_sizing(Uniform_sizing_field everywhere, std::vector<Sizing_box> boxes = {}) : local_(everywhere, std::move(boxes)) {}
  explicit Command_line_sizing(Local local, std::vector<Distance_sizing_field> near_surfaces = {})
      : local_(std::move(local)), near_surfaces_(std::move(near_surfaces)) {}

  template <class Point_3>
  double operator()(const Point_3& p) const {
    double bound = local_(p);
    for (const Distance_sizing_field& f : near_surfaces_) bound = std::min(bound, f(p));
    return bound;
  }

  /// As `LimitedSizingField` says.
  template <class Point_3>
  double size_if_below(const Point_3& p, double limit) const {
    double bound = local_(p);
    for (const Distance_sizing_field& f : near_surfaces_) {
      if (bound < limit) break;
      bound = std::min(bound, f.size_if_below(p, limit));
    }
    return bound;
  }

  const Local& local() const { return local_; }
  const std::vector<Distance_sizing_field>& near_surfaces() const { return near_surfaces_; }

 private:
  Local local_;
  std::vector<Distance_sizing_field> near_surfaces_;
};

}  // namespace pgdr

#endif
