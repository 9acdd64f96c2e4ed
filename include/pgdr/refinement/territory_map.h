// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_TERRITORY_MAP_H
#define PGDR_REFINEMENT_TERRITORY_MAP_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <pgdr/domain/region_3.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// Divides space into parts with about as many of the sample items in each, by recursive coordinate bisection (Berger and
/// Bokhari, IEEE Trans. Computers 36, 1987): across the longest side, or another one
/// with far fewer items on both sides of the cut.
class Territory_map {
 public:
  /// Where work is to be done, and the box of what has to be in one part for that.
  struct Item {
    Vec_3 at;
    Region_3 box;
  };

  /// Parts are a power of two. Every cut leaves the given share of the items below it; another share moves the borders.
  /// The order of the items does not matter.
  Territory_map(std::vector<Item> sample, std::size_t parts, double share) : cuts_(parts - 1) { cut(0, sample, share); }

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
  void cut(std::size_t k, std::span<Item> items, double share) {
    if (k >= cuts_.size()) return;
    Cut& c = cuts_[k];
    std::size_t below = 0;
    if (!items.empty()) {
      c = best_cut(items, share);
      // Of items that are level with the cut, all go above it: which of them the selection put where must not matter.
      const auto end = std::partition(items.begin(), items.end(), [&](const Item& p) { return p.at[c.axis] < c.at; });
      below = static_cast<std::size_t>(end - items.begin());
    }
    cut(2 * k + 1, items.first(below), share);
    cut(2 * k + 2, items.subspan(below), share);
  }

  static Cut best_cut(std::span<Item> items, double share) {
    std::array<int, 3> axes{0, 1, 2};
    const Vec_3 sides = extents(items);
    std::ranges::stable_sort(axes, std::greater{}, [&](int axis) { return sides[axis]; });
    Cut best;
    std::size_t fewest = 0;
    for (const int axis : axes) {
      const Cut c = median_cut(items, axis, share);
      const auto across = static_cast<std::size_t>(
          std::ranges::count_if(items, [&](const Item& p) { return p.box.lower[axis] < c.at && c.at <= p.box.upper[axis]; }));
      if (axis != axes[0] && fewer * across >= fewest) continue;
      best = c;
      fewest = across;
      if (fewest == 0) break;
    }
    return best;
  }

  static Cut median_cut(std::span<Item> items, int axis, double share) {
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(items.size()));
    std::nth_element(items.begin(), middle, items.end(), [&](const Item& p, const Item& q) { return p.at[axis] < q.at[axis]; });
    return {axis, middle->at[axis]};
  }

  static Vec_3 extents(std::span<const Item> items) {
    Vec_3 sides;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [first, last] = std::ranges::minmax_element(items, {}, [&](const Item& p) { return p.at[axis]; });
      sides[axis] = last->at[axis] - first->at[axis];
    }
    return sides;
  }

  /// A shorter side is divided where by this factor fewer items are across: parts are to be compact, for the sake of cavities.
  static constexpr std::size_t fewer = 2;

  std::vector<Cut> cuts_;
};

}  // namespace pgdr

#endif
