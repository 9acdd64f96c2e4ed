// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes the unit cube with circumradii of at most 0.1 and writes cube.vtu.
#include <iostream>
#include <vector>

#include <pgdr/io/write_mesh.h>
#include <pgdr/refine_mesh_3.h>

int main() {
  pgdr::Plc cube;
  for (int i = 0; i < 8; ++i) cube.vertices.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  for (std::vector<pgdr::Index> face : {std::vector<pgdr::Index>{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}})
    cube.facets.push_back({{face}, {}, 0});
  const auto mesh = pgdr::indexed_mesh_3(pgdr::refine_mesh_3(cube, pgdr::Uniform_sizing_field(0.1)));
  pgdr::write_mesh(mesh, "cube.vtu");
  std::cout << mesh.tetrahedra.size() << " tetrahedra in cube.vtu\n";
}
