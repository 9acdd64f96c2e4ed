// SPDX-License-Identifier: GPL-3.0-or-later
// Ways to spoil a valid mesh, each of which a checker has to notice.
#ifndef PGDR_TEST_QUALITY_CORRUPTIONS_H
#define PGDR_TEST_QUALITY_CORRUPTIONS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr_test {

struct Corruption {
  std::string name;
  std::string property;  ///< the line of `check_mesh` that must fail; others may fail too
  bool needs_domain;     ///< whether that line is there only when the checker knows the input
  /// Spoils a valid mesh; throws std::runtime_error where the mesh offers no place for it.
  std::function<void(pgdr::Indexed_mesh_3&)> apply;
};

namespace corruption_detail {

using Mesh = pgdr::Indexed_mesh_3;
using Triangle = std::array<std::uint32_t, 3>;
using K = CGAL::Exact_predicates_inexact_constructions_kernel;

inline Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// The face opposite to vertex `i`, counterclockwise from outside.
inline Triangle face(const Mesh& mesh, std::size_t tetrahedron, std::size_t i) {
  static constexpr std::size_t k[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const auto& t = mesh.tetrahedra[tetrahedron];
  return {t[k[i][0]], t[k[i][1]], t[k[i][2]]};
}

inline std::set<Triangle> listed_triangles(const Mesh& mesh) {
  std::set<Triangle> listed;
  for (const auto& t : mesh.triangles) listed.insert(sorted(t));
  return listed;
}

/// Some tetrahedron and one of its faces that is not a listed triangle.
inline std::array<std::size_t, 2> inner_face(const Mesh& mesh) {
  const auto listed = listed_triangles(mesh);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (std::size_t i = 0; i < 4; ++i)
      if (listed.count(sorted(face(mesh, t, i))) == 0) return {t, i};
  throw std::runtime_error("all faces are on facets");
}

/// A vertex where one or more than two listed edges end: a vertex of the input.
inline std::uint32_t corner(const Mesh& mesh) {
  std::vector<int> ends(mesh.points.size());
  for (const auto& e : mesh.edges)
    for (const auto v : e) ++ends[v];
  for (std::uint32_t v = 0; v < ends.size(); ++v)
    if (ends[v] == 1 || ends[v] > 2) return v;
  throw std::runtime_error("there are no corners");
}

inline K::Point_3 point(const Mesh& mesh, std::uint32_t v) {
  return {mesh.points[v][0], mesh.points[v][1], mesh.points[v][2]};
}

inline bool positive(const Mesh& mesh, const std::array<std::uint32_t, 4>& t) {
  return CGAL::orientation(point(mesh, t[0]), point(mesh, t[1]), point(mesh, t[2]), point(mesh, t[3])) ==
         CGAL::POSITIVE;
}

/// Moves a vertex to the other side of the opposite face of one of its tetrahedra.
inline void move_vertex(Mesh& mesh) {
  const auto [t, i] = inner_face(mesh);
  const Triangle f = face(mesh, t, i);
  auto& p = mesh.points[mesh.tetrahedra[t][i]];
  for (std::size_t k = 0; k < 3; ++k) {
    const double center = (mesh.points[f[0]][k] + mesh.points[f[1]][k] + mesh.points[f[2]][k]) / 3;
    p[k] += 1.5 * (center - p[k]);
  }
}

/// Replaces two tetrahedra on a face by three around the edge between their apices; no longer Delaunay.
inline void flip_2_3(Mesh& mesh) {
  const auto listed = listed_triangles(mesh);
  std::map<Triangle, std::array<std::size_t, 2>> first;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (std::size_t i = 0; i < 4; ++i) {
      const Triangle f = face(mesh, t, i);
      const auto [it, is_new] = first.insert({sorted(f), {t, i}});
      if (is_new || listed.count(sorted(f)) != 0) continue;
      const auto [s, j] = it->second;
      const std::uint32_t a = mesh.tetrahedra[t][i], b = mesh.tetrahedra[s][j];
      const std::array<std::array<std::uint32_t, 4>, 3> flipped{
          {{a, b, f[0], f[1]}, {a, b, f[1], f[2]}, {a, b, f[2], f[0]}}};
      if (!std::all_of(flipped.begin(), flipped.end(), [&](const auto& u) { return positive(mesh, u); }))
        continue;
      if (CGAL::side_of_bounded_sphere(point(mesh, f[0]), point(mesh, f[1]), point(mesh, f[2]),
                                       point(mesh, a), point(mesh, b)) != CGAL::ON_UNBOUNDED_SIDE)
        continue;
      const auto region = mesh.tetrahedron_references[t];
      mesh.tetrahedra[s] = flipped[0];
      mesh.tetrahedra[t] = flipped[1];
      mesh.tetrahedra.push_back(flipped[2]);
      mesh.tetrahedron_references.push_back(region);
      return;
    }
  throw std::runtime_error("no two tetrahedra can be flipped");
}

template <class T>
void erase(std::vector<T>& items, std::size_t i) {
  items.erase(items.begin() + std::ptrdiff_t(i));
}

inline void append_vertex(Mesh& mesh, const Mesh::Point& p) {
  mesh.points.push_back(p);
  mesh.point_references.push_back(0);
  if (!mesh.point_dimensions.empty()) mesh.point_dimensions.push_back(3);
}

}  // namespace corruption_detail

inline std::vector<Corruption> corruptions() {
  namespace cd = corruption_detail;
  return {
      {"an index out of range", "indices", false,
       [](cd::Mesh& m) { m.tetrahedra.back()[2] = std::uint32_t(m.points.size()); }},
      {"a coordinate that is not a number", "indices", false,
       [](cd::Mesh& m) { m.points.back()[1] = std::numeric_limits<double>::quiet_NaN(); }},
      {"a vertex duplicated", "vertices", false,
       [](cd::Mesh& m) {
         cd::append_vertex(m, m.points[m.tetrahedra[0][0]]);
         m.tetrahedra[0][0] = std::uint32_t(m.points.size() - 1);
       }},
      {"a vertex without tetrahedra", "vertices", false,
       [](cd::Mesh& m) {
         cd::append_vertex(m, m.points[0]);
         m.points.back()[0] += 1;
       }},
      {"a tetrahedron duplicated", "duplicates", false,
       [](cd::Mesh& m) {
         m.tetrahedra.push_back(m.tetrahedra[m.tetrahedra.size() / 2]);
         m.tetrahedron_references.push_back(m.tetrahedron_references[m.tetrahedra.size() / 2]);
       }},
      {"a triangle duplicated", "duplicates", false,
       [](cd::Mesh& m) {
         m.triangles.push_back(m.triangles[0]);
         m.triangle_references.push_back(m.triangle_references[0]);
       }},
      {"a vertex moved", "orientation", false, cd::move_vertex},
      {"a tetrahedron inverted", "orientation", false,
       [](cd::Mesh& m) {
         std::swap(m.tetrahedra[m.tetrahedra.size() / 2][0], m.tetrahedra[m.tetrahedra.size() / 2][1]);
       }},
      {"a tetrahedron inverted, as seen from its neighbours", "faces", false,
       [](cd::Mesh& m) {
         auto& t = m.tetrahedra[cd::inner_face(m)[0]];
         std::swap(t[2], t[3]);
       }},
      {"a tetrahedron removed", "boundary", false,
       [](cd::Mesh& m) {
         const auto t = cd::inner_face(m)[0];
         cd::erase(m.tetrahedra, t);
         cd::erase(m.tetrahedron_references, t);
       }},
      {"a boundary triangle removed from its section", "boundary", false,
       [](cd::Mesh& m) {
         m.triangles.pop_back();
         m.triangle_references.pop_back();
       }},
      {"a region swapped", "boundary", false,
       [](cd::Mesh& m) { m.tetrahedron_references[cd::inner_face(m)[0]] += 1; }},
      {"an edge that is none", "edges", false,
       [](cd::Mesh& m) {
         // From a vertex to one that shares no tetrahedron with it.
         std::set<std::uint32_t> near{m.tetrahedra[0][0]};
         for (const auto& t : m.tetrahedra)
           if (std::find(t.begin(), t.end(), m.tetrahedra[0][0]) != t.end()) near.insert(t.begin(), t.end());
         std::uint32_t v = 0;
         while (v < m.points.size() && near.count(v) != 0) ++v;
         if (v == m.points.size()) throw std::runtime_error("all vertices are neighbours");
         m.edges.push_back({m.tetrahedra[0][0], v});
         m.edge_references.push_back(0);
       }},
      {"a tetrahedron added on top of others", "overlap", false,
       [](cd::Mesh& m) {
         m.tetrahedra.push_back(m.tetrahedra[m.tetrahedra.size() / 2]);
         m.tetrahedron_references.push_back(m.tetrahedron_references[m.tetrahedra.size() / 2]);
       }},
      {"a flip that is not Delaunay", "delaunay", false, cd::flip_2_3},
      {"an input vertex replaced", "input vertices", true,
       [](cd::Mesh& m) {
         double& x = m.points[cd::corner(m)][0];
         x = std::nextafter(x, std::numeric_limits<double>::infinity());
       }},
      {"a vertex marker changed", "input vertices", true,
       [](cd::Mesh& m) { m.point_references[cd::corner(m)] += 1; }},
      {"a triangle marker swapped", "facets", true, [](cd::Mesh& m) { m.triangle_references[0] += 1; }},
      {"a triangle that is in no facet", "facets", true,
       [](cd::Mesh& m) {
         const auto [t, i] = cd::inner_face(m);
         m.triangles.push_back(cd::face(m, t, i));
         m.triangle_references.push_back(m.triangle_references[0]);
       }},
      {"a triangle missing in a facet", "facets", true,
       [](cd::Mesh& m) {
         cd::erase(m.triangles, 0);
         cd::erase(m.triangle_references, 0);
       }},
      {"an edge removed", "segments", true,
       [](cd::Mesh& m) {
         m.edges.pop_back();
         m.edge_references.pop_back();
       }},
      {"an edge marker changed", "segments", true, [](cd::Mesh& m) { m.edge_references[0] += 1; }},
      {"a region swapped, as seen from the input", "regions", true,
       [](cd::Mesh& m) { m.tetrahedron_references[cd::inner_face(m)[0]] += 1; }},
      {"all region ids changed", "regions", true,
       [](cd::Mesh& m) {
         for (auto& r : m.tetrahedron_references) r += 1;
       }},
      {"a tetrahedron removed, as seen from the input", "volume", true,
       [](cd::Mesh& m) {
         const auto t = cd::inner_face(m)[0];
         cd::erase(m.tetrahedra, t);
         cd::erase(m.tetrahedron_references, t);
       }},
  };
}

}  // namespace pgdr_test

#endif
