// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_SLIVER_3_H
#define PGDR_SLIVERS_SLIVER_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <pgdr/mesh/mesh_triangulation_3.h>

namespace pgdr {

/// A tetrahedron with a small dihedral angle.
template <class Tr>
struct Sliver_3 {
  typename Tr::Cell_handle cell;
  std::uint32_t generation = 0;
  double cosine = 1;  ///< of its smallest dihedral angle

  static Sliver_3 of(typename Tr::Cell_handle c, double cosine) { return {c, c->generation(), cosine}; }
  bool is_live() const { return cell->generation() == generation; }

  /// The flattest first; equal ones by their places, since cells come in an order that timing decides. \pre they are live
  friend bool operator<(const Sliver_3& a, const Sliver_3& b) {
    return a.cosine != b.cosine ? a.cosine > b.cosine : a.key() < b.key();
  }

 private:
  std::array<std::array<double, 3>, 4> key() const {
    std::array<std::array<double, 3>, 4> k;
    for (int i = 0; i < 4; ++i) {
      const Vec_3 p = position(cell->vertex(i));
      k[static_cast<std::size_t>(i)] = {p.x, p.y, p.z};
    }
    std::ranges::sort(k);
    return k;
  }
};

}  // namespace pgdr

#endif
