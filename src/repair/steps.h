// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SRC_REPAIR_STEPS_H
#define PGDR_SRC_REPAIR_STEPS_H

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/detail/planar_triangulation.h>
#include <pgdr/domain/input_error.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/repair/repair.h>

namespace pgdr::repair_detail {

using Corners = std::array<Index, 3>;
using domain_detail::Index_pair;
using domain_detail::sorted_pair;

struct Triangle {
  Corners corners;
  Index part = 0;   ///< of an assembly
  Index facet = 0;  ///< of the input; for messages
  int marker = 0;
  int times = 1;    ///< how many there are of it
};

/// Triangles without any connection but equal vertices.
struct Soup {
  std::vector<Vec_3> points;
  std::vector<Triangle> triangles;
  /// Whether each edge is run through as often in either direction. Then triangles that face each other in one place are none: what is closed stays so without
  /// them.
  bool is_cycle = false;
};

/// Directed edges of triangles, and who they belong to.
struct Triangle_edges {
  struct Edge {
    Index_pair ends;     ///< ascending
    Index triangle;
    bool runs_forward;   ///< along `ends` in the triangle
    friend auto operator<=>(const Edge&, const Edge&) = default;
  };
  explicit Triangle_edges(const std::vector<Triangle>& triangles);
  /// f(first, last) for the edges of each pair of ends.
  template <class F>
  void for_each(F f) const {
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
      while (j < edges.size() && edges[j].ends == edges[i].ends) ++j;
      f(i, j);
    }
  }
  std::vector<Edge> edges;  ///< ascending
};

/// The same for all triangles with the same corners, and whether it takes an odd permutation to get there.
std::pair<Corners, bool> sorted_corners(Corners c);

/// Of the bounding box of some vertices: the length of its diagonal.
double diameter(const std::vector<Vec_3>& points, const std::vector<Index>& vertices);

/// As few and as small triangles over a closed polygon as can be, oriented as it runs; it need not be plane. Empty where there are none.
std::vector<Corners> triangulated(const std::vector<Vec_3>& points, const std::vector<Index>& polygon);

/// The facets of a PLC as triangles, equal vertices merged. Throws `Input_error` for facets with holes or several polygons.
void add_to_soup(Soup& soup, const Plc& plc, Index part, Repair_report& report);

/// Takes away triangles without area, and all but one of those with the same corners in one part.
void remove_degenerate(Soup& soup, Repair_report& report);

/// Merges vertices on the rims of cracks, and divides rims where vertices of the other side lie on them, both within the tolerance.
void close_cracks(Soup& soup, double tolerance, Repair_report& report);

/// Makes triangles without area one with their longest edges, in all of whose triangles their third corners are then, and those from a position on, too, if
/// they are lower than a limit, or two of their corners as close as that. What is closed stays so.
/// Triangles with the same corners, whichever way they face, become one of the last part, or, of a cycle, one that counts for all of them, or none.
void close_flat_triangles(Soup& soup, double& largest_move, std::size_t first = static_cast<std::size_t>(-1), double limit = 0);

/// Makes sheets one that leave an edge together, until they part by more than the tolerance: each gets the other's vertices, and a vertex where edges of both
/// cross. Triangles that are low themselves are left. \return how many pairs of triangles it divided; some may intersect then. 0, too, where that divides too
/// much to lead anywhere: the soup is of no use then
std::size_t close_wedges(Soup& soup, double tolerance, double& largest_move);

/// Orients the triangles of each shell like their neighbors, and most of them as they were.
void orient_shells(Soup& soup, Repair_report& report);

/// A closed walk along edges that belong to one triangle only.
struct Hole {
  std::vector<Index> rim;  ///< as triangles that fill it run through it
  double diameter = 0;     ///< of its box
  Index triangle = 0;      ///< one at its rim
};
/// Fills the holes that are small enough, and single missing triangles. \return the others, the largest first
std::vector<Hole> fill_holes(Soup& soup, double largest, Repair_report& report);

/// Pairs of triangles that meet other than in common vertices and edges.
std::vector<std::pair<Index, Index>> meeting_pairs(const Soup& soup);

/// Divides triangles until they meet in common vertices and edges only. What covers another one of the same part exactly is gone; of several
/// parts, the last one's is left. `pairs`: `meeting_pairs(soup)`. Throws `Input_error` if rounding always makes new intersections.
Soup arrangement(const Soup& soup, std::vector<std::pair<Index, Index>> pairs, double tolerance, Repair_report& report);

bool has_area(const Soup& soup, const Corners& c);
double area(const Soup& soup, const Triangle& t);
/// Of the tetrahedron that it spans with the origin, positive where that is behind it.
double signed_volume(const Soup& soup, const Triangle& t, const Vec_3& origin);

/// How often the triangles wind around a point (Jacobson et al. 2013).
double winding_number(const std::vector<Vec_3>& points, const std::vector<Corners>& triangles, const Vec_3& at);

/// Turns shells that are inside out, and numbers groups of triangles that hang together.
/// \return the group of each triangle. \pre `orient_shells`
std::vector<Index> orient_groups(Soup& soup, const std::vector<std::pair<Index, Index>>& pairs, Repair_report& report);

/// The triangles as facets.
Plc as_plc(const Soup& soup);

/// What `arranged` (the arrangement of `soup`) bounds: triangles with different owners on their sides, and a region for each part if there are several.
/// Pockets thinner than the tolerance are no volumes of their own.
struct Solids {
  Soup surface;
  Plc plc;              ///< the same, and the regions
  std::vector<double> kept;  ///< which part of each group's area is in it
  std::vector<double> hanging;  ///< and which has one volume on both sides
};
Solids solids(const Soup& arranged, const Soup& soup, const std::vector<Index>& group, std::size_t parts, double tolerance, Repair_report& report);

}  // namespace pgdr::repair_detail

#endif
