// SPDX-License-Identifier: GPL-3.0-or-later
// Steiner points where we want them, within what the theory allows, and a size that is any function of the place.
#include <cmath>
#include <iostream>

#include <pgdr/refine_mesh_3.h>

#include "cube.h"

namespace {

/// Halfway between the circumcenter and the border of the type-I selection ball, towards the shortest edge.
struct Halfway_placement {
  pgdr::Vec_3 operator()(const pgdr::Poor_tetrahedron& t) const { return pgdr::towards_shortest_edge(t, 0.5 * t.type_1_radius()); }
};

}  // namespace

int main() {
  const auto sizing = [](const pgdr::Epick::Point_3& p) { return 0.05 + 0.2 * std::abs(p.x() - 0.5); };

  pgdr::Parameters parameters;
  parameters.verify = true;  // throws if the result were not Delaunay
  const auto mesh = pgdr::refine_mesh_3(pgdr::make_domain_3(cube()), sizing, parameters, Halfway_placement{});
  std::cout << mesh.triangulation().number_of_finite_cells() << " tetrahedra\n";
}
