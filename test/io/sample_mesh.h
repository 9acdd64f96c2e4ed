// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_IO_SAMPLE_MESH_H
#define PGDR_TEST_IO_SAMPLE_MESH_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr_test {

/// An n x n x n grid of slightly moved points, six positively oriented tetrahedra per cube.
inline pgdr::Indexed_mesh_3 sample_mesh(std::uint32_t n, unsigned seed = 1) {
  pgdr::Indexed_mesh_3 mesh;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-0.1, 0.1);
  const auto id = [n](std::uint32_t i, std::uint32_t j, std::uint32_t k) { return (i * n + j) * n + k; };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t k = 0; k < n; ++k) {
        mesh.points.push_back({(i + jitter(random)) / n, (j + jitter(random)) / n, (k + jitter(random)) / n});
        mesh.point_references.push_back(static_cast<std::int32_t>(i) - 2);
        mesh.point_dimensions.push_back(static_cast<std::uint8_t>((i + j + k) % 4));
      }
    }
  }
  // Each permutation of the axes is a path from corner (0,0,0) to (1,1,1) of a cube: one tetrahedron.
  const int paths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
      for (std::uint32_t k = 0; k + 1 < n; ++k) {
        for (int p = 0; p < 6; ++p) {
          std::array<std::uint32_t, 3> c{i, j, k};
          std::array<std::uint32_t, 4> t{id(i, j, k)};
          for (std::size_t s = 0; s < 3; ++s) {
            ++c[static_cast<std::size_t>(paths[p][s])];
            t[s + 1] = id(c[0], c[1], c[2]);
          }
          if (p >= 3) std::swap(t[2], t[3]);
          if (mesh.tetrahedra.size() % 7 == 3)
            mesh.exempt.push_back(static_cast<std::uint32_t>(mesh.tetrahedra.size()));
          mesh.tetrahedra.push_back(t);
          mesh.tetrahedron_references.push_back(static_cast<std::int32_t>(1 + i % 3));
        }
      }
    }
  }
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    mesh.edges.push_back({id(i, 0, 0), id(i + 1, 0, 0)});
    mesh.edge_references.push_back(-static_cast<std::int32_t>(i));
    mesh.triangles.push_back({id(i, 0, 0), id(i + 1, 0, 0), id(i, 1, 0)});
    mesh.triangle_references.push_back(2147483647 - static_cast<std::int32_t>(i));
  }
  return mesh;
}

}  // namespace pgdr_test

#endif
