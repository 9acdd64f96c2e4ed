// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_SCALE_MESH_H
#define PGDR_MESH_SCALE_MESH_H

#include <algorithm>
#include <cmath>

#include <pgdr/domain/scale.h>
#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// The same mesh with coordinates in units of 2^exponent.
inline Indexed_mesh_3 scaled_to(Indexed_mesh_3 mesh, int exponent) {
  if (mesh.exponent == exponent) return mesh;
  for (auto& p : mesh.points)
    for (double& x : p) x = std::ldexp(x, mesh.exponent - exponent);
  mesh.exponent = exponent;
  return mesh;
}

/// What has to be added to the exponent of a mesh whose coordinates are so large or small that products of them would not be doubles; 0 for others.
inline int exponent_for(const Indexed_mesh_3& mesh) {
  double largest = 0;
  for (const auto& p : mesh.points)
    for (const double x : p)
      if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
  return exponent_for(largest);
}

}  // namespace pgdr

#endif
