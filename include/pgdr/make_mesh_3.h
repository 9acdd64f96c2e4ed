// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MAKE_MESH_3_H
#define PGDR_MAKE_MESH_3_H

#include <utility>

#include <pgdr/cgal/mesh_complex_3.h>
#include <pgdr/cgal/plc_from_face_graph.h>
#include <pgdr/cgal/plc_from_mesh_complex_3.h>
#include <pgdr/domain/valid_domain.h>
#include <pgdr/refine_mesh_3.h>
#include <pgdr/sizing/mesh_criteria_3.h>

namespace pgdr {

/// Meshes a PLC and returns CGAL's complex: `refine_mesh_3`, then `mesh_complex_3`, which say what is promised and thrown.
template <MeshComplex C3t3, SizingField<Default_kernel> Sizing>
C3t3 make_mesh_3(const Plc& plc, const Sizing& sizing, const Parameters& parameters = {}) {
  return mesh_complex_3<C3t3>(refine_mesh_3(plc, sizing, parameters));
}

/// The same from a surface mesh, a model of CGAL's `FaceListGraph`; for patches and feature edges see `plc_from_face_graph`.
template <MeshComplex C3t3, class FaceGraph, SizingField<Default_kernel> Sizing>
C3t3 make_mesh_3(const FaceGraph& surface, const Sizing& sizing, const Parameters& parameters = {}) {
  return make_mesh_3<C3t3>(plc_from_face_graph(surface), sizing, parameters);
}

/// By criteria for edges, facets and cells. Throws what `sizing_of` throws, too.
template <MeshComplex C3t3>
C3t3 make_mesh_3(const Plc& plc, const Mesh_criteria_3& criteria, Parameters parameters = {}) {
  parameters.radius_edge_ratio = criteria.cell_radius_edge_ratio;
  Domain_3<Default_kernel> domain = valid_domain(plc, parameters.coplanar_tolerance, parameters.triangulate_facets);
  const Combined_sizing_field sizing = sizing_of(criteria, domain);
  return mesh_complex_3<C3t3>(refine_mesh_3(std::move(domain), sizing, parameters));
}

template <MeshComplex C3t3, class FaceGraph>
C3t3 make_mesh_3(const FaceGraph& surface, const Mesh_criteria_3& criteria, const Parameters& parameters = {}) {
  return make_mesh_3<C3t3>(plc_from_face_graph(surface), criteria, parameters);
}

/// Refines a mesh further, to another size or ratio (by a sizing field or by `Mesh_criteria_3`): it keeps all of its vertices and the same parts. Vertices and cells are
/// new ones: handles and what the user kept in them are lost. Throws what `plc_from_mesh_complex_3` and `make_mesh_3` throw, and leaves the mesh as it is then.
template <MeshComplex C3t3, class Criteria = Mesh_criteria_3>
void refine_mesh_3(C3t3& c3t3, const Criteria& criteria, const Parameters& parameters = {}) {
  C3t3 refined = make_mesh_3<C3t3>(plc_from_mesh_complex_3(c3t3), criteria, parameters);
  c3t3.swap(refined);
}

}  // namespace pgdr

#endif
