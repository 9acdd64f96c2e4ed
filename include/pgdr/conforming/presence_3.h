// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_PRESENCE_3_H
#define PGDR_CONFORMING_PRESENCE_3_H

#include <array>
#include <cstdint>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/mesh/vertex_star_3.h>

namespace pgdr {

// Marks of subsegments and subfacets on the cells of the triangulation.

/// Position of the vertex of c that is none of these three, which c has.
template <class Tr>
int index_of_fourth(typename Tr::Cell_handle c, const std::array<typename Tr::Vertex_handle, 3>& vertices) {
  return 6 - c->index(vertices[0]) - c->index(vertices[1]) - c->index(vertices[2]);
}

/// Marks a facet of the triangulation, on both of its cells.
template <class Tr>
void mark_facet(typename Tr::Cell_handle c, int i, std::uint32_t slot) {
  const typename Tr::Cell_handle n = c->neighbor(i);
  c->set_subfacet(i, slot);
  n->set_subfacet(n->index(c), slot);
}

/// Marks an edge on every cell around it; false if the triangulation lacks the edge.
template <class Tr>
bool mark_subsegment(const Tr& tr, Constraint_complex_3<Tr>& complex, std::uint32_t slot) {
  auto& s = complex.subsegment(slot);
  typename Tr::Cell_handle c;
  int i, j;
  if (!tr.is_edge(s.vertices[0], s.vertices[1], c, i, j)) return false;
  auto around = tr.incident_cells(c, i, j), done = around;
  do {
    const typename Tr::Cell_handle d = around;
    const std::uint8_t bit = edge_bit(d->index(s.vertices[0]), d->index(s.vertices[1]));
    d->set_subsegment_edges(d->subsegment_edges() | bit);
  } while (++around != done);
  s.present = true;
  return true;
}

/// Marks a triangle; false if the triangulation lacks it.
template <class Tr>
bool mark_subfacet(const Tr& tr, Constraint_complex_3<Tr>& complex, std::uint32_t slot) {
  auto& t = complex.subfacet(slot);
  typename Tr::Cell_handle c;
  int i, j, k;
  if (!tr.is_facet(t.vertices[0], t.vertices[1], t.vertices[2], c, i, j, k)) return false;
  mark_facet<Tr>(c, 6 - i - j - k, slot);
  t.present = true;
  return true;
}

/// Marks a subsegment at the vertex just inserted, which is an edge exactly if the star shows it.
template <class Tr>
bool mark_subsegment(Constraint_complex_3<Tr>& complex, std::uint32_t slot, const Cavity_3<Tr>& cavity) {
  auto& s = complex.subsegment(slot);
  for (const auto c : cavity.star()) {
    int i, j;
    if (!c->has_vertex(s.vertices[0], i) || !c->has_vertex(s.vertices[1], j)) continue;
    c->set_subsegment_edges(c->subsegment_edges() | edge_bit(i, j));
    s.present = true;
  }
  return s.present;
}

/// Marks a subfacet at the vertex just inserted.
template <class Tr>
bool mark_subfacet(Constraint_complex_3<Tr>& complex, std::uint32_t slot, const Cavity_3<Tr>& cavity) {
  auto& t = complex.subfacet(slot);
  for (const auto c : cavity.star()) {
    int i, j, k;
    if (!c->has_vertex(t.vertices[0], i) || !c->has_vertex(t.vertices[1], j) || !c->has_vertex(t.vertices[2], k))
      continue;
    mark_facet<Tr>(c, 6 - i - j - k, slot);
    t.present = true;
    break;
  }
  return t.present;
}

/// Takes the marks off removed subfacets that the insertion left in the triangulation (rounding only).
template <class Tr>
void unmark_survivors(Constraint_complex_3<Tr>& complex, Vertex_star_3<Tr>& star, const std::vector<std::uint32_t>& removed) {
  for (const std::uint32_t slot : removed) {
    auto& t = complex.subfacet(slot);
    if (!t.present || t.scratch) continue;
    const auto c = star.find_facet(t.vertices[0], t.vertices[1], t.vertices[2]);
    if (c != typename Tr::Cell_handle()) mark_facet<Tr>(c, index_of_fourth<Tr>(c, t.vertices), Constraint_complex_3<Tr>::none);
  }
}

}  // namespace pgdr

#endif
