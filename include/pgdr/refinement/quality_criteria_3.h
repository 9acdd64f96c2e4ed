// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_QUALITY_CRITERIA_3_H
#define PGDR_REFINEMENT_QUALITY_CRITERIA_3_H

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <CGAL/number_utils.h>

#include <pgdr/conforming/subdomains_3.h>
#include <pgdr/domain/volumes_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/report/format.h>
#include <pgdr/sizing/sizing_field.h>

namespace pgdr {

/// When a tetrahedron is poor: radius-edge ratio, circumradius against the sizing field, volume and circumradius against its
/// subdomain's bounds.
template <class K, class Sizing>
  requires SizingField<Sizing, K>
class Quality_criteria_3 {
 public:
  /// `unit`: what coordinates and lengths of the triangulation are multiplied by to be those of the sizing field.
  Quality_criteria_3(double radius_edge_ratio, Sizing sizing, std::vector<Subdomain> subdomains, double unit = 1)
      // A hair below the bound, so that whoever measures the written mesh in other arithmetic agrees.
      : radius_edge_ratio_(radius_edge_ratio), squared_ratio_(radius_edge_ratio * radius_edge_ratio * (1 - 1e-9)),
        sizing_(std::move(sizing)), unit_(unit),
        subdomains_(std::move(subdomains)) {}

  bool is_poor(const Tetrahedron_ball& b, std::int32_t subdomain) const {
    return is_over_ratio(b) || is_over_size(b, subdomain);
  }

  /// Circumradius over shortest edge above the bound.
  bool is_over_ratio(const Tetrahedron_ball& b) const {
    return b.squared_radius > squared_ratio_ * b.squared_shortest;
  }

  bool is_over_size(const Tetrahedron_ball& b, std::int32_t subdomain) const {
    const Subdomain& s = subdomains_[static_cast<std::size_t>(subdomain)];
    if (s.max_volume > 0 && b.volume > s.max_volume) return true;
    if (s.max_circumradius > 0 && b.squared_radius > s.max_circumradius * s.max_circumradius) return true;
    if constexpr (LimitedSizingField<Sizing, K>) {
      // A hair above the radius, so that rounding has no say in what is not below it.
      const auto limit = [&] { return std::sqrt(b.squared_radius) * (1 + 1e-8) * unit_; };
      const typename K::Point_3 p = point(b.center);
      const double r = checked(sizing_.size_if_below(p, limit), p) / unit_;
      if (b.squared_radius > r * r) return true;
      if (r * r > b.squared_radius * (1 + 3e-8)) return false;  // above the limit; next to it the size itself decides
    }
    const double r = size_at(b.center);
    return b.squared_radius > r * r;
  }

  /// The bound of the circumradius of a tetrahedron that is over one of size; of a volume, what `circumradius_for` makes of it.
  double size_bound(const Tetrahedron_ball& b, std::int32_t subdomain) const {
    const Subdomain& s = subdomains_[static_cast<std::size_t>(subdomain)];
    double bound = size_at(b.center);
    if (s.max_circumradius > 0) bound = std::min(bound, s.max_circumradius);
    if (s.max_volume > 0) bound = std::min(bound, circumradius_for(s.max_volume));
    return bound;
  }

  /// The sizing field, without the bounds of subdomains. Throws `Sizing_error`.
  double size_at(const Vec_3& center) const {
    const typename K::Point_3 p = point(center);
    return checked(sizing_(p), p) / unit_;
  }

  double radius_edge_ratio() const { return radius_edge_ratio_; }
  const std::vector<Subdomain>& subdomains() const { return subdomains_; }

 private:
  /// In the coordinates of the sizing field.
  typename K::Point_3 point(const Vec_3& p) const { return {p.x * unit_, p.y * unit_, p.z * unit_}; }

  static double checked(double size, const typename K::Point_3& p) {
    if (!(size >= 0)) [[unlikely]] refuse(size, p);
    return size;
  }

  [[noreturn, gnu::cold, gnu::noinline]] static void refuse(double size, const typename K::Point_3& p) {
    const auto coordinate = [](const auto& x) { return significant(CGAL::to_double(x), 6); };
    throw Sizing_error("the size at " + coordinate(p.x()) + "," + coordinate(p.y()) + "," + coordinate(p.z()) + " is " + significant(size) +
                       ": it has to be positive, wherever a circumcenter may lie, outside of the domain too");
  }

  double radius_edge_ratio_;
  double squared_ratio_;
  Sizing sizing_;
  double unit_;
  std::vector<Subdomain> subdomains_;
};

}  // namespace pgdr

#endif
