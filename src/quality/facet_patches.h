// SPDX-License-Identifier: GPL-3.0-or-later
// Private to src/quality: which facet of the domain each triangle of a mesh belongs to.
#ifndef PGDR_SRC_QUALITY_FACET_PATCHES_H
#define PGDR_SRC_QUALITY_FACET_PATCHES_H

#include <array>
#include <cstdint>
#include <vector>

#include "check_parts.h"

namespace pgdr::quality_detail {

/// One edge of one triangle of a mesh.
struct Triangle_edge {
  std::uint32_t first, second;  ///< ascending
  std::uint32_t triangle;
  bool listed;  ///< whether it is an edge of the mesh, that is, on a segment
  bool operator<(const Triangle_edge& o) const {
    return first != o.first     ? first < o.first
           : second != o.second ? second < o.second
                                : triangle < o.triangle;
  }
  bool same_edge(const Triangle_edge& o) const { return first == o.first && second == o.second; }
};

/// The edges of all triangles, sorted.
std::vector<Triangle_edge> triangle_edges(const Indexed_mesh_3& mesh);

/// For each triangle the facet it lies in, `none` if it is in no expected part of any.
///
/// Facets end at segments, so triangles that share an edge which is not listed are of one facet: a patch. A
/// patch is of the facet nearest to its largest triangle, since small triangles beside a segment may be
/// within the tolerance of several facets.
std::vector<std::uint32_t> facets_of_triangles(const Indexed_mesh_3& mesh, const Epick_domain& domain,
                                               const Expected& expected,
                                               const std::vector<Triangle_edge>& edges);

}  // namespace pgdr::quality_detail

#endif
