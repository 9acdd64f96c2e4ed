// SPDX-License-Identifier: GPL-3.0-or-later
//
// A peer to compare with (bench/peers.py, bench/quality.py): a closed surface of triangles meshed by CGAL's Mesh_3 as its
// manual shows it, as a polyhedral domain with sharp edges, with Parallel_tag. It writes Medit .mesh.
//
// usage: mesh_3_peer SURFACE.off CELL_SIZE OUTPUT [THREADS [SECONDS]]
//   CELL_SIZE  bound of the circumradius of tetrahedra and of subfacets, and of the length of edges along the
//              sharp edges; the radius-edge ratio is bounded by 2
//   THREADS    0 (default): all
//   SECONDS    that slivers may be perturbed for, and then exuded; 0 (default): neither, as for pgdr with --min-dihedral 0

#include <cstdlib>
#include <fstream>
#include <iostream>

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

}  // namespace

int main(int argc, char** argv) {
  const double size = argc > 2 ? std::atof(argv[2]) : 0;
  const int threads = argc > 4 ? std::atoi(argv[4]) : 0;
  const double seconds = argc > 5 ? std::atof(argv[5]) : 0;
  if (argc < 4 || argc > 6 || !(size > 0) || threads < 0 || !(seconds >= 0)) {
    std::cerr << "usage: mesh_3_peer SURFACE.off CELL_SIZE OUTPUT [THREADS [SECONDS]]\n";
    return 2;
  }
  const auto at_once = threads > 0 ? static_cast<std::size_t>(threads)
                                   : static_cast<std::size_t>(tbb::info::default_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, at_once);

  Polyhedron surface;
  std::ifstream input(argv[1]);
  if (!(input >> surface) || !surface.is_closed() || !surface.is_pure_triangle()) {
    std::cerr << "mesh_3_peer: " << argv[1] << " is no closed surface of triangles\n";
    return 1;
  }
  Domain domain(surface);
  domain.detect_features();

  namespace P = CGAL::parameters;
  const Criteria criteria(P::edge_size = size, P::facet_angle = 25, P::facet_size = size,
                          P::cell_radius_edge_ratio = 2, P::cell_size = size);
  const auto complex = seconds > 0 ? CGAL::make_mesh_3<Complex>(domain, criteria, P::perturb(P::time_limit = seconds),
                                                                P::exude(P::time_limit = seconds))
                                   : CGAL::make_mesh_3<Complex>(domain, criteria, P::no_perturb(), P::no_exude());

  std::ofstream file(argv[3]);
  complex.output_to_medit(file);
  file.close();
  if (!file) {
    std::cerr << "mesh_3_peer: cannot write " << argv[3] << "\n";
    return 1;
  }
  std::cout << complex.number_of_cells_in_complex() << " tetrahedra\n";
}
