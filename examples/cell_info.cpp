// SPDX-License-Identifier: GPL-3.0-or-later
// Cells that know something of ours: a property of the material, set by region.
#include <iostream>

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>

#include <pgdr/cgal/complex_triangulation_3.h>
#include <pgdr/make_mesh_3.h>

struct Material {
  double density = 0;
};

using K = pgdr::Epick;
using Tr = pgdr::Complex_triangulation_3<K, CGAL::Triangulation_cell_base_with_info_3<Material, K>>;
using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<Tr>;

int main() {
  pgdr::Plc plc;  // a cube, divided in the middle
  for (int i = 0; i < 12; ++i) plc.vertices.emplace_back(i & 1, i >> 1 & 1, 0.5 * (i >> 2));
  for (const pgdr::Index z : {0u, 4u, 8u}) plc.facets.push_back({{{z, z + 1, z + 3, z + 2}}, {}, 0});
  for (const pgdr::Index z : {0u, 4u})
    for (const auto& [a, b] : {std::pair{0u, 1u}, {1u, 3u}, {3u, 2u}, {2u, 0u}}) plc.facets.push_back({{{z + a, z + b, z + 4 + b, z + 4 + a}}, {}, 0});
  plc.regions = {{{0.5, 0.5, 0.25}, 1, 0, 0}, {{0.5, 0.5, 0.75}, 2, 0, 0}};

  C3t3 mesh = pgdr::make_mesh_3<C3t3>(plc, pgdr::Uniform_sizing_field(0.1));
  double mass = 0;
  for (const Tr::Cell_handle cell : mesh.triangulation().finite_cell_handles()) {
    if (!mesh.is_in_complex(cell)) continue;
    cell->info().density = mesh.subdomain_index(cell) == 1 ? 7.8 : 2.7;
    mass += cell->info().density * mesh.triangulation().tetrahedron(cell).volume();
  }
  std::cout << "mass " << mass << " of " << 0.5 * (7.8 + 2.7) << "\n";
}
