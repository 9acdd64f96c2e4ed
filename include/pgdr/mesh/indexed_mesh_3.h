// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_INDEXED_MESH_3_H
#define PGDR_MESH_INDEXED_MESH_3_H

#include <array>
#include <cstdint>
#include <vector>

#include <pgdr/domain/reference_names.h>

namespace pgdr {

/// A finished tetrahedral mesh as plain arrays in canonical order: what files hold and what the checker reads.
///
/// Indices are 0-based. Tetrahedra are positively oriented: for (a,b,c,d), det(b-a, c-a, d-a) > 0.
struct Indexed_mesh_3 {
  using Point = std::array<double, 3>;

  std::vector<Point> points;                     ///< in units of 2^exponent of the user's
  int exponent = 0;                              ///< not 0 only where coordinates are very large or small; see `normalized`
  std::vector<std::int32_t> point_references;    ///< the input vertex's marker; 0 for Steiner points
  std::vector<std::uint8_t> point_dimensions;    ///< `in_dimension`: 0 corner, 1 segment, 2 facet, 3 volume; may be empty (a `.mesh` file does not hold it)

  std::vector<std::array<std::uint32_t, 2>> edges;  ///< subsegments
  std::vector<std::int32_t> edge_references;

  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< subfacets, internal ones included, each once
  std::vector<std::int32_t> triangle_references;        ///< the input facet's marker
  std::vector<std::uint32_t> triangle_input_facets;     ///< the facet of the file that the centroid lies on, as the file counts; may be empty

  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  std::vector<std::int32_t> tetrahedron_references;  ///< region id
  /// Ascending positions in `tetrahedra`, neither of them in `.mesh`: of those over the ratio bound next to small angles of the input,
  std::vector<std::uint32_t> exempt;
  /// and of those over a bound, of ratio or size, that a limit or a cancelled run left.
  std::vector<std::uint32_t> unrefined;

  Reference_names names;  ///< of `triangle_references` and `tetrahedron_references`

  /// Nodes in the middle of edges, positions in `points`; empty in a mesh of first order (see `add_midside_nodes`). Of a tetrahedron those of
  /// its edges 01, 12, 20, 03, 13, 23; of a triangle 01, 12, 20.
  std::vector<std::array<std::uint32_t, 6>> tetrahedron_nodes;
  std::vector<std::array<std::uint32_t, 3>> triangle_nodes;
  std::vector<std::uint32_t> edge_nodes;
};

}  // namespace pgdr

#endif
