// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_FLAT_CELL_3_H
#define PGDR_CONFORMING_FLAT_CELL_3_H

#include <array>
#include <cstdint>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/presence_3.h>

namespace pgdr {

/// A subfacet of the cell on whose facet the opposite vertex lies too, or `none`: the cell is flat, a product of
/// rounding between cocircular points, or of a facet that is bent, with a fair radius-edge ratio and no volume.
template <class Tr>
std::uint32_t subfacet_of_flat_cell(const Constraint_complex_3<Tr>& complex, typename Tr::Cell_handle c) {
  for (int i = 0; i < 4; ++i) {
    const std::uint32_t t = c->subfacet(i);
    if (t != Constraint_complex_3<Tr>::none && complex.is_on_facet(c->vertex(i), complex.subfacet(t).facet)) return t;
  }
  return Constraint_complex_3<Tr>::none;
}

/// Gives a flat cell to the subdomain that is beyond its facet: where the sheet passes on one side of the cell, it may as well pass on the
/// other. True if that was done; the two subfacets keep their slots. False unless the cell has two of them, neighbors in the sheet, with
/// `to` beyond both.
template <class Tr>
bool move_across_sheet(Constraint_complex_3<Tr>& complex, typename Tr::Cell_handle c, std::int32_t to) {
  constexpr std::uint32_t none = Constraint_complex_3<Tr>::none;
  int marked[2], n_marked = 0, n_free = 0;
  for (int i = 0; i < 4; ++i) {
    if (c->subfacet(i) != none && n_marked < 2)
      marked[n_marked++] = i;
    else
      n_free += c->subfacet(i) == none;
  }
  if (n_marked != 2 || n_free != 2) return false;
  const std::uint32_t t = c->subfacet(marked[0]), u = c->subfacet(marked[1]);
  const Index facet = complex.subfacet(t).facet;
  if (complex.subfacet(u).facet != facet || complex.edge_with_neighbor(t, u) < 0 ||
      complex.edge_with_neighbor(u, t) < 0)
    return false;
  for (const int i : marked)
    if (c->neighbor(i)->subdomain() != to || !complex.is_on_facet(c->vertex(i), facet)) return false;

  // Counterclockwise (j, k, l) and (i, l, k) become (j, k, i) and (i, l, j).
  const auto& first = complex.subfacet(t);
  const auto a = static_cast<std::size_t>(complex.edge_with_neighbor(t, u));
  const auto j = first.vertices[a], k = first.vertices[(a + 1) % 3], l = first.vertices[(a + 2) % 3];
  const auto i = c->vertex(marked[0]) == j ? c->vertex(marked[1]) : c->vertex(marked[0]);
  if (complex.orientation(facet, j->point(), k->point(), i->point()) != CGAL::POSITIVE ||
      complex.orientation(facet, i->point(), l->point(), j->point()) != CGAL::POSITIVE)
    return false;
  for (const int m : marked) mark_facet<Tr>(c, m, none);
  complex.flip(t, u);
  mark_facet<Tr>(c, c->index(l), t);
  mark_facet<Tr>(c, c->index(k), u);
  c->set_subdomain(to);
  return true;
}

}  // namespace pgdr

#endif
