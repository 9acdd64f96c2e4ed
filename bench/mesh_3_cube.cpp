// SPDX-License-Identifier: GPL-3.0-or-later
//
// A peer to compare with (bench/peers.py): the unit cube meshed by CGAL's Mesh_3 as its manual shows it, as a
// polyhedral domain with sharp edges, with Parallel_tag where it was built with TBB. It writes Medit .mesh.
// No perturbation and no exudation: pgdr does not remove slivers either.
//
// usage: mesh_3_cube CELL_SIZE OUTPUT [THREADS]
//   CELL_SIZE  bound of the circumradius of tetrahedra and of subfacets, and of the length of edges along the
//              sharp edges; the radius-edge ratio is bounded by 2
//   THREADS    0 (default): all

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_polyhedron_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/tags.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel, Polyhedron>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Parallel_tag>::type;
using Complex =
    CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

// Mesh_3 reads surfaces of triangles.
constexpr const char* unit_cube =
    "OFF\n8 12 0\n"
    "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n"
    "3 0 2 3\n3 0 3 1\n3 4 5 7\n3 4 7 6\n3 0 1 5\n3 0 5 4\n"
    "3 2 6 7\n3 2 7 3\n3 0 4 6\n3 0 6 2\n3 1 3 7\n3 1 7 5\n";

}  // namespace

int main(int argc, char** argv) {
  const double size = argc > 1 ? std::atof(argv[1]) : 0;
  const int threads = argc > 3 ? std::atoi(argv[3]) : 0;
  if (argc < 3 || argc > 4 || !(size > 0) || threads < 0) {
    std::cerr << "usage: mesh_3_cube CELL_SIZE OUTPUT [THREADS]\n";
    return 2;
  }
  const auto at_once = threads > 0 ? static_cast<std::size_t>(threads)
                                   : static_cast<std::size_t>(tbb::info::default_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, at_once);

  Polyhedron surface;
  std::istringstream(unit_cube) >> surface;
  Domain domain(surface);
  domain.detect_features();

  namespace P = CGAL::parameters;
  const Criteria criteria(P::edge_size = size, P::facet_angle = 25, P::facet_size = size,
                          P::cell_radius_edge_ratio = 2, P::cell_size = size);
  const auto complex = CGAL::make_mesh_3<Complex>(domain, criteria, P::no_perturb(), P::no_exude());

  std::ofstream file(argv[2]);
  complex.output_to_medit(file);
  file.close();
  if (!file) {
    std::cerr << "mesh_3_cube: cannot write " << argv[2] << "\n";
    return 1;
  }
  std::cout << complex.number_of_cells_in_complex() << " tetrahedra\n";
}
