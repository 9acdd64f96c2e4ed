// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_SHEET_WALK_3_H
#define PGDR_CONFORMING_SHEET_WALK_3_H

#include <cstddef>
#include <cstdint>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mesh/territory_3.h>

namespace pgdr {

/// Where a walk in a facet came to its end.
struct Sheet_place {
  std::uint32_t subfacet;
  std::uint32_t subsegment;  ///< the one in the way, or none
  bool is_foreign = false;   ///< the way leads out of the territory
};

/// Of the corners of a subfacet.
Vec_3 barycenter(const auto& subfacet) {
  const auto& v = subfacet.vertices;
  return (1. / 3) * (position(v[0]) + position(v[1]) + position(v[2]));
}

/// Walks in the sheet from a subfacet straight to the one that holds p, or to the subsegment in between. Straight, because only
/// of the subsegment that the straight way crosses is it certain, where p is the subfacet's circumcenter and its circumcircle is
/// empty, that a vertex encroaches it: its ends are not in the circle, and the part of the circle on the subfacet's side of
/// it, less than half, is in its diametral circle. Another one on the same line could be split for ever.
template <class Tr>
Sheet_place walk_in_sheet(const Constraint_complex_3<Tr>& complex, std::uint32_t from, const typename Tr::Point& p,
                          const Territory_3<Tr>& territory = {}) {
  using Complex = Constraint_complex_3<Tr>;
  const Vec_3 middle = barycenter(complex.subfacet(from));
  const typename Tr::Point q(middle.x, middle.y, middle.z);
  std::uint32_t at = from, before = Complex::none;
  for (int steps = 0; steps < 100000; ++steps) {
    const auto& t = complex.subfacet(at);
    // Which side p is beyond; if rounding takes the way off the subfacet, any, rather one with a neighbor.
    int beyond = -1, best = 0;
    for (int i = 0; i < 3; ++i) {
      const auto v = t.vertices[(i + 1) % 3], w = t.vertices[(i + 2) % 3];
      if (t.neighbors[i] == before && (territory.leads_on(v) || territory.leads_on(w))) continue;
      if (complex.orientation(t.facet, v->point(), w->point(), p) != CGAL::NEGATIVE) continue;
      const bool is_crossed = complex.orientation(t.facet, q, p, v->point()) != CGAL::POSITIVE &&
                              complex.orientation(t.facet, q, p, w->point()) != CGAL::NEGATIVE;
      const int rank = 1 + (t.neighbors[i] & Complex::subsegment_bit ? 0 : 1) + (is_crossed ? 2 : 0);
      if (rank > best) beyond = i, best = rank;
    }
    if (beyond < 0) return {at, Complex::none};
    if (!territory.leads_on(t.vertices[(beyond + 1) % 3]) && !territory.leads_on(t.vertices[(beyond + 2) % 3]))
      return {at, Complex::none, true};
    const std::uint32_t next = t.neighbors[beyond];
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
