// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_SEPARATING_SUBFACET_3_H
#define PGDR_REFINEMENT_SEPARATING_SUBFACET_3_H

#include <cstdint>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/mesh/conflict_walk_3.h>
#include <pgdr/mesh/territory_3.h>

namespace pgdr {

/// What a walk in the volume came upon.
struct Separation {
  std::uint32_t subfacet;
  bool is_foreign = false;  ///< the way leads out of the territory
};

/// The first subfacet that a visibility walk from a tetrahedron to p goes through, or none.
///
/// If p is in conflict with the tetrahedron, it is with all on the way, whose balls hold p ever deeper (the power of p falls where a walk
/// in a Delaunay triangulation goes on). So p would delete the subfacet. It lies between p and all that p is to improve, so that it has to be
/// split for that, whatever else of the features p would delete behind it. Mostly no step is needed, since p is in the tetrahedron or next to it.
template <class Tr>
Separation first_subfacet_towards(const Tr& tr, const Territory_3<Tr>& territory, typename Tr::Cell_handle c, const typename Tr::Point& p) {
  constexpr std::uint32_t none = Constraint_complex_3<Tr>::none;
  typename Tr::Cell_handle before = {};
  while (!tr.is_infinite(c)) {
    const int way = way_towards(tr, c, before, p);
    if (way < 0) break;
    if (c->subfacet(way) != none) return {c->subfacet(way)};
    if (!territory.leads_on(c, way)) return {none, true};
    before = c;
    c = c->neighbor(way);
  }
  return {none};
}

}  // namespace pgdr

#endif
