// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_REGION_3_H
#define PGDR_DOMAIN_REGION_3_H

#include <limits>

#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// A half-open box; the default is all of space.
struct Region_3 {
  Vec_3 lower{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
              -std::numeric_limits<double>::infinity()};
  Vec_3 upper{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
              std::numeric_limits<double>::infinity()};

  bool operator==(const Region_3&) const = default;

  bool contains(const Vec_3& p) const {
    return lower.x <= p.x && p.x < upper.x && lower.y <= p.y && p.y < upper.y && lower.z <= p.z && p.z < upper.z;
  }

  /// Whether p lies in it or on its boundary.
  bool contains_closed(const Vec_3& p) const {
    return lower.x <= p.x && p.x <= upper.x && lower.y <= p.y && p.y <= upper.y && lower.z <= p.z && p.z <= upper.z;
  }
};

}  // namespace pgdr

#endif
