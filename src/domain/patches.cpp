// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/patches.h>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <set>
#include <vector>

#include <boost/pending/disjoint_sets.hpp>

#include <pgdr/domain/detail/facet_plane.h>
#include <pgdr/domain/detail/planar_triangulation.h>
#include <pgdr/domain/free_numbers.h>
#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {
namespace {

/// A facet's side, and whether it runs from the first of its ends to the second.
struct Side {
  domain_detail::Index_pair ends;  ///< ascending
  Index facet;
  bool runs_forward;
  friend auto operator<=>(const Side&, const Side&) = default;
};

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
    normals[f] = domain_detail::twice_area_vector(points, polygon);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Index a = first[polygon[i]], b = first[polygon[(i + 1) % polygon.size()]];
      sides.push_back({domain_detail::sorted_pair(a, b), f, a < b});
    }
  }
  std::ranges::sort(sides);

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
  Free_numbers numbers(taken);
  for (Index f = 0; f < plc.facets.size(); ++f) {
    if (plc.facets[f].marker != 0) continue;
    int& m = marker[patches.find_set(f)];
    if (m == 0) {
      m = numbers.next();
      ++count;
    }
    plc.facets[f].marker = m;
  }
  return count;
}

}  // namespace pgdr
