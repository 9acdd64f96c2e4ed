// SPDX-License-Identifier: GPL-3.0-or-later
// How far cavities and stars reach from a leaf.
#ifndef PGDR_TEST_INDEPENDENCE_ZONE_REACH_H
#define PGDR_TEST_INDEPENDENCE_ZONE_REACH_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include <pgdr/independence/zone_condition.h>
#include <pgdr/octree/linear_octree_3.h>

#include "independence/random_triangulations.h"

namespace pgdr_test {

using Coordinates = std::array<double, 3>;

/// What the zone condition asks for a leaf, which is the hole of it.
inline pgdr::Requirement zone_requirement(const pgdr::Linear_octree_3& octree, std::uint32_t leaf) {
  std::vector<pgdr::Requirement> all;
  pgdr::Zone_condition().requirements(octree, leaf, all);
  return all.at(0);
}

/// From the hole of a requirement, the leaf, in the maximum norm.
inline double distance(const pgdr::Requirement& r, const Point& p) {
  double result = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    result = std::max({result, r.hole_lower[a] - p[axis], p[axis] - r.hole_upper[a]});
  }
  return result;
}

/// Squared Euclidean distance of a point from a closed box.
inline double squared_distance_to_box(const Coordinates& lower, const Coordinates& upper, const Point& p) {
  double result = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double d = std::max({lower[a] - p[axis], 0.0, p[axis] - upper[a]});
    result += d * d;
  }
  return result;
}

struct Reach {
  double cavity = 0, zone = 0;  ///< the largest distances from the leaf, in units of d and 2d
  std::size_t cavities = 0, on_hull = 0;

  void include(const Reach& other) {
    cavity = std::max(cavity, other.cavity);
    zone = std::max(zone, other.zone);
    cavities += other.cavities;
    on_hull += other.on_hull;
  }
};

/// Distances from a leaf, the hole of the requirement: of the vertices of the cavity of p, and of all cells around these
/// vertices. `shortest` is l* of the leaf.
inline void measure(const Delaunay& mesh, const pgdr::Requirement& r, double shortest, const Point& p,
                    Reach& reach) {
  const double d = shortest / 4;
  if (is_vertex(mesh, p)) return;
  const Cavity cavity(mesh, p);
  std::vector<Delaunay::Cell_handle> around;
  bool infinite = false;
  for (const Delaunay::Cell_handle c : cavity.cells) {
    infinite = infinite || mesh.is_infinite(c);
    for (int k = 0; k < 4; ++k) {
      const Delaunay::Vertex_handle v = c->vertex(k);
      if (mesh.is_infinite(v)) continue;
      reach.cavity = std::max(reach.cavity, distance(r, v->point()) / d);
      around.clear();
      mesh.incident_cells(v, std::back_inserter(around));
      for (const Delaunay::Cell_handle n : around) {
        for (int l = 0; l < 4; ++l) {
          if (mesh.is_infinite(n->vertex(l))) continue;
          reach.zone = std::max(reach.zone, distance(r, n->vertex(l)->point()) / (2 * d));
        }
      }
    }
  }
  ++reach.cavities;
  reach.on_hull += infinite;
}

}  // namespace pgdr_test

#endif
