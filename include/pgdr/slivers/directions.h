// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_DIRECTIONS_H
#define PGDR_SLIVERS_DIRECTIONS_H

#include <array>
#include <cstddef>

#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// From the middle of a cube to its corners and the middles of its edges and sides; not of unit length.
inline constexpr std::array<Vec_3, 26> directions = [] {
  std::array<Vec_3, 26> all;
  std::size_t n = 0;
  for (const double z : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0})
      for (const double x : {-1.0, 0.0, 1.0})
        if (x != 0 || y != 0 || z != 0) all[n++] = {x, y, z};
  return all;
}();

}  // namespace pgdr

#endif
