// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_GRID_SIZING_FIELD_H
#define PGDR_SIZING_GRID_SIZING_FIELD_H

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <CGAL/number_utils.h>

#include <pgdr/sizing/sizing_field.h>

namespace pgdr {

/// The nodes of a regular grid: node (i, j, k) is at `origin` + (i, j, k) * `spacing`.
struct Sizing_grid {
  std::array<double, 3> origin{};
  std::array<double, 3> spacing{1, 1, 1};
  std::array<std::size_t, 3> nodes{};  ///< in each direction, at least 2

  std::size_t size() const { return nodes[0] * nodes[1] * nodes[2]; }
  /// Of the node with this position in lists of values; x runs fastest.
  std::array<double, 3> point(std::size_t node) const;
};

/// A sizing field from values at the nodes of a grid, trilinear in between; outside of the grid, that of the nearest point of it. For sizes from an error estimate or an
/// image, and for a gradation of any other field: `Grid_sizing_field::sampled(grid, field).graded(0.3)`.
///
/// In double arithmetic, the same on every thread. Copies share the values.
class Grid_sizing_field {
 public:
  /// Throws `std::invalid_argument` unless there is a value for each node, all of them positive and finite, and the grid has an extent in each direction.
  Grid_sizing_field(const Sizing_grid& grid, std::vector<double> values);

  /// The values of another field at the nodes: `Field` takes a point made of three doubles. Throws what the constructor throws, for an infinite size as well.
  template <class Point_3, class Field>
  static Grid_sizing_field sampled(const Sizing_grid& grid, const Field& field) {
    std::vector<double> values;
    values.reserve(grid.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const auto [x, y, z] = grid.point(i);
      values.push_back(field(Point_3(x, y, z)));
    }
    return {grid, std::move(values)};
  }

  /// The largest field below this one that grows by no more than `gradation` for each unit of distance along the edges and diagonals of the grid's cells (shortest paths, Dijkstra 1959).
  /// In cubes, such paths are at most 1.13 times as long as the distance. Throws `std::invalid_argument` unless `gradation` > 0.
  Grid_sizing_field graded(double gradation) const;

  template <class Point_3>
  double operator()(const Point_3& p) const {
    return size_at({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
  }

  double size_at(const std::array<double, 3>& p) const;

  const Sizing_grid& grid() const { return grid_; }
  const std::vector<double>& values() const { return *values_; }

 private:
  Sizing_grid grid_;
  std::shared_ptr<const std::vector<double>> values_;
};

}  // namespace pgdr

#endif
