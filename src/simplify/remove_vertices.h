// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_REMOVE_VERTICES_H
#define PGDR_SIMPLIFY_REMOVE_VERTICES_H

#include <cstddef>
#include <vector>

#include <pgdr/domain/default_kernel.h>

namespace pgdr::simplify_detail {

/// Takes vertices away that no polygon and no segment names, and numbers the others anew.
inline void remove_vertices(Plc& plc, const std::vector<bool>& goes) {
  std::vector<Index> number(plc.vertices.size());
  std::size_t left = 0, markers = 0;
  for (std::size_t v = 0; v < plc.vertices.size(); ++v) {
    number[v] = static_cast<Index>(left);
    if (goes[v]) continue;
    if (v < plc.vertex_markers.size()) plc.vertex_markers[markers++] = plc.vertex_markers[v];
    plc.vertices[left++] = plc.vertices[v];
  }
  plc.vertices.resize(left);
  plc.vertex_markers.resize(markers);
  for (auto& facet : plc.facets)
    for (auto& polygon : facet.polygons)
      for (Index& v : polygon) v = number[v];
  for (Plc_segment& s : plc.segments) {
    s.source = number[s.source];
    s.target = number[s.target];
  }
}

}  // namespace pgdr::simplify_detail

#endif
