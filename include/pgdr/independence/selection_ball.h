// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_INDEPENDENCE_SELECTION_BALL_H
#define PGDR_INDEPENDENCE_SELECTION_BALL_H

#include <algorithm>

namespace pgdr {

/// Selection balls: the balls around the circumcenter of a poor tetrahedron in which any point may be its Steiner
/// point. In all of this r is the circumradius, l the length of the shortest edge, B >= 2 the bound of r / l.
///
/// A point within s of the circumcenter is at least r - s away from every vertex, since the circumball is empty. If
/// the point encroaches a subfacet, and the subfacet's circumcenter a subsegment, each of the two steps costs a factor
/// of sqrt(2) at most, so that whatever is inserted in the end has no vertex closer than (r - s) / 2. docs/theory.md
/// has the proof; the types are named in A. Chernikov, N. Chrisochoides, *Generalized insertion region guides for
/// Delaunay mesh refinement*, SIAM J. Sci. Comput. 34 (2012).

/// Type I, for r > B l: what is inserted in the end makes no edge shorter than l.
inline double type_1_selection_radius(double r, double l) { return std::max(0.0, r - 2 * l); }

/// Type II, for r > B l: inside type I, and the same fraction of every circumradius; 0 for B = 2.
inline double type_2_selection_radius(double r, double bound) { return std::max(0.0, r * (1 - 2 / bound)); }

/// Fraction of the circumradius that the selection ball of a tetrahedron has that is poor by size alone.
constexpr double size_selection_fraction = 0.25;

/// For a tetrahedron with r <= B l that is larger than the sizing field R asks: what is inserted in the end makes no
/// edge shorter than (1 - delta) R / 2, delta = `size_selection_fraction`.
inline double size_selection_radius(double r) { return size_selection_fraction * r; }

}  // namespace pgdr

#endif
