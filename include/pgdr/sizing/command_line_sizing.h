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
    const double bound = local_(p);
    return near_surfaces_.empty() ? bound : exact_size(p, bound);
  }

  /// As `LimitedSizingField` says.
  template <class Point_3, class Limit>
  double size_if_below(const Point_3& p, const Limit& limit) const {
    const double bound = local_(p);
    return near_surfaces_.empty() ? bound : size_below(p, bound, limit);
  }

  const Local& local() const { return local_; }
  const std::vector<Distance_sizing_field>& near_surfaces() const { return near_surfaces_; }

 private:
  // Not inlined, so that what most meshes ask is: the engine asks for every tetrahedron.
  template <class Point_3>
  [[gnu::noinline]] double exact_size(const Point_3& p, double bound) const {
    for (const Distance_sizing_field& f : near_surfaces_) bound = std::min(bound, f(p));
    return bound;
  }

  template <class Point_3, class Limit>
  [[gnu::noinline]] double size_below(const Point_3& p, double bound, const Limit& limit) const {
    for (const Distance_sizing_field& f : near_surfaces_) {
      if (bound < limit()) break;
      bound = std::min(bound, f.size_if_below(p, limit));
    }
    return bound;
  }

  Local local_;
  std::vector<Distance_sizing_field> near_surfaces_;
};

}  // namespace pgdr

#endif
