// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_VERTEX_STAR_3_H
#define PGDR_MESH_VERTEX_STAR_3_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pgdr {

/// Looks through the cells around a vertex and leaves no marks on them, so that others may look at the same cells meanwhile,
/// as CGAL's `is_edge` and `is_facet` do not allow. Depth-first from the vertex's cell, in CGAL's order.
template <class Tr>
class Vertex_star_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;

  /// The first cell with the edge between u and v; none if the triangulation lacks the edge.
  Cell_handle find_edge(Vertex_handle u, Vertex_handle v) {
    return find(u, [v](Cell_handle c) { return c->has_vertex(v); });
  }
  /// The first cell with the triangle of u, v and w; none if the triangulation lacks it.
  Cell_handle find_facet(Vertex_handle u, Vertex_handle v, Vertex_handle w) {
    return find(u, [v, w](Cell_handle c) { return c->has_vertex(v) && c->has_vertex(w); });
  }

 private:
  template <class Predicate>
  Cell_handle find(Vertex_handle u, const Predicate& is_wanted) {
    cells_.clear();
    std::ranges::fill(slots_, Cell_handle());
    stack_.clear();
    note(u->cell());
    if (is_wanted(u->cell())) return u->cell();
    while (!stack_.empty()) {
      const Cell_handle c = stack_.back();
      stack_.pop_back();
      for (int i = 0; i < 4; ++i) {
        if (c->vertex(i) == u || !note(c->neighbor(i))) continue;
        if (is_wanted(c->neighbor(i))) return c->neighbor(i);
      }
    }
    return {};
  }

  /// Adds a cell unless it is among them, which a table with open addressing tells.
  bool note(Cell_handle c) {
    if (2 * cells_.size() >= slots_.size()) {
      slots_.assign(std::max<std::size_t>(128, 2 * slots_.size()), Cell_handle());
      for (const Cell_handle d : cells_) slots_[slot_of(d)] = d;
    }
    Cell_handle& slot = slots_[slot_of(c)];
    if (slot == c) return false;
    slot = c;
    cells_.push_back(c);
    stack_.push_back(c);
    return true;
  }

  /// Where c is, or would be.
  std::size_t slot_of(Cell_handle c) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t k = (reinterpret_cast<std::size_t>(&*c) / sizeof(*c) * 0x9e3779b97f4a7c15u) >> 40 & mask;
    while (slots_[k] != Cell_handle() && slots_[k] != c) k = (k + 1) & mask;
    return k;
  }

  std::vector<Cell_handle> cells_;  ///< all that were seen
  std::vector<Cell_handle> stack_;  ///< those whose neighbours were not
  std::vector<Cell_handle> slots_;  ///< a power of two of them
};

}  // namespace pgdr

#endif
