// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_QUALITY_MESH_QUALITY_H
#define PGDR_QUALITY_MESH_QUALITY_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

#include <pgdr/mesh/indexed_mesh_3.h>

namespace pgdr {

/// How good the tetrahedra of a mesh are, and how many of everything there are. All zero for an empty mesh.
struct Mesh_quality {
  std::size_t vertices = 0;
  std::size_t edges = 0;      ///< subsegments
  std::size_t triangles = 0;  ///< subfacets
  std::size_t tetrahedra = 0;

  double max_radius_edge_ratio = 0;
  double mean_radius_edge_ratio = 0;
  double max_circumradius = 0;
  double shortest_edge = 0;  ///< of all tetrahedra
  double min_dihedral_deg = 0;
  double max_dihedral_deg = 0;

  /// Of one of the `Shape_measures`, over all tetrahedra.
  struct Measure {
    double worst = 0;
    double mean = 0;
  };
  Measure edge_ratio, aspect_ratio;  ///< worst: the largest
  Measure mean_ratio, scaled_jacobian;  ///< worst: the smallest

  double volume = 0;                              ///< sum of the signed volumes
  std::map<std::int32_t, double> region_volumes;  ///< by region id
  std::map<std::int32_t, std::size_t> region_tetrahedra;

  /// How many tetrahedra have a dihedral angle below each of `small_angles_deg`.
  std::array<std::uint64_t, 5> tetrahedra_below{};
  static constexpr std::array<double, 5> small_angles_deg{1, 5, 10, 14, 20};

  /// All six dihedral angles of every tetrahedron: bin i counts [5 i, 5 (i + 1)) degrees, the last one 180 too.
  std::array<std::uint64_t, 36> dihedral_histogram{};
  static constexpr double dihedral_bin_deg = 5;
  /// Radius-edge ratios: bin i counts [0.25 i, 0.25 (i + 1)), the last one everything above too.
  std::array<std::uint64_t, 16> ratio_histogram{};
  static constexpr double ratio_bin = 0.25;
};

/// Measures every tetrahedron of `mesh`, whose indices must be in range, on all threads of the caller's arena. Sums
/// run over chunks of fixed size and then over these, both in the order of the mesh: the result is the same for every
/// number of threads.
Mesh_quality mesh_quality(const Indexed_mesh_3& mesh);

/// 64 bits that stand for the points, edges, triangles and tetrahedra of `mesh` and their references, bit by
/// bit and in order: equal for equal arrays on every machine with IEEE doubles and for every number of threads, and
/// different (but for a chance of about 2^-64) as soon as one bit differs or two items change places. `exempt`, `unrefined` and
/// `point_dimensions` are left out: they follow from the rest, and a mesh that was read back from a `.mesh` file lacks
/// them.
///
/// The function: with m the finalizer of the SplitMix64 generator (Steele, Lea and Flood 2014), which is a bijection,
/// a sequence of 64-bit words is hashed by h = m(h xor w) for each word w, beginning with a constant. The words are,
/// array by array, the number of numbers in it and the hash of each 2^14 of them. That of such a block is the hash of
/// four hashes; the i-th of these takes the words i, i + 4, ... of the block, each one double or two 32-bit numbers,
/// the first one low.
std::uint64_t mesh_checksum(const Indexed_mesh_3& mesh);

}  // namespace pgdr

#endif
