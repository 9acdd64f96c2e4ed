// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CGAL_PLC_FROM_FACE_GRAPH_H
#define PGDR_CGAL_PLC_FROM_FACE_GRAPH_H

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>

#include <pgdr/domain/default_kernel.h>

namespace pgdr {

/// The PLC of a surface mesh: a facet for each face, polygons included.
///
/// \tparam FaceGraph a model of CGAL's `FaceListGraph`, such as `CGAL::Surface_mesh<P>` or `CGAL::Polyhedron_3<K>`
/// \param np optional, CGAL's named parameters:
///   - `vertex_point_map(m)`: the points; that of the graph unless given
///   - `face_patch_map(m)`: an `int` for each face, which becomes the facet's marker; faces with different ones are never fused, and the triangles on
///     them have it for a reference
///   - `edge_is_constrained_map(m)`: edges that every mesh keeps, even within a plane. Where faces are not in one plane, edges are kept anyway.
/// Of nested closed parts the outermost is material, what it holds is void, and so on; `nesting` of the result says so and may be changed, seeds of holes and
/// regions may be added. Whether the surface is closed and free of intersections is found out when the PLC is meshed.
/// Throws `std::length_error` for more than 2^32 - 2 vertices.
template <class FaceGraph, class NamedParameters = CGAL::parameters::Default_named_parameters>
Plc plc_from_face_graph(const FaceGraph& graph, const NamedParameters& np = CGAL::parameters::default_values()) {
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using Patches = std::decay_t<decltype(get_parameter(np, CGAL::internal_np::face_patch))>;
  using Constrained = std::decay_t<decltype(get_parameter(np, CGAL::internal_np::edge_is_constrained))>;
  using Absent = CGAL::internal_np::Param_not_found;

  const auto points = choose_parameter(get_parameter(np, CGAL::internal_np::vertex_point), CGAL::get_const_property_map(CGAL::vertex_point, graph));
  Plc plc;
  plc.nesting = Nesting::alternate;
  plc.vertices.reserve(num_vertices(graph));
  plc.facets.reserve(num_faces(graph));
  const auto number = get(CGAL::dynamic_vertex_property_t<Index>(), graph);
  for (const auto v : vertices(graph)) {
    if (plc.vertices.size() == std::numeric_limits<Index>::max() - 1) throw std::length_error("the surface has more than 2^32 - 2 vertices");
    put(number, v, static_cast<Index>(plc.vertices.size()));
    const auto& p = get(points, v);
    static_assert(std::is_floating_point_v<std::decay_t<decltype(p.x())>>,
                  "pgdr takes coordinates in floating point: copy a surface of exact numbers to one of doubles first, where you see what rounding does to it");
    plc.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : faces(graph)) {
    std::vector<Index> polygon;
    for (const auto v : vertices_around_face(halfedge(f, graph), graph)) polygon.push_back(get(number, v));
    int marker = 0;
    if constexpr (!std::is_same_v<Patches, Absent>) marker = static_cast<int>(get(get_parameter(np, CGAL::internal_np::face_patch), f));
    plc.facets.push_back({{std::move(polygon)}, {}, marker});
  }
  if constexpr (!std::is_same_v<Constrained, Absent>)
    for (const auto e : edges(graph))
      if (get(get_parameter(np, CGAL::internal_np::edge_is_constrained), e)) plc.segments.push_back({get(number, source(e, graph)), get(number, target(e, graph)), 0});
  return plc;
}

}  // namespace pgdr

#endif
