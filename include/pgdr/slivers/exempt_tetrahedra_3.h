// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_EXEMPT_TETRAHEDRA_3_H
#define PGDR_SLIVERS_EXEMPT_TETRAHEDRA_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/domain/feature_id.h>
#include <pgdr/mesh/mesh_triangulation_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>

namespace pgdr {

/// Whether a small angle of the input makes the edge i, j of a tetrahedron, its shortest, as short as it is (docs/theory.md, section 11, case 1).
template <class Cell_handle>
bool is_edge_explained(const Acute_neighborhood_3& acute, Cell_handle c, const Tetrahedron_points& corners, std::size_t i, std::size_t j) {
  return acute.explains(feature_of(c->vertex(static_cast<int>(i))), corners[i], feature_of(c->vertex(static_cast<int>(j))), corners[j]);
}

/// Whether a small angle of the input is within reach of a tetrahedron (the same, case 2).
inline bool is_explained_by_place(const Acute_neighborhood_3& acute, const Tetrahedron_points& corners) {
  constexpr double reach = 4;  // circumradii
  const double distance = reach * std::sqrt(tetrahedron_ball(corners).squared_radius);
  return std::ranges::any_of(corners, [&](const Vec_3& p) { return acute.contains(p, distance); });
}

/// Either of them.
template <class Cell_handle>
bool is_explained(const Acute_neighborhood_3& acute, Cell_handle c) {
  const Tetrahedron_points corners = tetrahedron_points(c);
  const auto [i, j] = shortest_edge(corners);
  return is_edge_explained(acute, c, corners, i, j) || is_explained_by_place(acute, corners);
}

/// The exempt tetrahedra that a move or an insertion would take away, and whether others may take their places (docs/theory.md, section 12).
template <class Tr>
class Exempt_tetrahedra_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;

  /// `acute`: the small angles of the input; without, nothing may take their places.
  explicit Exempt_tetrahedra_3(const Acute_neighborhood_3* acute) : acute_(acute) {}

  void clear() {
    count_ = 0;
    squared_ratio_ = 0;
    edges_.clear();
  }

  void add(Cell_handle c) {
    if (!acute_) return;
    ++count_;
    const Tetrahedron_points corners = tetrahedron_points(c);
    const auto [i, j] = shortest_edge(corners);
    if (is_edge_explained(*acute_, c, corners, i, j)) edges_.push_back({corners[i], corners[j]});
    const Tetrahedron_frame frame(corners);
    if (frame.is_flat()) return;  // one with its ratio will not do
    squared_ratio_ = std::max(squared_ratio_, frame.ball().squared_ratio());
  }

  std::size_t count() const { return count_; }

  /// The largest radius-edge ratio, squared, but for flat ones.
  double squared_ratio() const { return squared_ratio_; }

  /// Whether small angles explain one that would be made: one is within reach, or it has the shortest edge of one that is explained by
  /// its edge. Takes as long as a hundred tetrahedra to be measured.
  bool explain(const Tetrahedron_points& corners) const {
    const auto [i, j] = shortest_edge(corners);
    const auto is_same = [&, i = i, j = j](const std::array<Vec_3, 2>& e) {
      return (e[0] == corners[i] && e[1] == corners[j]) || (e[1] == corners[i] && e[0] == corners[j]);
    };
    return std::ranges::any_of(edges_, is_same) || is_explained_by_place(*acute_, corners);
  }

 private:
  const Acute_neighborhood_3* acute_;
  std::size_t count_ = 0;
  double squared_ratio_ = 0;
  std::vector<std::array<Vec_3, 2>> edges_;  ///< the shortest ones of those that have theirs explained
};

}  // namespace pgdr

#endif
