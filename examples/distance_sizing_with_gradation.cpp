// SPDX-License-Identifier: GPL-3.0-or-later
// Fine near one face and around a point, coarse elsewhere, and growing evenly in between.
#include <iostream>

#include <pgdr/io/write_mesh.h>
#include <pgdr/refine_mesh_3.h>

#include "cube.h"

int main() {
  // 0.03 on the bottom, 0.2 at a distance of 0.5 and beyond.
  const pgdr::Distance_sizing_field near_bottom({{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}, {{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}, 0.03, 0.2, 0.5);
  // 0.02 in a ball around the middle of the top; from there it grows by 0.3 for each unit of distance, up to 0.2.
  const pgdr::Local_sizing_field<> around_point(pgdr::Uniform_sizing_field(0.2), {}, {{{0.5, 0.5, 1}, 0.05, 0.02}}, 0.3);
  // The smallest of all wins.
  const pgdr::Combined_sizing_field sizing(around_point, {near_bottom});

  const pgdr::Indexed_mesh_3 mesh = pgdr::indexed_mesh_3(pgdr::refine_mesh_3(cube(), sizing));
  pgdr::write_mesh(mesh, "graded.vtu");
  std::cout << mesh.tetrahedra.size() << " tetrahedra in graded.vtu\n";
}
