// SPDX-License-Identifier: GPL-3.0-or-later
// A Surface_mesh becomes a C3T3 with cells of our own, which is refined further; a copy is remeshed and written by CGAL.
#include <fstream>
#include <iostream>

#include <CGAL/IO/output_to_vtu.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/tetrahedral_remeshing.h>

#include <pgdr/cgal/complex_triangulation_3.h>
#include <pgdr/make_mesh_3.h>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Tr = pgdr::Complex_triangulation_3<K, CGAL::Triangulation_cell_base_with_info_3<int, K>>;
using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<Tr>;

int main() {
  CGAL::Surface_mesh<K::Point_3> surface;
  CGAL::make_icosahedron(surface, K::Point_3(0, 0, 0), 1);
  C3t3 mesh = pgdr::make_mesh_3<C3t3>(surface, {.edge_size = 0.4, .facet_size = 0.25, .cell_size = 0.3});
  std::cout << mesh.number_of_cells_in_complex() << " tetrahedra, ";
  pgdr::refine_mesh_3(mesh, {.cell_size = [](const K::Point_3& p) { return 0.08 + 0.2 * p.z() * p.z(); }});
  std::cout << mesh.number_of_cells_in_complex() << " when refined further\n";
  for (Tr::Cell_handle cell : mesh.triangulation().finite_cell_handles()) cell->info() = mesh.is_in_complex(cell);

  C3t3 remeshed = mesh;
  CGAL::tetrahedral_isotropic_remeshing(remeshed, 0.2, CGAL::parameters::number_of_iterations(1));
  try {
    pgdr::refine_mesh_3(remeshed, pgdr::Uniform_sizing_field(0.1));
  } catch (const std::invalid_argument& e) {
    std::cout << "after remeshing: " << e.what() << "\n";
  }
  std::ofstream file("remeshed.vtu", std::ios::binary);
  CGAL::IO::output_to_vtu(file, remeshed);
}
