// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MIRRORS_MIRROR_IMAGE_H
#define PGDR_MIRRORS_MIRROR_IMAGE_H

#include <algorithm>
#include <vector>

#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/feature_id.h>
#include <pgdr/domain/region_3.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// Where a point of a feature comes to lie on another one: turned about the segment or the vertex in which they meet at a small angle, or straight
/// across the gap between them.
struct Mirror_image {
  Feature_id on;  ///< the other one
  Vec_3 at;       ///< in its plane, or on it
  bool inherits = true;  ///< whether the insertion radius of the point: nothing between the two is to be refined, or an angle explains how close they are
};

/// A direction, of length 1 at most, that no feature of a part has but by chance. Like places that were exactly alike would make cocircular vertices, and
/// tetrahedra as flat as rounding is between them; what they are off by depends on directions alone, not on numbers, and is the same on both sides of a gap.
inline constexpr Vec_3 aslant{0.35, 0.57, 0.74};

/// The bounding boxes of all facets, with the tolerance within which their vertices are off their planes.
template <class K>
std::vector<Region_3> facet_boxes(const Domain_3<K>& domain) {
  std::vector<Region_3> boxes;
  boxes.reserve(domain.facets.size());
  for (const auto& f : domain.facets) {
    Region_3& box = boxes.emplace_back();
    box.lower = box.upper = to_vec(domain.vertices[f.vertices.front()]);
    for (const Index v : f.vertices) {
      const Vec_3 p = to_vec(domain.vertices[v]);
      for (int k = 0; k < 3; ++k) {
        box.lower[k] = std::min(box.lower[k], p[k] - domain.tolerance);
        box.upper[k] = std::max(box.upper[k], p[k] + domain.tolerance);
      }
    }
  }
  return boxes;
}

}  // namespace pgdr

#endif
