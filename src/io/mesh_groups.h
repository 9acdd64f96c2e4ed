// SPDX-License-Identifier: GPL-3.0-or-later
// Private to src/io: elements by reference, for formats that list them in named groups.
#ifndef PGDR_SRC_IO_MESH_GROUPS_H
#define PGDR_SRC_IO_MESH_GROUPS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/free_numbers.h>
#include <pgdr/domain/reference_names.h>
#include <pgdr/domain/scale.h>
#include <pgdr/io/atomic_file.h>
#include <pgdr/mesh/indexed_mesh_3.h>

#include "text_blocks.h"

namespace pgdr::io_detail {

inline std::int32_t reference_of(const std::vector<std::int32_t>& references, std::size_t i) {
  return i < references.size() ? references[i] : 0;
}

/// Corners of a triangle in ascending order: what tells whether two are the same.
inline std::array<std::uint32_t, 3> sorted_corners(std::array<std::uint32_t, 3> corners) {
  std::ranges::sort(corners);
  return corners;
}

/// Of the face of a tetrahedron that is opposite to corner `k`.
inline std::array<std::uint32_t, 3> sorted_face(const std::array<std::uint32_t, 4>& t, std::size_t k) { return sorted_corners({t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]}); }

/// Elements with the same reference.
struct Mesh_group {
  std::string name;      ///< the user's, or "region_1", "marker_7"; no other group of the kind has it, in upper or lower case
  std::int32_t tag = 0;  ///< the reference where it is positive, else the smallest positive number that no other group has: many formats have no others
  std::vector<std::uint32_t> elements;  ///< ascending
};

/// A name that fits between quotes and on a line.
inline std::string quotable(std::string name) {
  for (char& c : name)
    if (c == '"' || c == '\\' || static_cast<unsigned char>(c) < ' ') c = '_';
  return name;
}

/// A name as one word, for formats that separate by blanks or commas.
inline std::string word_of(std::string name) {
  for (char& c : name)
    if (!(('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '-' || c == '.' || static_cast<unsigned char>(c) >= 0x80)) c = '_';
  return name;
}

/// All groups, ascending by reference. \param kind what names begin with where the user gave none \param as_written how a name looks in the format
template <class As_written>
std::vector<Mesh_group> groups_of(const char* kind, std::size_t count, const std::vector<std::int32_t>& references, const std::map<int, std::string>& names,
                                  const As_written& as_written) {
  std::map<std::int32_t, std::vector<std::uint32_t>> by_reference;
  std::vector<std::uint32_t>* last = nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    if (i == 0 || reference_of(references, i) != reference_of(references, i - 1)) last = &by_reference[reference_of(references, i)];
    last->push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<Mesh_group> groups;
  std::set<std::string> taken;
  Free_numbers numbers(by_reference);
  for (auto& [reference, elements] : by_reference) {
    const std::string number = std::to_string(reference), plain = std::string(kind) + "_" + number;
    const auto named = names.find(reference);
    std::string name = named == names.end() || named->second.empty() ? plain : as_written(named->second);
    while (!taken.insert(in_lower_case(name)).second) name += "_" + number;
    groups.push_back({std::move(name), reference > 0 ? reference : numbers.next(), std::move(elements)});
  }
  return groups;
}

/// The tag of each element's group.
inline std::vector<std::int32_t> tags_of(std::size_t count, const std::vector<std::int32_t>& references) {
  std::vector<std::int32_t> tags(count);
  for (const Mesh_group& g : groups_of("", count, references, {}, quotable))
    for (const std::uint32_t i : g.elements) tags[i] = g.tag;
  return tags;
}

/// Tetrahedra by region, triangles by marker.
template <class As_written>
std::vector<Mesh_group> regions_of(const Indexed_mesh_3& mesh, const As_written& as_written) {
  return groups_of("region", mesh.tetrahedra.size(), mesh.tetrahedron_references, distinct_names(mesh.names).regions, as_written);
}
template <class As_written>
std::vector<Mesh_group> markers_of(const Indexed_mesh_3& mesh, const As_written& as_written) {
  return groups_of("marker", mesh.triangles.size(), mesh.triangle_references, distinct_names(mesh.names).markers, as_written);
}

/// Elements with `N` corners and, in a mesh of second order, `M` nodes in the middle of their edges, in the order that a format wants.
template <std::size_t N, std::size_t M>
struct Element_nodes {
  const std::vector<std::array<std::uint32_t, N>>& corners;
  const std::vector<std::array<std::uint32_t, M>>& middle;  ///< empty in a mesh of first order
  std::array<std::size_t, M> order;

  std::size_t size() const { return corners.size(); }
  std::size_t nodes_of_each() const { return middle.empty() ? N : N + M; }
  std::uint32_t node(std::size_t i, std::size_t k) const { return k < N ? corners[i][k] : middle[i][order[k - N]]; }
};

/// For formats that have no others. Throws `std::invalid_argument`.
inline void require_first_order(const Indexed_mesh_3& mesh, const std::filesystem::path& path) {
  if (!mesh.tetrahedron_nodes.empty()) throw std::invalid_argument("cannot write '" + path.string() + "': the format has no tetrahedra of second order");
}

/// Orders of the edges 01, 12, 20, 03, 13, 23 of a tetrahedron.
constexpr std::array<std::size_t, 6> edges_in_vtk{0, 1, 2, 3, 4, 5};     ///< Abaqus's, too
constexpr std::array<std::size_t, 6> edges_in_gmsh{0, 1, 2, 3, 5, 4};
constexpr std::array<std::size_t, 6> edges_in_tetgen{5, 3, 0, 1, 4, 2};  ///< as TetGen 1.5 writes with -o2

using Triangle_nodes = Element_nodes<3, 3>;
using Tetrahedron_nodes = Element_nodes<4, 6>;
inline Triangle_nodes triangles_of(const Indexed_mesh_3& mesh) { return {mesh.triangles, mesh.triangle_nodes, {0, 1, 2}}; }
inline Tetrahedron_nodes tetrahedra_of(const Indexed_mesh_3& mesh, const std::array<std::size_t, 6>& order) { return {mesh.tetrahedra, mesh.tetrahedron_nodes, order}; }

/// Coordinates of a point in the user's unit, each with `separator` before it; returns the end of the text.
inline char* put_point(char* out, const Indexed_mesh_3& mesh, std::size_t i, char separator) {
  const double unit = unit_of(mesh);
  for (const double x : mesh.points[i]) out = put_number(put_char(out, separator), unit * x);
  return out;
}

/// The nodes of element `i`, counted from `first`, each with `separator` before it; returns the end of the text.
template <std::size_t N, std::size_t M>
char* put_nodes(char* out, const Element_nodes<N, M>& elements, std::size_t i, unsigned first, char separator) {
  for (std::size_t k = 0; k < elements.nodes_of_each(); ++k) out = put_number(put_char(out, separator), std::uint64_t{elements.node(i, k)} + first);
  return out;
}

}  // namespace pgdr::io_detail

#endif
