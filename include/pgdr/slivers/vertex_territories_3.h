// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_VERTEX_TERRITORIES_3_H
#define PGDR_SLIVERS_VERTEX_TERRITORIES_3_H

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_walk.h>
#include <pgdr/refinement/divide_worklist_3.h>
#include <pgdr/refinement/territory_map.h>

namespace pgdr {

/// Calls f(v) for each finite vertex, with all threads of the caller's arena.
template <class Tr, class F>
void for_vertices_in_parallel(const Tr& tr, const F& f) {
  parallel_for_each(tr.finite_vertices_begin(), tr.finite_vertices_end(), default_grain, [&f](auto v) { f(typename Tr::Vertex_handle(v)); });
}

/// As `mark_territories`, with all threads of the caller's arena.
template <class Tr>
void mark_territories_in_parallel(Tr& tr, const Territory_map& map) {
  mark_territories(tr, map, [&tr](const auto& f) { for_vertices_in_parallel(tr, f); });
}

}  // namespace pgdr

#endif
