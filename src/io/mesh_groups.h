// SPDX-License-Identifier: GPL-3.0-or-later
// Private to src/io: elements by reference, for formats that list them in named groups.
#ifndef PGDR_SRC_IO_MESH_GROUPS_H
#define PGDR_SRC_IO_MESH_GROUPS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/scale.h>
#include <pgdr/io/atomic_file.h>
#include <pgdr/mesh/indexed_mesh_3.h>

#include "text_blocks.h"

namespace pgdr::io_detail {

inline std::int32_t reference_of(const std::vector<std::int32_t>& references, std::size_t i) {
  return i < references.size() ? references[i] : 0;
}

/// Elements with the same reference.
struct Mesh_group {
  std::string name;      ///< "region_1", "marker_7"
  std::int32_t tag = 0;  ///< the reference where it is positive, else the smallest positive number that no other group has: many formats have no others
  std::vector<std::uint32_t> elements;  ///< ascending
};

/// All groups, ascending by reference. \param kind what their names begin with
inline std::vector<Mesh_group> groups_of(const char* kind, std::size_t count, const std::vector<std::int32_t>& references) {
  std::map<std::int32_t, std::vector<std::uint32_t>> by_reference;
  std::vector<std::uint32_t>* last = nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    if (i == 0 || reference_of(references, i) != reference_of(references, i - 1)) last = &by_reference[reference_of(references, i)];
    last->push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<Mesh_group> groups;
  std::int32_t free = 0;
  for (auto& [reference, elements] : by_reference) {
    if (reference <= 0)
      do ++free;
      while (by_reference.contains(free));
    groups.push_back({std::string(kind) + "_" + std::to_string(reference), reference > 0 ? reference : free, std::move(elements)});
  }
  return groups;
}

/// Tetrahedra by region, triangles by marker.
inline std::vector<Mesh_group> regions_of(const Indexed_mesh_3& mesh) { return groups_of("region", mesh.tetrahedra.size(), mesh.tetrahedron_references); }
inline std::vector<Mesh_group> markers_of(const Indexed_mesh_3& mesh) { return groups_of("marker", mesh.triangles.size(), mesh.triangle_references); }

/// Coordinates of a point in the user's unit, each with `separator` before it; returns the end of the text.
inline char* put_point(char* out, const Indexed_mesh_3& mesh, std::size_t i, char separator) {
  const double unit = unit_of(mesh);
  for (const double x : mesh.points[i]) out = put_number(put_char(out, separator), unit * x);
  return out;
}

/// The vertices of an element, counted from `first`, each with `separator` before it; returns the end of the text.
template <std::size_t N>
char* put_vertices(char* out, const std::array<std::uint32_t, N>& element, unsigned first, char separator) {
  for (const std::uint32_t v : element) out = put_number(put_char(out, separator), std::uint64_t{v} + first);
  return out;
}

}  // namespace pgdr::io_detail

#endif
