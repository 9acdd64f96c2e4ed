// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_SHEET_WALK_3_H
#define PGDR_CONFORMING_SHEET_WALK_3_H

#include <cstddef>
#include <cstdint>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/mesh/territory_3.h>

namespace pgdr {

/// Where a walk in a facet came to its end.
struct Sheet_place {
  std::uint32_t subfacet;
  std::uint32_t subsegment;  ///< the one in the way, or none
  bool is_foreign = false;   ///< the way leads out of the territory
};

/// Walks in the sheet from a subfacet to the one that holds p, or to the subsegment in between.
template <class Tr>
Sheet_place walk_in_sheet(const Constraint_complex_3<Tr>& complex, std::uint32_t from, const typename Tr::Point& p,
                          const Territory_3<Tr>& territory = {}) {
  using Complex = Constraint_complex_3<Tr>;
  std::uint32_t at = from, before = Complex::none;
  for (int steps = 0; steps < 100000; ++steps) {
    const auto& t = complex.subfacet(at);
    std::uint32_t next = Complex::none;
    for (std::size_t i = 0; i < 3 && next == Complex::none; ++i) {
      const auto v = t.vertices[(i + 1) % 3], w = t.vertices[(i + 2) % 3];
      const bool leads_on = territory.leads_on(v) || territory.leads_on(w);
      if (leads_on && t.neighbors[i] == before) continue;
      if (complex.orientation(t.facet, v->point(), w->point(), p) != CGAL::NEGATIVE) continue;
      if (!leads_on) return {at, Complex::none, true};
      next = t.neighbors[i];
    }
    if (next == Complex::none) return {at, Complex::none};
    if (next & Complex::subsegment_bit) return {at, next & ~Complex::subsegment_bit};
    before = at;
    at = next;
  }
  return {from, Complex::none};
}

/// Whether p, a point in the plane of the subfacet's facet, lies in the subfacet or on its boundary.
template <class Tr>
bool is_in_subfacet(const Constraint_complex_3<Tr>& complex, const typename Constraint_complex_3<Tr>::Subfacet& t,
                    const typename Tr::Point& p) {
  for (std::size_t i = 0; i < 3; ++i)
    if (complex.orientation(t.facet, t.vertices[i]->point(), t.vertices[(i + 1) % 3]->point(), p) == CGAL::NEGATIVE)
      return false;
  return true;
}

}  // namespace pgdr

#endif
