// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_PLC_H
#define PGDR_DOMAIN_PLC_H

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <pgdr/domain/reference_names.h>

namespace pgdr {

/// Index of a vertex, segment, facet or polygon; 0-based everywhere inside the library.
using Index = std::uint32_t;

/// The group of facets that are fused with none.
inline constexpr Index fused_with_none = std::numeric_limits<Index>::max();

/// How enclosed volumes without a hole seed become material (see `Piecewise_linear_complex_3::nesting`).
enum class Nesting {
  fill,      ///< every enclosed volume is meshed (`.poly`, `.smesh`)
  alternate  ///< shells alternate between material and void, counted from the outside (surface files)
};

/// One facet of a PLC as the user wrote it: polygons in one plane, and seeds of its holes.
template <class K>
struct Plc_facet {
  /// Vertex indices. Three or more: a closed loop; two: an internal segment; one: an internal vertex. No polygon at all: no facet.
  std::vector<std::vector<Index>> polygons;
  /// Points of the facet's plane; the part of the facet around each one is removed.
  std::vector<typename K::Point_3> holes;
  /// Kept as the reference of every boundary triangle made from this facet.
  int marker = 0;
  /// Fused only with neighbors of the same group: what `planarize` has made plane together, or `fused_with_none`.
  Index group = 0;
};

/// A segment that the user named explicitly; it is never fused away.
struct Plc_segment {
  Index source = 0;
  Index target = 0;
  int marker = 0;
};

/// A seed that names the subdomain around it.
template <class K>
struct Plc_region {
  typename K::Point_3 point;
  /// Reference written with every tetrahedron of the subdomain.
  int id = 0;
  /// Upper bound of a tetrahedron's volume; not positive: no bound.
  double max_volume = 0;
  /// Upper bound of a tetrahedron's circumradius; not positive: no bound. (No file format has it.)
  double max_circumradius = 0;
};

/// A piecewise linear complex as the user wrote it: not yet merged, fused or checked (that is `Domain_3`).
template <class K>
struct Piecewise_linear_complex_3 {
  using Kernel = K;
  using Point_3 = typename K::Point_3;

  std::vector<Point_3> vertices;
  std::vector<int> vertex_markers;  ///< empty, or one per vertex
  std::vector<Plc_facet<K>> facets;
  std::vector<Plc_segment> segments;
  std::vector<Point_3> holes;  ///< one point in each volume that is not meshed
  std::vector<Plc_region<K>> regions;
  Nesting nesting = Nesting::fill;
  int exponent = 0;  ///< all lengths above are in units of 2^exponent of the user's; see `normalized`

  // Where things stood in the file, for messages only; empty for a PLC made in memory.
  std::size_t first_index = 0;  ///< the number that the file gives its first vertex and its first facet (0 or 1)

  std::string name;       ///< of the whole; the file's, without its folder and extension
  Reference_names names;  ///< of markers and regions
};

}  // namespace pgdr

#endif
