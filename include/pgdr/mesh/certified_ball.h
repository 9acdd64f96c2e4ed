// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_CERTIFIED_BALL_H
#define PGDR_MESH_CERTIFIED_BALL_H

#include <cmath>

#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// A circumball in few bits, with two radii: whatever is nearer to the center than the first is certainly inside the
/// exact ball, whatever is farther than the second certainly outside. Between them only an exact predicate knows.
///
/// It decides nearly every in-sphere test from the cell alone, without its vertices.
struct Certified_ball {
  float center[3] = {0, 0, 0};
  float squared_inside = -1;   ///< negative: nothing is known; 0: no point is certainly inside
  float squared_outside = 0;

  bool is_known() const { return squared_inside >= 0; }
  /// Whether the center is known to less than the radius; not where the ball is small and floats are far apart.
  bool has_center() const { return squared_inside > 0; }
  void forget() { squared_inside = -1; }

  /// 1: certainly inside, -1: certainly outside, 0: too close to tell. \pre is_known()
  int side(const Vec_3& p) const {
    const double x = p.x - static_cast<double>(center[0]), y = p.y - static_cast<double>(center[1]),
                 z = p.z - static_cast<double>(center[2]);
    const double d2 = x * x + y * y + z * z;
    return d2 > static_cast<double>(squared_outside) ? -1 : d2 < static_cast<double>(squared_inside) ? 1 : 0;
  }

  /// From a center and radius r each of which is off by less than `relative_error` times the radius.
  void set(const Vec_3& c, double r, double relative_error) {
    // Rounding to float moves a coordinate by at most 2^-24 of it; the tiny term is for subnormal ones.
    const double e = 0x1p-24 * (std::abs(c.x) + std::abs(c.y) + std::abs(c.z)) + 2 * relative_error * r + 1e-40;
    const double inside = r - e, outside = r + e;
    if (!(r > 0) || !(outside < 1e18)) return forget();
    for (int k = 0; k < 3; ++k) center[k] = static_cast<float>(c[k]);
    // A margin for rounding the squares to float, and for the rounding of `side` itself.
    constexpr double margin = 1e-6;
    squared_inside = inside > 0 ? static_cast<float>(inside * inside * (1 - margin)) : 0.0f;
    squared_outside = static_cast<float>(outside * outside * (1 + margin));
  }
};

}  // namespace pgdr

#endif
