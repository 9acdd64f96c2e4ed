// SPDX-License-Identifier: GPL-3.0-or-later
// What must not compile; the comment before each function is in what the compiler says about it.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Surface_mesh.h>

#include <pgdr/cgal/mesh_complex_3.h>
#include <pgdr/cgal/plc_from_face_graph.h>
#include <pgdr/cgal/plc_from_mesh_complex_3.h>
#include <pgdr/cgal/plc_from_polygon_soup.h>

using K = pgdr::Default_kernel;
// What CGAL's own mesher takes by default: a regular triangulation, with weights, and pairs for indices.
using Weighted = CGAL::Mesh_triangulation_3<CGAL::Polyhedral_mesh_domain_3<CGAL::Surface_mesh<K::Point_3>, K>>::type;
using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<Weighted>;
using Exact_point = CGAL::Exact_predicates_exact_constructions_kernel::Point_3;

// take a complex over CGAL::Delaunay_triangulation_3, not over a weighted (regular) triangulation
C3t3 out(const pgdr::Refined_mesh_3<K>& mesh) { return pgdr::mesh_complex_3<C3t3>(mesh); }

// take a complex whose indices can be made of an int
pgdr::Plc in(const C3t3& c3t3) { return pgdr::plc_from_mesh_complex_3(c3t3); }

// copy a surface of exact numbers to one of doubles first
pgdr::Plc in(const CGAL::Surface_mesh<Exact_point>& surface) { return pgdr::plc_from_face_graph(surface); }

// round exact numbers first
pgdr::Plc in(const std::vector<Exact_point>& points, const std::vector<std::vector<std::size_t>>& polygons) { return pgdr::plc_from_polygon_soup(points, polygons); }
