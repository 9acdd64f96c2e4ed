// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/patches.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <vector>

#include <boost/pending/disjoint_sets.hpp>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {
namespace {

/// A facet's side: from the smaller to the larger vertex, or the other way around.
struct Side {
  std::array<Index, 2> ends;
  Index facet;
  bool runs_forward;
  bool operator<(const Side& o) const { return std::tie(ends, facet, runs_forward) < std::tie(o.ends, o.facet, o.runs_forward); }
};

/// Of a polygon (Newell's), of any length.
Vec_3 normal_of(const std::vector<Vec_3>& points, const std::vector<Index>& polygon) {
  Vec_3 normal{0, 0, 0};
  const Vec_3 origin = points[polygon[0]];
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) normal = normal + cross(points[polygon[i]] - origin, points[polygon[i + 1]] - origin);
  return normal;
}

}  // namespace

std::size_t mark_patches(Plc& plc, double angle_deg) {
  std::vector<Vec_3> points;
  for (const auto& p : plc.vertices) points.push_back(to_vec(p));
  const std::vector<Index> first = domain_detail::first_equal_vertex(points, std::vector<char>(points.size(), 0));
  std::vector<Vec_3> normals(plc.facets.size(), Vec_3{0, 0, 0});
  std::vector<Side> sides;
  for (Index f = 0; f < plc.facets.size(); ++f) {
    const auto& facet = plc.facets[f];
    if (facet.marker != 0 || facet.polygons.size() != 1 || facet.polygons[0].size() < 3) continue;
    const auto& polygon = facet.polygons[0];
    normals[f] = normal_of(points, polygon);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Index a = first[polygon[i]], b = first[polygon[(i + 1) % polygon.size()]];
      sides.push_back({{std::min(a, b), std::max(a, b)}, f, a < b});
    }
  }
  std::ranges::sort(sides, [](const Side& a, const Side& b) { return a < b; });

  std::vector<Index> rank(plc.facets.size()), parent(plc.facets.size());
  boost::disjoint_sets<Index*, Index*> patches(rank.data(), parent.data());
  for (Index f = 0; f < plc.facets.size(); ++f) patches.make_set(f);
  const double least_cosine = cosine_of_degrees(angle_deg);
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    while (j < sides.size() && sides[j].ends == sides[i].ends) ++j;
    if (j - i != 2 || sides[i].facet == sides[i + 1].facet) continue;
    const Vec_3 &m = normals[sides[i].facet], &n = normals[sides[i + 1].facet];
    const double along = (sides[i].runs_forward == sides[i + 1].runs_forward ? -1 : 1) * dot(m, n);
    if (along >= least_cosine * length(m) * length(n)) patches.union_set(sides[i].facet, sides[i + 1].facet);
  }

  std::set<int> taken;
  for (const auto& facet : plc.facets) taken.insert(facet.marker);
  std::vector<int> marker(plc.facets.size(), 0);  // by the set's representative
  std::size_t count = 0;
  int last = 0;
  for (Index f = 0; f < plc.facets.size(); ++f) {
    if (plc.facets[f].marker != 0) continue;
    int& m = marker[patches.find_set(f)];
    if (m == 0) {
      do ++last;
      while (taken.contains(last));
      m = last;
      ++count;
    }
    plc.facets[f].marker = m;
  }
  return count;
}

}  // namespace pgdr
