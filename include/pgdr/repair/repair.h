// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPAIR_REPAIR_H
#define PGDR_REPAIR_REPAIR_H

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <pgdr/domain/default_kernel.h>

namespace pgdr {

/// How far `repair` may go; lengths in the unit of the input.
struct Repair_options {
  /// Cracks up to this wide are closed, and vertices may move by as much.
  double tolerance = 0;
  /// Holes are filled whose rim fits into a box with a diagonal up to this, and, unless it is 0, all that are one triangle.
  double largest_hole = 0;
};

/// What `repair` did.
struct Repair_report {
  std::size_t merged_vertices = 0;      ///< equal to another one, or as close as the tolerance across a crack
  std::size_t degenerate_triangles = 0; ///< without area: taken away
  std::size_t duplicate_triangles = 0;  ///< the same corners as another one: taken away
  std::size_t closed_cracks = 0;        ///< edges on the rim of a crack that were divided at vertices on its other side
  std::size_t filled_holes = 0;
  std::size_t filling_triangles = 0;
  std::size_t turned_triangles = 0;     ///< oriented unlike their neighbors, or of a shell that was inside out
  std::size_t intersecting_pairs = 0;   ///< triangles that met other than in common vertices and edges
  std::size_t inner_triangles = 0;      ///< with the inside, or the outside, on both sides: taken away
  std::size_t overlaps = 0;             ///< volumes that more than one part claimed: the last one has them
  double largest_move = 0;              ///< of a vertex of the input

  bool is_none() const {
    return merged_vertices + degenerate_triangles + duplicate_triangles + closed_cracks + filled_holes + turned_triangles + intersecting_pairs +
               inner_triangles == 0;
  }
};

/// Makes a valid PLC of triangles and simple polygons as files have them: with duplicates, cracks, holes, wrong orientations, and
/// self-intersections.
///
/// Intersections are computed exactly, then rounded to a grid, which may bring others about, and so again until there are none; sheets that part by less than
/// a tenth of the tolerance become one. What is inside
/// is decided for each volume that results, by generalized winding numbers (Jacobson, Kavan, Sorkine-Hornung 2013) with respect to the
/// triangles of one connected group, oriented consistently; groups that do not touch each other alternate between material and void.
/// \return triangles that bound what is inside, and nothing else; `plc` itself where nothing had to be done. Seeds are kept.
/// Throws `Input_error` with what cannot be repaired: larger holes, sheets that enclose nothing, intersections that rounding always brings back.
Plc repair(const Plc& plc, const Repair_options& options, Repair_report* report = nullptr);

/// The same with several parts of an assembly, each of which becomes a region: they share triangles where they touch. Where parts overlap, the
/// later one owns the overlap. Facets get the position of their part, from 1, as their marker, where they have none, regions as their id; both
/// are called as the part is. Markers that have names, as those of surface files, or that two parts use, get other numbers, and names
/// with that of the part. Throws `Input_error` also for a part with regions, holes or facets inside.
Plc assemble(std::span<const Plc> parts, const Repair_options& options, Repair_report* report = nullptr);

}  // namespace pgdr

#endif
