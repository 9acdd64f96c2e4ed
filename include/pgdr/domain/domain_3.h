// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DOMAIN_3_H
#define PGDR_DOMAIN_DOMAIN_3_H

#include <array>
#include <cstddef>
#include <vector>

#include <pgdr/domain/plc.h>

namespace pgdr {

/// The PLC as understood: exact duplicates merged, coplanar facets fused, every fused facet triangulated.
///
/// Everything downstream (the mesher, the checker, `pgdr info`) reads this, never the raw PLC.
/// Invariants: segments and facet triangles meet only in common vertices and segments (when
/// `validate_domain_3` finds nothing); every boundary edge of a facet is a segment.
template <class K>
struct Domain_3 {
  using Kernel = K;
  using Point_3 = typename K::Point_3;

  /// A straight edge of the complex that every mesh keeps: where facets end, meet or change, or that the user named.
  struct Segment {
    std::array<Index, 2> vertices;  ///< smaller index first
    int marker = 0;                 ///< of an explicit segment; 0 else
    std::vector<Index> facets;      ///< fused facets that it bounds or lies in, ascending, each once
  };

  /// A planar piece of the complex: one or several input facets, fused.
  struct Facet {
    int marker = 0;
    std::array<double, 3> origin{};  ///< a point of the reference plane (of the group's largest input facet)
    std::array<double, 3> normal{};  ///< unit normal of that plane; exactly (+-1,0,0), (0,+-1,0), (0,0,+-1) on axis-aligned facets
    std::vector<Index> input_facets;  ///< input facets that it was fused from, ascending
    std::vector<Index> segments;      ///< on its boundary and inside it, ascending
    std::vector<Index> vertices;      ///< all its vertices (corners, ends of segments, isolated points), ascending
    /// Its region as triangles: a constrained Delaunay triangulation of `vertices` and `segments`
    /// in the plane, holes left out, each counterclockwise as seen from the tip of `normal`.
    std::vector<std::array<Index, 3>> triangles;
  };

  std::vector<Point_3> vertices;            ///< distinct
  std::vector<int> vertex_markers;          ///< one per vertex
  std::vector<Index> input_vertex;          ///< for each vertex, the first input vertex with these coordinates
  std::vector<Segment> segments;
  std::vector<Facet> facets;
  std::vector<Point_3> holes;
  std::vector<Plc_region<K>> regions;
  Nesting nesting = Nesting::fill;

  std::array<double, 3> lower{};  ///< of the bounding box
  std::array<double, 3> upper{};
  double diagonal = 0;            ///< of the bounding box
  double tolerance = 0;           ///< absolute distance within which facets were fused
  std::size_t duplicate_vertices = 0;  ///< merged
  int exponent = 0;               ///< all lengths above are in units of 2^exponent of the user's
  std::size_t first_index = 0;    ///< see `Piecewise_linear_complex_3`
  Reference_names names;          ///< of markers and regions
};

}  // namespace pgdr

#endif
