// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_PRESENCE_3_H
#define PGDR_CONFORMING_PRESENCE_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
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
bool mark_subsegment(const Tr& tr, Constraint_complex_3<Tr>& complex, Vertex_star_3<Tr>& star, std::uint32_t slot) {
  auto& s = complex.subsegment(slot);
  const auto c = star.find_edge(s.vertices[0], s.vertices[1]);
  if (c == typename Tr::Cell_handle()) return false;
  auto around = tr.incident_cells(c, c->index(s.vertices[0]), c->index(s.vertices[1])), done = around;
  do {
    const typename Tr::Cell_handle d = around;
    const std::uint8_t bit = edge_bit(d->index(s.vertices[0]), d->index(s.vertices[1]));
    d->set_subsegment_edges(d->subsegment_edges() | bit);
  } while (++around != done);
  s.present = true;
  return true;
}

/// Marks a triangle; a cell that has it, or none if the triangulation lacks it.
template <class Tr>
typename Tr::Cell_handle mark_subfacet(Constraint_complex_3<Tr>& complex, Vertex_star_3<Tr>& star, std::uint32_t slot) {
  auto& t = complex.subfacet(slot);
  const auto c = star.find_facet(t.vertices[0], t.vertices[1], t.vertices[2]);
  if (c == typename Tr::Cell_handle()) return c;
  mark_facet<Tr>(c, index_of_fourth<Tr>(c, t.vertices), slot);
  t.present = true;
  return c;
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

/// Marks the subfacets at v, the vertex just inserted, that the star shows. In one pass: a vertex where the mesh is
/// not graded yet can have thousands of both.
template <class Tr>
void mark_subfacets(Constraint_complex_3<Tr>& complex, typename Tr::Vertex_handle v, const std::vector<std::uint32_t>& slots,
                    const Cavity_3<Tr>& cavity) {
  // By the edge opposite to v; the order, which depends on addresses, only serves to find them.
  using Edge = std::array<const void*, 2>;
  const auto edge_of = [](const void* p, const void* q) { return std::less<>()(p, q) ? Edge{p, q} : Edge{q, p}; };
  // One of 64, the same for the same vertex: what is no corner of a subfacet mostly has one that no corner has.
  const auto bit_of = [](const void* p) { return std::uint64_t{1} << (reinterpret_cast<std::uintptr_t>(p) * 0x9e3779b97f4a7c15u >> 58); };
  std::vector<std::pair<Edge, std::uint32_t>> sought;
  sought.reserve(slots.size());
  std::uint64_t corners = 0;
  for (const std::uint32_t slot : slots) {
    const auto& t = complex.subfacet(slot).vertices;
    const auto i = static_cast<std::size_t>(std::find(t.begin(), t.end(), v) - t.begin());
    const void *p = &*t[(i + 1) % 3], *q = &*t[(i + 2) % 3];
    sought.emplace_back(edge_of(p, q), slot);
    corners |= bit_of(p) | bit_of(q);
  }
  std::sort(sought.begin(), sought.end());
  const auto& star = cavity.star();
  for (std::size_t k = 0; k < star.size(); ++k) {
    const int apex = cavity.apex(k);
    std::array<const void*, 3> ends;  // of the three edges opposite to v
    for (int j = 1; j < 4; ++j) ends[static_cast<std::size_t>(j - 1)] = &*star[k]->vertex((apex + j) & 3);
    for (std::size_t j = 0; j < 3; ++j) {
      const void *p = ends[(j + 1) % 3], *q = ends[(j + 2) % 3];
      if (!(corners & bit_of(p)) || !(corners & bit_of(q))) continue;
      const Edge edge = edge_of(p, q);
      const auto at = std::lower_bound(sought.begin(), sought.end(), std::make_pair(edge, std::uint32_t{0}));
      if (at == sought.end() || at->first != edge || complex.subfacet(at->second).present) continue;
      mark_facet<Tr>(star[k], (apex + 1 + static_cast<int>(j)) & 3, at->second);
      complex.subfacet(at->second).present = true;
    }
  }
}

/// Takes the marks off removed subfacets that the insertion left in the triangulation (rounding only). True if there are any: what lies
/// between one and the subfacets that replace it has changed sides.
template <class Tr>
bool unmark_survivors(Constraint_complex_3<Tr>& complex, Vertex_star_3<Tr>& star, const std::vector<std::uint32_t>& removed) {
  bool is_any = false;
  for (const std::uint32_t slot : removed) {
    auto& t = complex.subfacet(slot);
    if (!t.present || t.scratch) continue;
    const auto c = star.find_facet(t.vertices[0], t.vertices[1], t.vertices[2]);
    if (c == typename Tr::Cell_handle()) continue;
    mark_facet<Tr>(c, index_of_fourth<Tr>(c, t.vertices), Constraint_complex_3<Tr>::none);
    is_any = true;
  }
  return is_any;
}

}  // namespace pgdr

#endif
