// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>

#include "steps.h"

namespace pgdr::repair_detail {

namespace {

/// Edges with one triangle of their part, the other way round than that runs: as what fills a hole would run.
struct Rim {
  struct Step {
    Index target;
    Index triangle;
    bool is_used = false;
  };
  std::multimap<std::pair<Index, Index>, Step> steps;  ///< by part and source

  explicit Rim(const Soup& soup) {
    const Triangle_edges all(soup.triangles);
    all.for_each([&](std::size_t i, std::size_t j) {
      for (std::size_t k = i; k < j; ++k) {
        const auto& e = all.edges[k];
        const Index part = soup.triangles[e.triangle].part;
        std::size_t of_part = 0;
        for (std::size_t l = i; l < j; ++l) of_part += soup.triangles[all.edges[l].triangle].part == part;
        if (of_part == 1) steps.insert({{part, e.ends[e.runs_forward ? 1 : 0]}, {e.ends[e.runs_forward ? 0 : 1], e.triangle}});
      }
    });
  }

  Step* next(Index part, Index v) {
    const auto [begin, end] = steps.equal_range({part, v});
    for (auto it = begin; it != end; ++it)
      if (!it->second.is_used) return &it->second;
    return nullptr;
  }
};

/// Walks that come back to where they began, without vertices twice.
std::vector<Hole> find_holes(const Soup& soup) {
  std::vector<Hole> holes;
  Rim rim(soup);
  for (auto& [place, first] : rim.steps) {
    if (first.is_used) continue;
    const Index part = place.first;
    std::vector<Index> walk{place.second};
    for (Rim::Step* step = &first; step != nullptr; step = walk.empty() ? nullptr : rim.next(part, walk.back())) {
      step->is_used = true;
      const auto before = std::ranges::find(walk, step->target);
      if (before == walk.end()) {
        walk.push_back(step->target);
        continue;
      }
      Hole& hole = holes.emplace_back();
      hole.rim.assign(before, walk.end());
      hole.triangle = step->triangle;
      hole.diameter = diameter(soup.points, hole.rim);
      walk.erase(before + 1, walk.end());
    }
  }
  return holes;
}

bool fill(Soup& soup, const Hole& hole, Repair_report& report) {
  if (hole.rim.size() < 3) return false;
  const std::vector<Corners> patch = triangulated(soup.points, hole.rim);
  if (patch.empty()) return false;
  for (const Corners& c : patch) {
    Triangle filling = soup.triangles[hole.triangle];
    filling.corners = c;
    filling.marker = 0;  // it is part of no patch
    soup.triangles.push_back(filling);
  }
  ++report.filled_holes;
  report.filling_triangles += patch.size();
  return true;
}

}  // namespace

std::vector<Hole> fill_holes(Soup& soup, double largest, Repair_report& report) {
  std::vector<Hole> holes = find_holes(soup);
  // A single triangle that is missing can only be that one, whatever its size.
  const auto is_small = [&](const Hole& hole) { return hole.diameter <= largest || (largest > 0 && hole.rim.size() == 3); };
  std::erase_if(holes, [&](const Hole& hole) { return is_small(hole) && fill(soup, hole, report); });
  std::ranges::stable_sort(holes, [](const Hole& a, const Hole& b) { return a.diameter > b.diameter; });
  return holes;
}

}  // namespace pgdr::repair_detail
