// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_BOX_PAIRS_H
#define PGDR_DOMAIN_DETAIL_BOX_PAIRS_H

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_reduce.h>
#include <pgdr/parallel/parallel_sort.h>

namespace pgdr::domain_detail {

/// Cuts boxes into slabs along the longest axis of all, by where they begin; `Box` is a `CGAL::Box_intersection_d::Box_with_info_d` with numbers.
/// CGAL's own parallel version copies all boxes four times and takes the pairs at once.
template <class Box>
class Box_slabs {
 public:
  explicit Box_slabs(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    CGAL::Bbox_3 all;
    for (const Box& box : boxes_) all += box.bbox();
    for (const int d : {1, 2})
      if (all.max(d) - all.min(d) > all.max(axis_) - all.min(axis_)) axis_ = d;
    parallel_sort(boxes_.begin(), boxes_.end(), [axis = axis_](const Box& a, const Box& b) {
      return std::pair(a.min_coord(axis), a.info()) < std::pair(b.min_coord(axis), b.info());
    });
  }

  /// What `look(a, b, list)` adds to lists for each pair of the boxes that meet, slab by slab.
  template <class Item, class Look>
  std::vector<Item> pairs(const Look& look) const {
    return parallel_collect(boxes_.size(), grain(), [&](std::size_t first, std::size_t last) {
      // Each pair is found in the slab where the later of the two begins.
      std::vector<Box> own = slab(first, last), reaching = reaching_into(own.front().min_coord(axis_), first);
      std::vector<Item> list;
      const auto found = [&](const Box& a, const Box& b) { look(a, b, list); };
      CGAL::box_self_intersection_d(own.begin(), own.end(), found);
      CGAL::box_intersection_d(own.begin(), own.end(), reaching.begin(), reaching.end(), found);
      return list;
    });
  }

  /// Calls `look(a, b)` for each of these boxes and each of the others that meet: of one a never twice at once.
  template <class Look>
  void for_each_with(const Box_slabs& others, const Look& look) const {
    parallel_for_chunks(boxes_.size(), grain(), [&](std::size_t first, std::size_t last) {
      std::vector<Box> own = slab(first, last);
      double end = own.front().max_coord(others.axis_), begin = own.front().min_coord(others.axis_);
      for (const Box& box : own) {
        begin = std::min(begin, box.min_coord(others.axis_));
        end = std::max(end, box.max_coord(others.axis_));
      }
      const auto past = std::ranges::upper_bound(others.boxes_, end, {}, [&](const Box& box) { return box.min_coord(others.axis_); });
      std::vector<Box> near = others.reaching_into(begin, static_cast<std::size_t>(past - others.boxes_.begin()));
      CGAL::box_intersection_d(own.begin(), own.end(), near.begin(), near.end(), look);
    });
  }

 private:
  /// Boxes of a slab: no fewer than are worth a task; and not many slabs, since large boxes are looked at in all that they reach into.
  std::size_t grain() const { return std::max<std::size_t>(default_grain, boxes_.size() / 32 + 1); }

  std::vector<Box> slab(std::size_t first, std::size_t last) const {
    return {boxes_.begin() + static_cast<std::ptrdiff_t>(first), boxes_.begin() + static_cast<std::ptrdiff_t>(last)};
  }

  /// Those of the first n that end at `from` or later.
  std::vector<Box> reaching_into(double from, std::size_t n) const {
    std::vector<Box> result;
    std::copy_if(boxes_.begin(), boxes_.begin() + static_cast<std::ptrdiff_t>(n), std::back_inserter(result), [&](const Box& box) { return box.max_coord(axis_) >= from; });
    return result;
  }

  std::vector<Box> boxes_;
  int axis_ = 0;
};

}  // namespace pgdr::domain_detail

#endif
