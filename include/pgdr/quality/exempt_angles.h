// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_QUALITY_EXEMPT_ANGLES_H
#define PGDR_QUALITY_EXEMPT_ANGLES_H

#include <cstddef>
#include <string>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// A small angle of the input, and how many tetrahedra it keeps above the bound on the radius-edge ratio.
struct Exempt_angle {
  double degrees;
  std::string between;  ///< what meets there, in the numbering of the input file: "facets 7 and 19"
  std::size_t tetrahedra;
};

/// Which small angles, below 60 degrees, the exempt tetrahedra of a mesh are next to: each counts for the nearest one. Those
/// with the most tetrahedra come first. \pre the mesh was made from the domain
std::vector<Exempt_angle> exempt_angles(const Indexed_mesh_3& mesh, const Domain_3<Default_kernel>& domain);

}  // namespace pgdr

#endif
