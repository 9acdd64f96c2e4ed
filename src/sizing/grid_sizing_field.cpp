// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/grid_sizing_field.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>

namespace pgdr {

std::array<double, 3> Sizing_grid::point(std::size_t node) const {
  std::array<double, 3> p;
  for (std::size_t d = 0; d < 3; ++d) {
    p[d] = origin[d] + static_cast<double>(node % nodes[d]) * spacing[d];
    node /= nodes[d];
  }
  return p;
}

Grid_sizing_field::Grid_sizing_field(const Sizing_grid& grid, std::vector<double> values) : grid_(grid) {
  for (std::size_t d = 0; d < 3; ++d)
    if (grid.nodes[d] < 2 || !(grid.spacing[d] > 0) || !std::isfinite(grid.spacing[d]) || !std::isfinite(grid.origin[d]))
      throw std::invalid_argument("a sizing grid needs two nodes and a positive spacing in each direction");
  if (values.size() != grid.size())
    throw std::invalid_argument("a sizing grid of " + std::to_string(grid.size()) + " nodes has " + std::to_string(values.size()) + " values");
  if (!std::ranges::all_of(values, [](double v) { return v > 0 && std::isfinite(v); }))
    throw std::invalid_argument("the sizes at the nodes of a grid have to be positive and finite");
  values_ = std::make_shared<const std::vector<double>>(std::move(values));
}

double Grid_sizing_field::size_at(const std::array<double, 3>& p) const {
  std::array<std::size_t, 3> cell;
  std::array<double, 3> part;
  for (std::size_t d = 0; d < 3; ++d) {
    const double last = static_cast<double>(grid_.nodes[d] - 1);
    const double at = std::clamp((p[d] - grid_.origin[d]) / grid_.spacing[d], 0.0, last);
    cell[d] = std::min(static_cast<std::size_t>(at), grid_.nodes[d] - 2);
    part[d] = at - static_cast<double>(cell[d]);
  }
  const std::size_t row = grid_.nodes[0], slice = row * grid_.nodes[1];
  const double* v = values_->data() + cell[0] + row * cell[1] + slice * cell[2];
  const auto between = [](double a, double b, double t) { return a + t * (b - a); };
  const auto along_x = [&](std::size_t i) { return between(v[i], v[i + 1], part[0]); };
  return between(between(along_x(0), along_x(row), part[1]), between(along_x(slice), along_x(slice + row), part[1]), part[2]);
}

Grid_sizing_field Grid_sizing_field::graded(double gradation) const {
  if (!(gradation > 0)) throw std::invalid_argument("the gradation must be positive");
  std::vector<double> values = *values_;
  // Smallest first; of equal ones by position, which decides nothing but the order of equal steps.
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t i = 0; i < values.size(); ++i) queue.push({values[i], i});
  const std::size_t nx = grid_.nodes[0], ny = grid_.nodes[1];
  while (!queue.empty()) {
    const auto [size, node] = queue.top();
    queue.pop();
    if (size > values[node]) continue;
    const std::array<std::size_t, 3> at{node % nx, node / nx % ny, node / nx / ny};
    for (int k = 0; k < 27; ++k) {
      const std::array<int, 3> step{k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
      std::array<std::size_t, 3> to;
      double squared = 0;
      bool is_inside = true;
      for (std::size_t d = 0; d < 3; ++d) {
        to[d] = at[d] + static_cast<std::size_t>(step[d]);  // -1 wraps around
        is_inside = is_inside && to[d] < grid_.nodes[d];
        squared += step[d] * step[d] * grid_.spacing[d] * grid_.spacing[d];
      }
      if (!is_inside) continue;
      const std::size_t neighbor = to[0] + nx * (to[1] + ny * to[2]);
      const double bound = size + gradation * std::sqrt(squared);
      if (!(bound < values[neighbor])) continue;
      values[neighbor] = bound;
      queue.push({bound, neighbor});
    }
  }
  return {grid_, std::move(values)};
}

}  // namespace pgdr
