// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_FEATURES_IN_THE_WAY_3_H
#define PGDR_REFINEMENT_FEATURES_IN_THE_WAY_3_H

#include <cstdint>
#include <optional>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mesh/mesh_triangulation_3.h>

namespace pgdr {

/// Whether p would delete an edge of c, which is in conflict with it: all cells around the edge are.
template <class Tr>
bool deletes_edge(const Tr& tr, typename Tr::Cell_handle c, int i, int j, const typename Tr::Point& p) {
  auto around = tr.incident_cells(c, i, j);
  const auto done = around;
  while (++around != done)
    if (!tr.in_conflict(around, p)) return false;
  return true;
}

/// A subsegment on the cell, in conflict with p, that p encroaches or, if that is asked for, would delete; or none.
template <class Tr>
std::uint32_t subsegment_in_the_way(const Tr& tr, const Constraint_complex_3<Tr>& complex, typename Tr::Cell_handle c, const typename Tr::Point& p,
                                    bool or_deletes = true) {
  constexpr std::uint32_t none = Constraint_complex_3<Tr>::none;
  if (c->subsegment_edges() == 0) return none;
  const Vec_3 at = to_vec(p);
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      if (!(c->subsegment_edges() & edge_bit(i, j))) continue;
      // Where p does not see it at more than a right angle it does not encroach it; but for rounding, for which the cavity
      // is looked through again in the end.
      const bool may_encroach = dot(position(c->vertex(i)) - at, position(c->vertex(j)) - at) <= 0;
      const auto is_deleted = [&] { return or_deletes && deletes_edge(tr, c, i, j, p); };
      if (!may_encroach && !is_deleted()) continue;
      const std::uint32_t s = complex.find_subsegment(c->vertex(i), c->vertex(j));
      if (s != none && (!may_encroach || is_encroached(complex.subsegment(s), p) || is_deleted())) return s;
    }
  return none;
}

/// A subfacet on the cell in whose equatorial ball p lies.
template <class Tr>
std::optional<typename Tr::Facet> encroached_subfacet_of(const Constraint_complex_3<Tr>& complex, typename Tr::Cell_handle c,
                                                         const typename Tr::Point& p) {
  if (c->has_subfacet())
    for (int i = 0; i < 4; ++i)
      if (c->subfacet(i) != Constraint_complex_3<Tr>::none && is_encroached(complex.subfacet(c->subfacet(i)), p)) return typename Tr::Facet(c, i);
  return std::nullopt;
}

}  // namespace pgdr

#endif
