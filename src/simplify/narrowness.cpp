// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/simplify/narrowness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <pgdr/domain/detail/facet_edges.h>
#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/small_angles_3.h>

namespace pgdr {

namespace {

double halvings(double angle_deg) {
  constexpr double least = 1e-9;
  double n = 0;
  for (double angle = Small_angles::critical_plane_angle_deg; angle_deg < angle && angle > least; angle /= 2) n += std::min(1.0, angle / std::max(angle_deg, least) - 1);
  return n;
}

/// The triangles of a facet by their sides.
class Facet_profile {
 public:
  Facet_profile(const Domain_3<Default_kernel>& domain, const std::vector<Vec_3>& points, std::size_t f) : points_(points), floor_(least * domain.diagonal) {
    const auto& facet = domain.facets[f];
    for (const auto& t : facet.triangles)
      for (std::size_t i = 0; i < 3; ++i) sides_.push_back({t[i], t[(i + 1) % 3], t[(i + 2) % 3]});
    std::ranges::sort(sides_);
    for (const Index s : facet.segments) segments_.push_back(domain.segments[s].vertices);
    std::ranges::sort(segments_);
  }

  /// As in `Narrowness`.
  double widths() const {
    double sum = 0;
    for (const auto& [a, b] : segments_)
      for (const auto& [from, to] : {std::array{a, b}, std::array{b, a}})
        if (const Index c = opposite(from, to); c != none) sum += 1 + widths_above(from, to, c);
    return sum;
  }

 private:
  static constexpr Index none = static_cast<Index>(-1);
  static constexpr double least = 1e-9;  ///< height above a segment that is told from none

  /// The third corner of the triangle that runs along this side.
  Index opposite(Index from, Index to) const {
    const auto at = std::ranges::lower_bound(sides_, std::array<Index, 3>{from, to, 0});
    return at != sides_.end() && (*at)[0] == from && (*at)[1] == to ? (*at)[2] : none;
  }
  bool is_segment(Index a, Index b) const { return std::ranges::binary_search(segments_, std::array{std::min(a, b), std::max(a, b)}); }

  /// Above the segment pq, which has c across: along the corners of the triangles at p and q.
  double widths_above(Index p, Index q, Index c) const {
    const Vec_3 axis = points_[q] - points_[p];
    const double length2 = squared_length(axis), l = std::sqrt(length2);
    struct Place {
      double along, height;
    };
    const auto place = [&](Index v) {
      const Vec_3 x = points_[v] - points_[p];
      return Place{dot(x, axis) / l, std::max(floor_, std::sqrt(squared_length(cross(x, axis)) / length2))};
    };
    double sum = 0;
    const auto add = [&](Place x, Place y) {
      if (x.along > y.along) std::swap(x, y);
      if (!(y.along > x.along) || (x.height == floor_ && y.height == floor_)) return;
      const double slope = (y.height - x.height) / (y.along - x.along);
      const auto height = [&](double s) { return x.height + slope * (s - x.along); };
      const double first = std::max(x.along, 0.0), last = std::min(y.along, l);
      if (first >= last) return;
      const double h = height(first), k = height(last);
      // The integral of 1 / height.
      sum += std::abs(k - h) < 1e-3 * h ? (last - first) / h : std::log(k / h) / slope;
    };
    const auto add_around = [&](const auto& next_corner) {
      Place before = place(c);
      for (Index v = next_corner(c); v != none && v != c; v = next_corner(v)) {
        const Place next = place(v);
        add(before, next);
        before = next;
      }
    };
    add_around([&](Index v) { return is_segment(p, v) ? none : opposite(p, v); });
    add_around([&](Index v) { return is_segment(q, v) ? none : opposite(v, q); });
    return sum;
  }

  const std::vector<Vec_3>& points_;
  double floor_;
  std::vector<std::array<Index, 3>> sides_;
  std::vector<std::array<Index, 2>> segments_;
};

}  // namespace

Narrowness narrowness(const Domain_3<Default_kernel>& domain) {
  std::vector<Vec_3> points;
  for (const auto& p : domain.vertices) points.push_back(to_vec(p));
  Narrowness n;
  for (const auto& corner : domain_detail::Facet_edges(domain).corners(points)) n.halvings += halvings(corner.angle_deg);
  for (std::size_t f = 0; f < domain.facets.size(); ++f) n.widths += Facet_profile(domain, points, f).widths();
  return n;
}

}  // namespace pgdr
