// SPDX-License-Identifier: GPL-3.0-or-later
// Short names for what most tests of the front door do.
#ifndef PGDR_TEST_REFINEMENT_REFINED_H
#define PGDR_TEST_REFINEMENT_REFINED_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <pgdr/quality/check_mesh.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/refine_mesh_3.h>

#include "mesh/random.h"

namespace pgdr_test {

using Mesh = pgdr::Refined_mesh_3<pgdr::Default_kernel>;

/// For placements that the library does not compile: one more engine for all of these tests.
using Sizing_function = std::function<double(const pgdr::Default_kernel::Point_3&)>;

inline Sizing_function same_size(double size) {
  return [size](const pgdr::Default_kernel::Point_3&) { return size; };
}

/// A file of `data/` with a bound on circumradii.
struct Sized_shape {
  const char* file;
  double size;
};

/// `size` bounds the circumradii; by default nothing does.
inline Mesh refined(const pgdr::Plc& plc, double size = std::numeric_limits<double>::infinity(),
                    const pgdr::Parameters& parameters = {}) {
  return pgdr::refine_mesh_3(plc, pgdr::Uniform_sizing_field(size), parameters);
}

/// The lines of the checker that failed, one below the other.
inline std::string failures(const std::vector<pgdr::Check_line>& lines) {
  std::string s;
  for (const auto& line : lines)
    if (!line.passed) s += line.property + ": " + line.detail + "\n";
  return s;
}

/// How many tetrahedra have a circumradius above the sizing field at the circumcenter, exempt ones apart.
template <class Sizing>
std::size_t oversized(const pgdr::Indexed_mesh_3& mesh, const Sizing& sizing) {
  using Point = pgdr::Default_kernel::Point_3;
  const std::set<std::size_t> exempt(mesh.exempt.begin(), mesh.exempt.end());
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (exempt.contains(t)) continue;
    std::array<Point, 4> p;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& x = mesh.points[static_cast<std::size_t>(mesh.tetrahedra[t][i])];
      p[i] = Point(x[0], x[1], x[2]);
    }
    const Point c = CGAL::circumcenter(p[0], p[1], p[2], p[3]);
    const double size = sizing(c) * (1 + 1e-6);
    count += CGAL::squared_distance(c, p[0]) > size * size;
  }
  return count;
}

/// Of all edges of tetrahedra.
inline double shortest_edge(const pgdr::Indexed_mesh_3& mesh) {
  double squared = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.tetrahedra) {
    const auto corner = [&](std::size_t i) { return pgdr::to_vec(mesh.points[t[i]]); };
    squared = std::min(squared, pgdr::squared_shortest_edge({corner(0), corner(1), corner(2), corner(3)}));
  }
  return std::sqrt(squared);
}

/// Whether two meshes are the same, number by number.
inline bool equal(const pgdr::Indexed_mesh_3& a, const pgdr::Indexed_mesh_3& b) {
  return a.points == b.points && a.point_references == b.point_references &&
         a.point_dimensions == b.point_dimensions && a.edges == b.edges &&
         a.edge_references == b.edge_references && a.triangles == b.triangles &&
         a.triangle_references == b.triangle_references && a.tetrahedra == b.tetrahedra &&
         a.tetrahedron_references == b.tetrahedron_references && a.exempt == b.exempt;
}

/// What the checker minds about a mesh that a limit stopped. Where pieces of the input are not in the mesh yet,
/// neither are they among its triangles, and it cannot be held against the input.
inline std::string valid_when_stopped(const Mesh& mesh, const pgdr::Indexed_mesh_3& indexed) {
  pgdr::Check_options any_ratio;
  any_ratio.radius_edge_ratio = 1e9;
  const bool whole = mesh.statistics().unrecovered == 0;
  auto lines = pgdr::check_mesh(indexed, whole ? &mesh.domain() : nullptr, any_ratio);
  if (!whole) std::erase_if(lines, [](const auto& l) { return l.property == "boundary"; });
  return failures(lines);
}

inline std::set<std::int32_t> distinct(const std::vector<std::int32_t>& references) {
  return {references.begin(), references.end()};
}

}  // namespace pgdr_test

#endif
