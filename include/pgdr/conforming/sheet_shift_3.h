// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_SHEET_SHIFT_3_H
#define PGDR_CONFORMING_SHEET_SHIFT_3_H

#include <cstdint>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/flat_cell_3.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/mesh/conflict_walk_3.h>

namespace pgdr {

/// Moves sheets across flat cells of a cavity, to the side where its point is not.
///
/// A flat cell of four vertices of a facet has a ball that reaches far beyond the facet on both sides. A point in it deletes the cell, and the
/// subfacets between the cell and itself with it, though it is in no equatorial ball, and nothing of the facet has to change: the cell's other
/// two triangles cover the same part of it. With the cell on the point's side of the sheet, no subfacet is deleted
/// (docs/theory.md, section 10). Cells may lie upon each other: the sheet moves across one after the other.
template <class Tr>
class Sheet_shift_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;
  using Point = typename Tr::Point;

  /// True if any sheet was moved. \pre the cavity is p's
  bool shift(Complex& complex, const Tr& tr, const Cavity_3<Tr>& cavity, const Point& p) {
    moved_.clear();
    todo_.clear();
    for (const Cell_handle c : cavity.cells())
      if (c->has_subfacet()) todo_.push_back(c);
    for (std::size_t k = 0; k < todo_.size(); ++k) {
      const Cell_handle c = todo_[k];
      const int i = face_towards(complex, tr, c, p);
      if (i < 0) continue;
      const std::int32_t from = c->subdomain();
      if (!move_across_sheet(complex, c, c->neighbor(i)->subdomain())) continue;
      moved_.push_back({c, from});
      for (int j = 0; j < 4; ++j)
        if (c->subfacet(j) != Complex::none && Cavity_3<Tr>::contains(c->neighbor(j))) todo_.push_back(c->neighbor(j));
    }
    return !moved_.empty();
  }

  /// Takes all of it back. \pre the cells are still there
  void take_back(Complex& complex) {
    for (auto m = moved_.rbegin(); m != moved_.rend(); ++m) move_across_sheet(complex, m->cell, m->from);
    moved_.clear();
  }

  struct Moved {
    Cell_handle cell;
    std::int32_t from;  ///< its subdomain before
  };
  const std::vector<Moved>& moved() const { return moved_; }

 private:
  /// A face on which a flat cell would be deleted together with a subfacet, if p is beyond all of its subfacets; else -1.
  static int face_towards(const Complex& complex, const Tr& tr, Cell_handle c, const Point& p) {
    int found = -1;
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t t = c->subfacet(i);
      if (t == Complex::none) continue;
      if (tr.is_infinite(c) || !complex.is_on_facet(c->vertex(i), complex.subfacet(t).facet) || !lies_beyond(tr, c, i, p)) return -1;
      if (Cavity_3<Tr>::contains(c->neighbor(i))) found = i;
    }
    return found;
  }

  std::vector<Moved> moved_;
  std::vector<Cell_handle> todo_;
};

}  // namespace pgdr

#endif
