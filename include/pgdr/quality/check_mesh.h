// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_QUALITY_CHECK_MESH_H
#define PGDR_QUALITY_CHECK_MESH_H

#include <cstddef>
#include <string>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// What `check_mesh` found out about one property of a mesh.
struct Check_line {
  std::string property;  ///< a fixed short name, see `check_mesh`
  bool passed = false;
  std::string detail;  ///< counts, worst values and, on failure, the first offender
};

struct Check_options {
  /// Bound of circumradius over shortest edge; exceeding it by up to 1e-9 of its value is forgiven.
  double radius_edge_ratio = 2;
  /// No dihedral angle is to be smaller, in degrees, but for what small angles of the input excuse; 0: any may.
  double min_dihedral_deg = 0;
  /// Larger meshes are refused: the faces of tetrahedra are numbered with 32 bits.
  std::size_t most_tetrahedra = (std::size_t{1} << 30) - 1;
};

/// Verifies a finished mesh from its arrays alone, sharing nothing with the code that makes meshes. One line
/// each:
///
/// - `indices`: all indices are in range, all coordinates finite, all reference arrays of the right length.
///   When this fails nothing else can be checked and it is the only line.
/// - `vertices`: distinct, each one a vertex of some tetrahedron.
/// - `duplicates`: no tetrahedron, triangle or edge twice, none with a repeated vertex.
/// - `orientation`: every tetrahedron is positively oriented (exact).
/// - `faces`: each is shared by at most two tetrahedra, which lie on its two sides.
/// - `boundary`: the outer boundary is closed; it and all interfaces between regions are listed as
///   triangles; every triangle is a face of a tetrahedron.
/// - `edges`: every listed edge is an edge of a tetrahedron.
/// - `overlap`: the tetrahedra at each vertex fill no more than a full ball, and all together as much volume
///   as the boundary encloses.
/// - `delaunay`: every open circumball is empty of vertices (exact).
///
/// With a domain, moreover, for everything that touches material:
///
/// - `input vertices`: each that touches material is kept with exactly its coordinates and its marker; the
///   reference of all other vertices is 0.
/// - `facets`: each is covered exactly once by triangles with its marker, and there are no other triangles.
/// - `distance`: no triangle is farther from its facet than the domain's tolerance.
/// - `segments`: each is a chain of edges with its marker (0 unless it was named), and there are no other
///   edges.
/// - `regions`: the tetrahedra of each subdomain bear its region id, and region by region the volumes agree.
/// - `volume`: the total volume is that of the complex.
///
/// And last:
///
/// - `ratio`: no tetrahedron is over the bound, except near small angles of the domain: within four
///   circumradii (from its nearest vertex or its centroid) of a vertex or segment where features meet at
///   less than 60 degrees, or of the ball around such a vertex that is kept clear (a quarter of the shortest
///   segment there), or where its shortest edge joins two features that meet there, as close to each
///   other as the angle makes them: a needle is a small angle from end to end.
/// - `dihedral angle`, if one is asked for: none is smaller, with the same exceptions.
///
/// Never throws for a bad mesh. `domain`: null, or the input that the mesh was made from.
std::vector<Check_line> check_mesh(const Indexed_mesh_3& mesh,
                                   const Domain_3<Default_kernel>* domain = nullptr,
                                   const Check_options& options = {});

/// Whether every line passed.
bool all_passed(const std::vector<Check_line>& lines);

}  // namespace pgdr

#endif
