// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_EDGE_LENGTH_H
#define PGDR_SIZING_EDGE_LENGTH_H

namespace pgdr {

/// Mean length of the edges of a mesh with a bound on circumradii, as a part of it: 1.33, 1.35 and 1.35 in cubes of 0.04, 0.3 and 2.4 million tetrahedra.
constexpr double mean_edge = 1.35;

}  // namespace pgdr

#endif
