// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_CELL_SCAN_3_H
#define PGDR_REFINEMENT_CELL_SCAN_3_H

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <pgdr/domain/region_3.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mesh/mesh_triangulation_3.h>

namespace pgdr {

/// Visits the finite tetrahedra around a box without writing to the triangulation, so that several threads may do it
/// at once.
template <class Tr>
class Cell_scan_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Point = typename Tr::Point;

  explicit Cell_scan_3(const Tr& tr) : tr_(tr), seen_(1024, nullptr) {}

  /// Visits the connected set of tetrahedra that `belongs` accepts, from the one that holds `start`, until `visit`
  /// returns false. False if it did. `near` is a vertex from which `start` is not far.
  template <class Belongs, class Visit>
  bool visit(const Vec_3& start, Vertex_handle near, const Belongs& belongs, const Visit& visit) {
    Cell_handle c = tr_.locate(Point(start.x, start.y, start.z), near->cell());
    for (int i = 0; i < 4 && tr_.is_infinite(c); ++i)
      if (c->vertex(i) == tr_.infinite_vertex()) c = c->neighbor(i);
    std::vector<Cell_handle> front{c};
    insert(c);
    while (!front.empty()) {
      const Cell_handle d = front.back();
      front.pop_back();
      if (!visit(d)) return false;
      for (int i = 0; i < 4; ++i) {
        const Cell_handle n = d->neighbor(i);
        if (!tr_.is_infinite(n) && insert(n) && belongs(n)) front.push_back(n);
      }
    }
    return true;
  }

 private:
  /// Open addressing; the set is only asked for membership, so that addresses decide nothing.
  bool insert(Cell_handle c) {
    if (2 * count_ >= seen_.size()) grow();
    const bool fresh = place(&*c);
    count_ += fresh;
    return fresh;
  }

  bool place(const void* p) {
    std::size_t k = (reinterpret_cast<std::uintptr_t>(p) >> 4) * 0x9e3779b97f4a7c15ull >> 20 & (seen_.size() - 1);
    while (seen_[k] && seen_[k] != p) k = (k + 1) & (seen_.size() - 1);
    if (seen_[k] == p) return false;
    seen_[k] = p;
    return true;
  }

  void grow() {
    std::vector<const void*> old(2 * seen_.size(), nullptr);
    old.swap(seen_);
    for (const void* p : old)
      if (p) place(p);
  }

  const Tr& tr_;
  std::vector<const void*> seen_;
  std::size_t count_ = 0;
};

/// Whether the bounding box of a tetrahedron meets a box.
inline bool boxes_meet(const std::array<Vec_3, 4>& p, const Region_3& box) {
  for (int k = 0; k < 3; ++k) {
    const double lo = std::min({p[0][k], p[1][k], p[2][k], p[3][k]});
    const double hi = std::max({p[0][k], p[1][k], p[2][k], p[3][k]});
    if (hi < box.lower[k] || lo > box.upper[k]) return false;
  }
  return true;
}

/// Whether a tetrahedron lies inside a box.
inline bool is_inside(const std::array<Vec_3, 4>& p, const Region_3& box) {
  return std::all_of(p.begin(), p.end(), [&](const Vec_3& q) { return box.contains_closed(q); });
}

/// Distance from a point to a box.
inline double distance_to_box(const Vec_3& p, const Region_3& box) {
  double d2 = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max({box.lower[k] - p[k], 0.0, p[k] - box.upper[k]});
    d2 += d * d;
  }
  return std::sqrt(d2);
}

}  // namespace pgdr

#endif
