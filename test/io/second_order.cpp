// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/second_order.h>

#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>

#include <pgdr/io/write_mesh.h>
#include <pgdr/parallel/thread_arena.h>

#include "../catch.h"
#include "read_back.h"
#include "sample_mesh.h"
#include "temporary_folder.h"

namespace {

/// With triangles and edges of tetrahedra, as meshes have them.
pgdr::Indexed_mesh_3 linear_mesh() {
  pgdr::Indexed_mesh_3 mesh = pgdr_test::sample_mesh(6);
  mesh.triangles.clear();
  mesh.edges.clear();
  for (std::size_t i = 0; i < mesh.triangle_references.size(); ++i) {
    const auto& [a, b, c, d] = mesh.tetrahedra[7 * i];
    mesh.triangles.push_back({b, d, c});
    mesh.edges.push_back({a, d});
  }
  return mesh;
}

}  // namespace

TEST_CASE("each edge has one node, in its middle, and the nodes do not depend on the number of threads") {
  const pgdr::Indexed_mesh_3 linear = linear_mesh();
  std::set<std::set<std::uint32_t>> edges;
  for (const auto& t : linear.tetrahedra)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b) edges.insert({t[a], t[b]});
  pgdr::Indexed_mesh_3 mesh = linear;
  pgdr::with_threads(1, [&] { pgdr::add_midside_nodes(mesh); });
  CHECK(mesh.points.size() == linear.points.size() + edges.size());
  CHECK(mesh.point_references.size() == mesh.points.size());
  CHECK(mesh.point_dimensions.size() == mesh.points.size());
  constexpr std::size_t ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  const auto is_middle = [&](std::uint32_t node, std::uint32_t a, std::uint32_t b) {
    for (std::size_t k = 0; k < 3; ++k)
      if (mesh.points[node][k] != mesh.points[a][k] / 2 + mesh.points[b][k] / 2) return false;
    return node >= linear.points.size();
  };
  bool all = mesh.tetrahedron_nodes.size() == mesh.tetrahedra.size() && mesh.triangle_nodes.size() == mesh.triangles.size() && mesh.edge_nodes.size() == mesh.edges.size();
  REQUIRE(all);
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i)
    for (std::size_t k = 0; k < 6; ++k) all &= is_middle(mesh.tetrahedron_nodes[i][k], mesh.tetrahedra[i][ends[k][0]], mesh.tetrahedra[i][ends[k][1]]);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      all &= is_middle(mesh.triangle_nodes[i][k], mesh.triangles[i][ends[k][0]], mesh.triangles[i][ends[k][1]]);
      CHECK(mesh.point_dimensions[mesh.triangle_nodes[i][k]] <= 2);
    }
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    all &= is_middle(mesh.edge_nodes[i], mesh.edges[i][0], mesh.edges[i][1]);
    CHECK(mesh.point_dimensions[mesh.edge_nodes[i]] == 1);
  }
  CHECK(all);
  pgdr::Indexed_mesh_3 again = linear;
  pgdr::with_threads(4, [&] { pgdr::add_midside_nodes(again); });
  pgdr::add_midside_nodes(again);  // which does nothing
  CHECK(again.points == mesh.points);
  CHECK(again.tetrahedron_nodes == mesh.tetrahedron_nodes);
}

TEST_CASE("meshes of second order read back with their nodes in the middle of edges") {
  const pgdr_test::Temporary_folder folder;
  pgdr::Indexed_mesh_3 mesh = linear_mesh();
  pgdr::add_midside_nodes(mesh);
  pgdr::Write_options options;
  options.vtu.triangles = true;
  for (const char* name : {"a.vtu", "a.vtk", "a.inp", "b.msh", "c.msh", "d.msh"}) {
    INFO(name);
    options.gmsh = name[0] == 'b' ? pgdr::Gmsh_format::binary_4_1 : name[0] == 'c' ? pgdr::Gmsh_format::ascii_4_1 : pgdr::Gmsh_format::ascii_2_2;
    pgdr::write_mesh(mesh, folder / name, options);
    const int code = pgdr_test::read_back(folder / name, mesh.points.size(), mesh.tetrahedra.size(),
                                          " --order 2" + (name == std::string("a.inp") ? "" : " --triangles " + std::to_string(mesh.triangles.size())));
    if (code == 77) PGDR_SKIP("python3-meshio is not installed");
    CHECK(code == 0);
  }
  for (const char* name : {"a.su2", "a.mesh"}) CHECK_THROWS_AS(pgdr::write_mesh(mesh, folder / name), std::invalid_argument);
}
