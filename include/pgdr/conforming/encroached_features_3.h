// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_ENCROACHED_FEATURES_3_H
#define PGDR_CONFORMING_ENCROACHED_FEATURES_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/mesh/cavity_3.h>

namespace pgdr {

/// Looks through the star of a vertex v that was just inserted on a feature: calls `subsegment` and `subfacet` with the slot
/// of each piece that v encroaches, and of each new piece, subsegments `halves` and subfacets `made`, that a vertex
/// across encroaches; and with the vertex.
template <class Tr, class On_subsegment, class On_subfacet>
void for_each_encroached(const Tr& tr, const Constraint_complex_3<Tr>& complex, const Cavity_3<Tr>& cavity,
                         typename Tr::Vertex_handle v, const std::array<std::uint32_t, 2>& halves,
                         const std::vector<std::uint32_t>& made, const On_subsegment& subsegment,
                         const On_subfacet& subfacet) {
  using Complex = Constraint_complex_3<Tr>;
  const auto& star = cavity.star();
  for (std::size_t k = 0; k < star.size(); ++k) {
    const auto c = star[k];
    const int apex = cavity.apex(k);
    const std::uint32_t t = c->subfacet(apex);
    if (t != Complex::none && encroaches(complex, complex.subfacet(t), v)) subfacet(t, v);
    if (!c->subsegment_edges()) continue;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j)
        if (i != apex && j != apex && (c->subsegment_edges() & edge_bit(i, j))) {
          const std::uint32_t s = complex.find_subsegment(c->vertex(i), c->vertex(j));
          if (s != Complex::none && encroaches(complex, complex.subsegment(s), v)) subsegment(s, v);
        }
  }

  const auto first_across = [&](const typename Complex::Subsegment& s) {
    for (const auto c : star) {
      if (!c->has_vertex(s.vertices[0]) || !c->has_vertex(s.vertices[1])) continue;
      for (int i = 0; i < 4; ++i)
        if (!tr.is_infinite(c->vertex(i)) && encroaches(complex, s, c->vertex(i))) return c->vertex(i);
    }
    return typename Tr::Vertex_handle();
  };
  for (const std::uint32_t h : halves) {
    if (h == Complex::none || !complex.subsegment(h).present) continue;
    const auto w = first_across(complex.subsegment(h));
    if (w != typename Tr::Vertex_handle()) subsegment(h, w);
  }
  // Of each new subfacet its one or two sides in the star, in one pass: there can be thousands of both.
  std::vector<std::pair<std::uint32_t, typename Tr::Vertex_handle>> across;
  for (std::size_t k = 0; k < star.size(); ++k)
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t t = star[k]->subfacet(i);
      if (t == Complex::none || i == cavity.apex(k) || tr.is_infinite(star[k]->vertex(i))) continue;
      if (encroaches(complex, complex.subfacet(t), star[k]->vertex(i))) across.emplace_back(t, star[k]->vertex(i));
    }
  const auto by_slot = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(across.begin(), across.end(), by_slot);
  for (const std::uint32_t t : made) {
    const auto at = std::lower_bound(across.begin(), across.end(), std::make_pair(t, typename Tr::Vertex_handle()), by_slot);
    if (at != across.end() && at->first == t) subfacet(t, at->second);
  }
}

}  // namespace pgdr

#endif
