// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh made yesterday, finer around a point: all of its vertices stay.
#include <iostream>

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <pgdr/cgal/complex_triangulation_3.h>
#include <pgdr/make_mesh_3.h>

using K = pgdr::Epick;
using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<pgdr::Complex_triangulation_3<K>>;

int main() {
  CGAL::Surface_mesh<K::Point_3> surface;
  CGAL::make_icosahedron(surface, K::Point_3(0, 0, 0), 1);
  C3t3 mesh = pgdr::make_mesh_3<C3t3>(surface, pgdr::Uniform_sizing_field(0.2));
  const auto before = mesh.triangulation().number_of_vertices();
  std::cout << mesh.number_of_cells_in_complex() << " tetrahedra, ";

  const pgdr::Local_sizing_field<> finer(pgdr::Uniform_sizing_field(), {}, {{{0.3, 0, 0}, 0.2, 0.04}}, 0.5);
  pgdr::refine_mesh_3(mesh, pgdr::Combined_sizing_field(finer));
  std::cout << mesh.number_of_cells_in_complex() << " when refined further\n";
  return mesh.triangulation().number_of_vertices() > before && mesh.triangulation().is_valid() ? 0 : 1;
}
