// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_SPLIT_POINT_3_H
#define PGDR_CONFORMING_SPLIT_POINT_3_H

#include <algorithm>
#include <cmath>

#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// Where a subsegment (a, b) is split. Next to an acute corner the distance from that corner is a power of two,
/// times the segment's factor (`Shells_3`), or that of the smallest shell (concentric shells: Ruppert 1995, section "Small angles in the
/// input"), so that subsegments of one corner end at like distances and stop encroaching each other; with two acute corners, or none, it is the midpoint.
inline Vec_3 subsegment_split_point(const Vec_3& a, const Vec_3& b, bool acute_at_a, bool acute_at_b,
                                    double smallest_shell = 0, double factor = 1) {
  if (acute_at_a == acute_at_b) {
    Vec_3 m = 0.5 * (a + b);
    return m;
  }
  const Vec_3& corner = acute_at_a ? a : b;
  const Vec_3& other = acute_at_a ? b : a;
  const double len = length(other - corner);
  // In (len/3, 2 len/3].
  const double shell = std::max(smallest_shell, factor * floor_power_of_two(2.0 / 3.0 * len / factor));
  Vec_3 m = corner + (shell / len) * (other - corner);
  for (int i = 0; i < 3; ++i)
    if (a[i] == b[i]) m[i] = a[i];
  return m;
}

}  // namespace pgdr

#endif
