// SPDX-License-Identifier: GPL-3.0-or-later
// Two boxes that share a face, from a polygon soup: each is a region with a size of its own, and the mesh conforms between them.
#include <array>
#include <iostream>
#include <map>
#include <vector>

#include <pgdr/cgal/plc_from_polygon_soup.h>
#include <pgdr/refine_mesh_3.h>

int main() {
  std::vector<pgdr::Epick::Point_3> points;
  for (int x = 0; x < 3; ++x)
    for (int i = 0; i < 4; ++i) points.emplace_back(x, i & 1, i >> 1);
  const std::vector<std::array<int, 4>> polygons{{0, 1, 3, 2}, {4, 5, 7, 6}, {8, 9, 11, 10},                               // across
                                                 {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6},                    // the first box
                                                 {4, 5, 9, 8}, {5, 7, 11, 9}, {7, 6, 10, 11}, {6, 4, 8, 10}};               // the second one
  // The face between them has marker 2, which the triangles on it keep.
  pgdr::Plc plc = pgdr::plc_from_polygon_soup(points, polygons, [](std::size_t i) { return i == 1 ? 2 : 1; });
  plc.regions = {{{0.5, 0.5, 0.5}, 10, 0, 0.2},   // point, id, no bound of the volume, largest circumradius
                 {{1.5, 0.5, 0.5}, 20, 0, 0.05}};

  const pgdr::Indexed_mesh_3 mesh = pgdr::indexed_mesh_3(pgdr::refine_mesh_3(plc, pgdr::Uniform_sizing_field()));
  std::map<int, std::size_t> tetrahedra, triangles;
  for (const int region : mesh.tetrahedron_references) ++tetrahedra[region];
  for (const int marker : mesh.triangle_references) ++triangles[marker];
  for (const auto& [region, n] : tetrahedra) std::cout << "region " << region << ": " << n << " tetrahedra\n";
  std::cout << triangles[2] << " triangles between them\n";
  return tetrahedra[20] > tetrahedra[10] && triangles[2] > 0 ? 0 : 1;
}
