// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SRC_REPAIR_EDGE_DIVIDER_H
#define PGDR_SRC_REPAIR_EDGE_DIVIDER_H

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "steps.h"

namespace pgdr::repair_detail {

/// Divides triangles at their edges, none of them twice, and makes vertices one. What is closed stays so: an edge is divided in all of its triangles.
class Edge_divider {
 public:
  Edge_divider(Soup& soup, double& largest_move)
      : soup_(soup), largest_move_(largest_move), edges_(soup.triangles), is_changed_(soup.triangles.size(), false), merged_(soup.points.size()), is_kept_(soup.points.size(), false) {
    std::iota(merged_.begin(), merged_.end(), Index{0});
  }

 protected:
  /// All triangles at some edges get a vertex there, or none.
  bool divide_edges(const std::vector<std::pair<Index_pair, Index>>& places) {
    std::vector<std::pair<Index, std::size_t>> of;  // triangles, and where
    for (std::size_t i = 0; i < places.size(); ++i)
      for (auto e = std::ranges::lower_bound(edges_.edges, places[i].first, {}, &Triangle_edges::Edge::ends); e != edges_.edges.end() && e->ends == places[i].first; ++e)
        of.emplace_back(e->triangle, i);
    std::ranges::sort(of);
    for (std::size_t i = 0; i < of.size(); ++i)
      if (is_changed_[of[i].first] || (i > 0 && of[i].first == of[i - 1].first)) return false;
    for (const auto& [t, i] : of) {
      const auto& [edge, v] = places[i];
      is_changed_[t] = true;
      Triangle first = soup_.triangles[t], second = first;
      std::ranges::replace(first.corners, edge[1], v);
      std::ranges::replace(second.corners, edge[0], v);
      soup_.triangles[t] = first;
      soup_.triangles.push_back(second);
    }
    return !of.empty();
  }

  /// The later one becomes the other at `end`, unless either has become another already.
  bool merge(Index v, Index w) {
    const auto [kept, gone] = std::minmax(v, w);
    if (merged_[gone] != gone || merged_[kept] != kept || is_kept_[gone]) return false;
    merged_[gone] = kept;
    largest_move_ = std::max(largest_move_, length(soup_.points[v] - soup_.points[w]));
    return is_kept_[kept] = true;
  }
  void end() {
    for (Triangle& t : soup_.triangles)
      for (Index& v : t.corners)
        if (v < merged_.size()) v = merged_[v];
  }

  Soup& soup_;
  double& largest_move_;
  const Triangle_edges edges_;
  std::vector<bool> is_changed_;

 private:
  std::vector<Index> merged_;
  std::vector<bool> is_kept_;  ///< by which others are replaced: they stay
};

}  // namespace pgdr::repair_detail

#endif
