// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_PLANARIZE_H
#define PGDR_SIMPLIFY_PLANARIZE_H

#include <cstddef>
#include <optional>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/input_error.h>

namespace pgdr {

/// What `planarize` did.
struct Planarization {
  std::size_t flattened_facets = 0;  ///< fused facets that were bent and are plane now
  std::size_t bent_facets = 0;       ///< that stay bent: their vertices would have to move too far
  std::size_t moved_vertices = 0;
  double largest_change = 0;  ///< of a vertex, off the plane of a facet that it is on

  bool is_none() const { return moved_vertices == 0; }
};

/// What is known of its result: with a million facets it takes seconds to find out.
struct Planarized {
  std::optional<Domain_3<Default_kernel>> domain;       ///< what `make_domain_3` makes of it
  std::optional<std::vector<Input_problem>> problems;  ///< what `validate_domain_3` finds in that
};

/// Moves vertices so that fused facets are plane to double precision.
///
/// A facet of a PLC is plane: that is what the theory of refinement is about. Facets that `make_domain_3` fused are bent by as much as its
/// tolerance, in files of single precision nearly all. Where features are as close to each other as that, a bent facet is none: its
/// triangles cannot all be in one Delaunay triangulation.
///
/// The move is the smallest one, in the sense of least squares, that makes the facets plane: Newton's method on the vertices and the planes
/// together. A polyhedron has enough freedom for that in general (more than its number of edges: Euler's formula). Facets on axis-aligned
/// planes stay there. A facet whose vertices would have to leave the planes they are on by more than the tolerance stays as it is, and so
/// does one that would intersect another or fall onto it: a dihedral angle below 60 degrees that would become less than half of
/// what it was. (Within noise it may, if facets would intersect otherwise.) The facets of the result are grouped as they are plane, so that `make_domain_3` fuses these and no others.
/// \param coplanar_tolerance, triangulate as `make_domain_3` will understand the PLC. The tolerance is the limit, too; along their facets
///   vertices may move up to 16 times as far, which is what facets at small angles to each other need.
/// \param fusings how often triangles are fused: others may lie within the tolerance of one plane once their vertices have moved. Not until there are no
///   others, since a smooth surface would become ever larger facets
/// \return `plc` itself where nothing was to be done. Throws what `make_domain_3` throws
Plc planarize(const Plc& plc, double coplanar_tolerance, bool triangulate = false, Planarization* done = nullptr,
              Planarized* result = nullptr, int fusings = 2);

}  // namespace pgdr

#endif
