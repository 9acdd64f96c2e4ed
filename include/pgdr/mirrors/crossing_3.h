// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MIRRORS_CROSSING_3_H
#define PGDR_MIRRORS_CROSSING_3_H

#include <algorithm>
#include <array>
#include <optional>

#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// Two segments that cross each other, one above the other, and the points of theirs that are closest to each other. Neither has a vertex there that could
/// have an image.
struct Crossing_3 {
  std::array<Index, 2> segments;
  std::array<Vec_3, 2> at;
  double radius;  ///< of a point that would have an image this far away
};

/// Where two segments cross, if there is room for the points: the ends are as far as the insertion radius of a point that would have an image, at least.
/// \param close how far images are at most, of that radius
/// \pre they have no common vertex
template <class K>
std::optional<Crossing_3> crossing_3(const Domain_3<K>& domain, Index s, Index t, double close) {
  const auto point = [&](Index segment, int end) { return to_vec(domain.vertices[domain.segments[segment].vertices[end]]); };
  const Vec_3 a = point(s, 0), e = point(s, 1) - a, b = point(t, 0), f = point(t, 1) - b;
  // Of parallel ones there is none, since nothing is more than not a number.
  const Vec_3 normal = cross(e, f), between = b - a;
  const double n2 = squared_length(normal), x = dot(cross(between, f), normal) / n2, y = dot(cross(between, e), normal) / n2;
  const Vec_3 p = a + x * e, q = b + y * f;
  const double room = std::min(std::min(x, 1 - x) * length(e), std::min(y, 1 - y) * length(f)), radius = length(q - p) / close;
  if (!(radius < room)) return std::nullopt;
  return Crossing_3{{s, t}, {p, q}, radius};
}

}  // namespace pgdr

#endif
