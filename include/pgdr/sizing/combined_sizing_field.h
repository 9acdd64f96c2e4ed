// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_COMBINED_SIZING_FIELD_H
#define PGDR_SIZING_COMBINED_SIZING_FIELD_H

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <functional>
#include <utility>
#include <vector>

#include <CGAL/number_utils.h>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/sizing/distance_sizing_field.h>
#include <pgdr/sizing/local_sizing_field.h>
#include <pgdr/sizing/sizing_field.h>

namespace pgdr {

/// The sizing field that the options of `pgdr mesh` describe, and the one that the library is compiled for: a bound everywhere, finer ones in
/// places, by the distance from surfaces, and by any functions. The smallest one wins; a value that is negative or no number does, too, so that it
/// is found.
class Combined_sizing_field {
 public:
  using Local = Local_sizing_field<Uniform_sizing_field>;
  /// From coordinates in the user's unit; called from several threads at once. `SizingField` says what it may return.
  using Function = std::function<double(const std::array<double, 3>&)>;

  Combined_sizing_field() = default;
  explicit Combined_sizing_field(Uniform_sizing_field everywhere, std::vector<Sizing_box> boxes = {}) : local_(everywhere, std::move(boxes)) {}
  explicit Combined_sizing_field(Local local, std::vector<Distance_sizing_field> near_surfaces = {}, std::vector<Function> functions = {})
      : local_(std::move(local)), near_surfaces_(std::move(near_surfaces)), functions_(std::move(functions)) {}

  /// Of any field of points of the default kernel.
  template <SizingField<Default_kernel> Sizing>
  static Combined_sizing_field of(const Sizing& sizing) {
    if constexpr (std::constructible_from<Local, const Sizing&>)
      return Combined_sizing_field(Local(sizing));
    else if constexpr (std::same_as<Sizing, Distance_sizing_field>)
      return Combined_sizing_field(Local(), {sizing});
    else
      return Combined_sizing_field(Local(), {}, {[sizing](const std::array<double, 3>& p) -> double { return sizing(Default_kernel::Point_3(p[0], p[1], p[2])); }});
  }

  template <class Point_3>
  double operator()(const Point_3& p) const {
    const double bound = local_(p);
    return is_local() ? bound : exact_size(p, bound);
  }

  /// As `LimitedSizingField` says.
  template <class Point_3, class Limit>
  double size_if_below(const Point_3& p, const Limit& limit) const {
    const double bound = local_(p);
    return is_local() ? bound : size_below(p, bound, limit);
  }

  const Local& local() const { return local_; }
  const std::vector<Distance_sizing_field>& near_surfaces() const { return near_surfaces_; }
  const std::vector<Function>& functions() const { return functions_; }

 private:
  bool is_local() const { return near_surfaces_.empty() && functions_.empty(); }

  // Not inlined, so that what most meshes ask is: the engine asks for every tetrahedron.
  template <class Point_3>
  [[gnu::noinline]] double exact_size(const Point_3& p, double bound) const {
    for (const Distance_sizing_field& f : near_surfaces_) bound = std::min(bound, f(p));
    return smallest(p, bound);
  }

  template <class Point_3, class Limit>
  [[gnu::noinline]] double size_below(const Point_3& p, double bound, const Limit& limit) const {
    for (const Distance_sizing_field& f : near_surfaces_) {
      if (bound < limit()) break;
      bound = std::min(bound, f.size_if_below(p, limit));
    }
    return smallest(p, bound);
  }

  /// Of `bound` and the functions, all of which are called: what one returns may be wrong.
  template <class Point_3>
  double smallest(const Point_3& p, double bound) const {
    for (const Function& f : functions_) {
      const double size = f({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
      if (std::isnan(size)) return size;
      bound = std::min(bound, size);
    }
    return bound;
  }

  Local local_;
  std::vector<Distance_sizing_field> near_surfaces_;
  std::vector<Function> functions_;
};

}  // namespace pgdr

#endif
