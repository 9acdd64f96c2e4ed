// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_CONFORMING_GRIDDED_BOX_H
#define PGDR_TEST_CONFORMING_GRIDDED_BOX_H

#include <utility>
#include <vector>

#include "domain/shapes.h"

namespace pgdr_test {

/// The box [0,n] x [0,n] x [0,n/2], its top cut into n x n squares: as many vertices, by fours on common circles.
inline Plc gridded_box(Index n) {
  Plc plc;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) plc.vertices.emplace_back(i, j, 0.5 * n);
  const auto at = [n](Index i, Index j) { return j * (n + 1) + i; };
  const Index bottom = static_cast<Index>(plc.vertices.size());
  for (const auto& [x, y] : {std::pair<Index, Index>{0, 0}, {n, 0}, {n, n}, {0, n}})
    plc.vertices.emplace_back(x, y, 0);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      plc.facets.push_back({{{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}}, {}, 0});
  plc.facets.push_back({{{bottom, bottom + 1, bottom + 2, bottom + 3}}, {}, 0});
  for (Index side = 0; side < 4; ++side) {
    std::vector<Index> p{bottom + side, bottom + (side + 1) % 4};
    for (Index k = 0; k <= n; ++k) {
      const Index m = n - k;
      p.push_back(side == 0 ? at(m, 0) : side == 1 ? at(n, m) : side == 2 ? at(k, n) : at(0, k));
    }
    plc.facets.push_back({{p}, {}, 0});
  }
  return plc;
}

}  // namespace pgdr_test

#endif
