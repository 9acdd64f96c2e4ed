// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/input_facets.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <CGAL/Simple_cartesian.h>

#include <pgdr/domain/detail/aabb_trees.h>
#include <pgdr/domain/facet_triangles.h>
#include <pgdr/parallel/parallel_for.h>

namespace pgdr {

void find_input_facets(Indexed_mesh_3& mesh, const Plc& input) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Point = Kernel::Point_3;
  std::vector<Kernel::Triangle_3> triangles;
  std::vector<std::uint32_t> facet_of;
  const double unit = std::ldexp(1.0, input.exponent - mesh.exponent);
  for (const auto& [corners, facet] : facet_triangles(input)) {
    const auto point = [&](Index v) { return Point(unit * input.vertices[v].x(), unit * input.vertices[v].y(), unit * input.vertices[v].z()); };
    const Kernel::Triangle_3 t(point(corners[0]), point(corners[1]), point(corners[2]));
    if (!(t.squared_area() > 0)) continue;  // what lies on it lies on a neighbor
    triangles.push_back(t);
    facet_of.push_back(facet + static_cast<std::uint32_t>(input.first_index));
  }
  mesh.triangle_input_facets.clear();
  if (triangles.empty()) return;
  domain_detail::Aabb_triangle_tree<Kernel> tree(triangles.cbegin(), triangles.cend());
  tree.build();
  tree.accelerate_distance_queries();
  mesh.triangle_input_facets.resize(mesh.triangles.size());
  parallel_for_chunks(mesh.triangles.size(), default_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      std::array<double, 3> c{};
      for (const std::uint32_t v : mesh.triangles[i])
        for (std::size_t k = 0; k < 3; ++k) c[k] += mesh.points[v][k] / 3;
      const auto nearest = tree.closest_point_and_primitive(Point(c[0], c[1], c[2])).second;
      mesh.triangle_input_facets[i] = facet_of[static_cast<std::size_t>(nearest - triangles.cbegin())];
    }
  });
}

}  // namespace pgdr
