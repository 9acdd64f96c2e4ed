// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_VERTEX_STAR_3_H
#define PGDR_MESH_VERTEX_STAR_3_H

#include <array>
#include <cstddef>
#include <vector>

namespace pgdr {

/// Looks through the cells around a vertex and leaves no marks on them, so that others may look at the same cells meanwhile,
/// as CGAL's `is_edge` and `is_facet` do not allow. Depth-first from the vertex's cell, in CGAL's order; around all vertices in
/// question by turns, so that what is looked for is found, or known to be missing, in a few times as many cells as the one with the
/// fewest has: where the mesh is not graded, others have tens of thousands.
template <class Tr>
class Vertex_star_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;

  /// A cell with the edge between u and v; none if the triangulation lacks the edge.
  Cell_handle find_edge(Vertex_handle u, Vertex_handle v) {
    return find(std::array{u, v}, [u, v](Cell_handle c) { return c->has_vertex(u) && c->has_vertex(v); });
  }
  /// A cell with the triangle of u, v and w; none if the triangulation lacks it.
  Cell_handle find_facet(Vertex_handle u, Vertex_handle v, Vertex_handle w) {
    return find(std::array{u, v, w}, [u, v, w](Cell_handle c) { return c->has_vertex(u) && c->has_vertex(v) && c->has_vertex(w); });
  }

 private:
  /// The cells around one vertex, as far as they have been seen.
  class Star {
   public:
    void start(Vertex_handle u) {
      u_ = u;
      for (const std::size_t k : used_) slots_[k] = Cell_handle();
      used_.clear();
      cells_.clear();
      stack_.clear();
      if (slots_.empty()) slots_.resize(128);
      note(u->cell());
    }
    /// Looks at the neighbours of one more cell; calls `look` with those that are new. False if there is none left.
    template <class Look>
    bool step(const Look& look) {
      if (stack_.empty()) return false;
      const Cell_handle c = stack_.back();
      stack_.pop_back();
      for (int i = 0; i < 4; ++i)
        if (c->vertex(i) != u_ && note(c->neighbor(i))) look(c->neighbor(i));
      return true;
    }

   private:
    /// Adds a cell unless it is among them, which a table with open addressing tells.
    bool note(Cell_handle c) {
      if (2 * cells_.size() >= slots_.size()) {
        slots_.assign(2 * slots_.size(), Cell_handle());
        used_.clear();
        for (const Cell_handle d : cells_) use(slot_of(d), d);
      }
      const std::size_t slot = slot_of(c);
      if (slots_[slot] == c) return false;
      use(slot, c);
      cells_.push_back(c);
      stack_.push_back(c);
      return true;
    }
    void use(std::size_t slot, Cell_handle c) {
      slots_[slot] = c;
      used_.push_back(slot);
    }
    /// Where c is, or would be.
    std::size_t slot_of(Cell_handle c) const {
      const std::size_t mask = slots_.size() - 1;
      std::size_t k = (reinterpret_cast<std::size_t>(&*c) / sizeof(*c) * 0x9e3779b97f4a7c15u) >> 40 & mask;
      while (slots_[k] != Cell_handle() && slots_[k] != c) k = (k + 1) & mask;
      return k;
    }

    Vertex_handle u_;
    std::vector<Cell_handle> cells_;  ///< all that were seen
    std::vector<Cell_handle> stack_;  ///< those whose neighbours were not
    std::vector<Cell_handle> slots_;  ///< a power of two of them
    std::vector<std::size_t> used_;   ///< which are not empty
  };

  template <std::size_t n, class Predicate>
  Cell_handle find(const std::array<Vertex_handle, n>& vertices, const Predicate& is_wanted) {
    for (std::size_t k = 0; k < n; ++k) {
      if (is_wanted(vertices[k]->cell())) return vertices[k]->cell();
      stars_[k].start(vertices[k]);
    }
    Cell_handle found;
    while (true)
      for (std::size_t k = 0; k < n; ++k) {
        const bool goes_on = stars_[k].step([&](Cell_handle c) {
          if (found == Cell_handle() && is_wanted(c)) found = c;
        });
        if (found != Cell_handle() || !goes_on) return found;
      }
  }

  std::array<Star, 3> stars_;
};

}  // namespace pgdr

#endif
