// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_TERRITORY_MAP_H
#define PGDR_REFINEMENT_TERRITORY_MAP_H

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <pgdr/domain/region_3.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// The extents of the smallest box around some points.
inline Vec_3 extents(std::span<const Vec_3> points) {
  if (points.empty()) return {};
  Vec_3 lower = points.front(), upper = lower;
  for (const Vec_3& p : points)
    for (int i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], p[i]);
      upper[i] = std::max(upper[i], p[i]);
    }
  return upper - lower;
}

/// Divides space into parts with about as many of the sample points in each, by recursive coordinate bisection (Berger and
/// Bokhari, IEEE Trans. Computers 36, 1987): across the longer side of what is to be divided.
class Territory_map {
 public:
  /// Parts are a power of two. Every cut leaves the given share of the points below it; another share moves the borders.
  /// The order of the points does not matter.
  Territory_map(std::vector<Vec_3> sample, std::size_t parts, double share) : cuts_(parts - 1) { cut(0, sample, share); }

  std::size_t parts() const { return cuts_.size() + 1; }

  /// The half-open box of a part, without end towards the outside.
  Region_3 region(std::size_t part) const {
    Region_3 r;
    for (std::size_t k = part + cuts_.size(); k > 0; k = (k - 1) / 2) {
      const Cut& c = cuts_[(k - 1) / 2];
      if (k % 2 == 1)
        r.upper[c.axis] = std::min(r.upper[c.axis], c.at);
      else
        r.lower[c.axis] = std::max(r.lower[c.axis], c.at);
    }
    return r;
  }

  /// The part that holds a point.
  std::size_t operator()(const Vec_3& p) const {
    std::size_t k = 0;
    while (k < cuts_.size()) k = 2 * k + (p[cuts_[k].axis] < cuts_[k].at ? 1 : 2);
    return k - cuts_.size();
  }

 private:
  struct Cut {
    int axis = 0;
    double at = 0;
  };

  /// Node k of a binary tree whose nodes are numbered level by level.
  void cut(std::size_t k, std::span<Vec_3> points, double share) {
    if (k >= cuts_.size()) return;
    Cut& c = cuts_[k];
    std::size_t below = 0;
    if (!points.empty()) {
      const Vec_3 sides = extents(points);
      for (int i = 1; i < 3; ++i)
        if (sides[i] > sides[c.axis]) c.axis = i;
      const auto middle = points.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(points.size()));
      std::nth_element(points.begin(), middle, points.end(),
                       [&](const Vec_3& p, const Vec_3& q) { return p[c.axis] < q[c.axis]; });
      c.at = (*middle)[c.axis];
      // Of points that are level with the cut, all go above it: which of them the selection put where must not matter.
      const auto end = std::partition(points.begin(), points.end(), [&](const Vec_3& p) { return p[c.axis] < c.at; });
      below = static_cast<std::size_t>(end - points.begin());
    }
    cut(2 * k + 1, points.first(below), share);
    cut(2 * k + 2, points.subspan(below), share);
  }

  std::vector<Cut> cuts_;
};

}  // namespace pgdr

#endif
