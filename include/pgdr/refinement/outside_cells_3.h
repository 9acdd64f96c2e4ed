// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_OUTSIDE_CELLS_3_H
#define PGDR_REFINEMENT_OUTSIDE_CELLS_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pgdr/mesh/mesh_triangulation_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>

namespace pgdr {

/// The corners of a tetrahedron in lexicographic order.
template <class Cell_handle>
std::array<std::array<double, 3>, 4> sorted_corners(Cell_handle c) {
  std::array<std::array<double, 3>, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec_3 p = position(c->vertex(static_cast<int>(i)));
    corners[i] = {p.x, p.y, p.z};
  }
  std::ranges::sort(corners);
  return corners;
}

/// The finite tetrahedra outside the domain, in an order that depends on nothing but where they are: which cell has which place in
/// memory is up to the threads that made them. \pre no other thread works
template <class Tr>
std::vector<typename Tr::Cell_handle> outside_cells(const Tr& tr) {
  struct Placed {
    std::array<std::array<double, 3>, 4> corners;
    typename Tr::Cell_handle cell;
  };
  std::vector<Placed> placed;
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c)
    if (c->subdomain() == 0) placed.push_back({sorted_corners(c), c});
  std::ranges::sort(placed, {}, &Placed::corners);
  std::vector<typename Tr::Cell_handle> cells;
  cells.reserve(placed.size());
  for (const Placed& p : placed) cells.push_back(p.cell);
  return cells;
}

/// Their volume, to some ten digits, and the same in whatever order they come. `whole`: the volume of the hull.
/// \pre no other thread works
template <class Tr>
double outside_volume(const Tr& tr, double whole) {
  constexpr double parts = 1ull << 52;  // whole numbers have one sum only
  std::uint64_t sum = 0;
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) {
    if (c->subdomain() != 0) continue;
    Tetrahedron_points corners;
    std::ranges::transform(sorted_corners(c), corners.begin(), [](const auto& p) { return Vec_3{p[0], p[1], p[2]}; });
    sum += static_cast<std::uint64_t>(std::abs(Tetrahedron_frame(corners).volume()) / whole * parts);
  }
  return static_cast<double>(sum) / parts * whole;
}

}  // namespace pgdr

#endif
