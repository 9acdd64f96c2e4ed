// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that are hardly more than an edge or a vertex.
#include <algorithm>
#include <map>
#include <vector>

#include "edge_divider.h"
#include "steps.h"

namespace pgdr::repair_detail {

namespace {

bool is_collapsed(const Triangle& t) {
  const Corners& c = t.corners;
  return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
}

/// Counts a triangle with the same corners.
void add(Triangle& t, const Triangle& other) {
  t.times += sorted_corners(t.corners).second == sorted_corners(other.corners).second ? other.times : -other.times;
  if (t.times >= 0) return;
  t = {other.corners, other.part, other.facet, other.marker, -t.times};
}

/// Makes triangles one with their longest edges, or their shortest edges with a vertex.
class Flat_triangle_closer : Edge_divider {
 public:
  Flat_triangle_closer(Soup& soup, double& largest_move, std::size_t first, double limit) : Edge_divider(soup, largest_move), first_(first), limit_(limit) {}

  bool run() {
    bool some = false;
    for (std::size_t t = 0; t < is_changed_.size(); ++t) some |= close(t);
    end();
    return some;
  }

 private:
  bool close(std::size_t t) {
    const Corners c = soup_.triangles[t].corners;
    if (is_changed_[t]) return false;
    const auto side = [&](std::size_t i) { return length(soup_.points[c[(i + 1) % 3]] - soup_.points[c[(i + 2) % 3]]); };
    const std::size_t apex = side(0) >= side(1) && side(0) >= side(2) ? 0 : side(1) >= side(2) ? 1 : 2;
    const double limit = t < first_ ? 0 : limit_;
    if (has_area(soup_, c) && !(2 * area(soup_, soup_.triangles[t]) <= limit * side(apex))) return false;
    const Index v = c[apex], a = c[(apex + 1) % 3], b = c[(apex + 2) % 3];
    for (const Index end : {a, b})
      if (length(soup_.points[end] - soup_.points[v]) <= limit) return merge(v, end);
    return divide_edges({{sorted_pair(a, b), v}});
  }

  std::size_t first_;
  double limit_;
};

/// Of triangles with the same corners; and takes those away that have two in one place.
void keep_one_of_each(Soup& soup) {
  std::map<Corners, std::size_t> first;
  std::size_t left = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const Triangle triangle = soup.triangles[t];
    if (is_collapsed(triangle)) continue;
    const auto [it, is_new] = first.try_emplace(sorted_corners(triangle.corners).first, left);
    if (is_new)
      soup.triangles[left++] = triangle;
    else if (Triangle& same = soup.triangles[it->second]; !soup.is_cycle && same.part < triangle.part)
      same = triangle;
    else if (soup.is_cycle)
      add(same, triangle);
  }
  soup.triangles.resize(left);
  std::erase_if(soup.triangles, [](const Triangle& t) { return t.times == 0; });
}

}  // namespace

void close_flat_triangles(Soup& soup, double& largest_move, std::size_t first, double limit) {
  constexpr int most_sweeps = 64;
  first = std::min(first, soup.triangles.size());
  for (int sweep = 0; sweep < most_sweeps && Flat_triangle_closer(soup, largest_move, first, limit).run(); ++sweep) {
    first -= static_cast<std::size_t>(std::count_if(soup.triangles.begin(), soup.triangles.begin() + static_cast<std::ptrdiff_t>(first), is_collapsed));
    std::erase_if(soup.triangles, is_collapsed);
  }
  keep_one_of_each(soup);
  std::erase_if(soup.triangles, [&](const Triangle& t) { return !has_area(soup, t.corners); });  // what the sweeps left
}

}  // namespace pgdr::repair_detail
