// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_VERTEX_TERRITORIES_3_H
#define PGDR_SLIVERS_VERTEX_TERRITORIES_3_H

#include <cstddef>
#include <cstdint>

#include <pgdr/mesh/territory_3.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_walk.h>
#include <pgdr/refinement/divide_worklist_3.h>
#include <pgdr/refinement/territory_map.h>

namespace pgdr {

/// Gives every finite vertex to the territory number(v), with all threads of the caller's arena.
template <class Tr, class Number>
void give_vertices(Tr& tr, const Number& number) {
  const auto give = [&number](std::size_t, auto v, std::size_t count) {
    for (; count > 0; --count, ++v) v->set_territory(number(typename Tr::Vertex_handle(v)));
    return true;
  };
  parallel_walk(tr.finite_vertices_begin(), tr.finite_vertices_end(), default_grain, give);
}

/// As `mark_territories`, with all threads of the caller's arena.
template <class Tr>
void mark_territories_in_parallel(Tr& tr, const Territory_map& map) {
  give_vertices(tr, [&map](typename Tr::Vertex_handle v) { return territory_at(map, position(v)); });
  tr.infinite_vertex()->set_territory(Territory_3<Tr>::everybody);
}

}  // namespace pgdr

#endif
