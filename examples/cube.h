// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_EXAMPLES_CUBE_H
#define PGDR_EXAMPLES_CUBE_H

#include <vector>

#include <pgdr/domain/default_kernel.h>

/// Adds a unit cube to a PLC, with its smallest corner at (x, 0, 0); its first face is the bottom, its last the one with the largest x.
inline void add_cube(pgdr::Plc& plc, double x = 0) {
  const auto first = static_cast<pgdr::Index>(plc.vertices.size());
  for (int i = 0; i < 8; ++i) plc.vertices.emplace_back(x + (i & 1), i >> 1 & 1, i >> 2 & 1);
  for (std::vector<pgdr::Index> face : std::vector<std::vector<pgdr::Index>>{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    for (pgdr::Index& v : face) v += first;
    plc.facets.push_back({{face}, {}, 0});
  }
}

inline pgdr::Plc cube() {
  pgdr::Plc plc;
  add_cube(plc);
  return plc;
}

#endif
