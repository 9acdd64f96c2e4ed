// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARAMETERS_H
#define PGDR_PARAMETERS_H

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace pgdr {

/// What the refinement tells about itself while it runs; the same calls come in the same order in every run.
struct Progress {
  const char* phase = "";        ///< "conforming", "refinement", "removing slivers" or "optimization"
  std::size_t vertices = 0;      ///< of the triangulation, the box included
  std::size_t pending = 0;       ///< elements that wait to be looked at
};

/// A vertex that has just been put into the mesh, in the user's unit.
struct Inserted_vertex {
  double x = 0, y = 0, z = 0;
  int dimension = 3;  ///< 1: on a segment, 2: on a facet, 3: inside
};

/// Where the Steiner point of a poor tetrahedron goes; the policies are in refinement/point_placement.h.
enum class Point_placement {
  lazy,          ///< the circumcenter, unless a dihedral angle comes out below `Parameters::min_dihedral` (or less, `angle_of_choice`): then a few points near it
  circumcenter,  ///< as far from all vertices as can be
  type1,         ///< as near to the shortest edge as the type-I selection ball allows
  type2          ///< the same in the type-II selection ball
};

/// Everything that steers `refine_mesh_3`, with the reason for each default.
struct Parameters {
  /// Upper bound of circumradius over shortest edge. 2 is the smallest bound that the
  /// termination proof of Delaunay refinement covers (Shewchuk 1998); smaller ones are refused.
  double radius_edge_ratio = 2.0;

  /// Circumcenters give the fewest and most even tetrahedra for a given size, and a choice where it matters leaves hardly a sliver to
  /// remove.
  Point_placement placement = Point_placement::lazy;

  /// Where it is the size that a tetrahedron is split for, points are chosen so that no dihedral angle comes out below this one, in degrees
  /// (`Point_placement::lazy`); after the refinement, vertices are moved and a few added until none is, or as far as that gets. 0: neither.
  /// 12, by the tables of docs/robustness.md: 10 takes no less time, 14 takes a seventh more of it on the models; a cube of a given
  /// size takes a quarter to a third more than with 0.
  double min_dihedral = 12;
  static constexpr double largest_min_dihedral = 60;  ///< the regular tetrahedron has 70.5

  /// Rounds in which every vertex inside is moved, if the tetrahedra around it get better on average and no dihedral angle falls below
  /// `min_dihedral`, when everything else is done: for solvers that profit from the average, not only from the worst. A round takes up to one and a half times as long as the refinement (docs/robustness.md).
  std::size_t optimization_rounds = 0;

  /// Facets whose vertices lie this close to one plane, relative to the bounding box's diagonal, are fused.
  /// 1e-6 undoes single-precision files and is far below any feature that a simulation resolves.
  double coplanar_tolerance = 1e-6;

  /// Accept polygons that are not planar, as triangles. Off: such a polygon is more often an error than meant.
  bool triangulate_facets = false;

  /// Leave out the volume bounds of the regions in the input.
  bool ignore_region_sizes = false;

  /// No Steiner point comes closer than this to another vertex; 0: 1e-12 of the bounding box's diagonal, below which double
  /// precision no longer separates the points of a facet well. What cannot be recovered or refined without is left, and counted.
  double min_edge_length = 0;

  /// The refinement stops at this many vertices, plus the few it may take to leave every facet whole; 0: no limit.
  /// Where not even the recovery of the input fits, the mesh lacks pieces of it, and the statistics say so.
  std::size_t max_vertices = 0;
  /// Where there is no other limit it stops at this many: at seven or eight tetrahedra to a vertex, as many as 32 bits can number.
  static constexpr std::size_t most_vertices = std::size_t{1} << 29;
  std::size_t vertex_limit() const { return max_vertices > 0 ? max_vertices : most_vertices; }

  /// The refinement stops before the process needs more memory than this, in bytes, numbering included; 0: no limit. Where it does,
  /// the mesh depends on the machine.
  std::size_t max_memory = 0;

  /// The refinement stops after this many seconds; 0: no limit. Where it does, the mesh depends on the machine.
  double time_limit = 0;

  /// Threads that refine; 0: as many as the calling thread's TBB arena has. The mesh is the same for every number.
  unsigned threads = 0;

  /// 0: the octree grows with the mesh. D > 0: the fixed octree of depth D (8^(D-1) leaves) of the paper by Chernikov
  /// and Chrisochoides, refined by one thread until its buffer condition (18) and the zone condition hold. For
  /// comparison; 1 is plain sequential refinement.
  int octree_depth = 0;
  /// 262,144 leaves, of two kilobytes each. The mesh between two leaves must be finer than a quarter of them, so that with more of
  /// them a leaf would be the size of a few hundred tetrahedra of a mesh of a billion.
  static constexpr int largest_octree_depth = 7;

  /// Leaves of the octree get smaller, and more of them can be worked on at once, only if the space around the domain is
  /// refined with them. This many points out there may be spent on each point that waits inside. 1/2: less than what a
  /// second thread saves.
  double outside_points = 0.5;

  /// The order of tasks on touching leaves: 0, the usual one, with the shortest chains; any other number, the random
  /// order that belongs to it. Each order has its own mesh, the same for every number of threads. To test the promise
  /// that any order gives a valid mesh.
  std::uint64_t task_order = 0;

  /// Keep a record of every leaf task, for a timeline or a replay: about 64 bytes each.
  bool record_tasks = false;

  /// Check that every task stays within the zone of its leaf and that no two running tasks meet; throws
  /// `std::logic_error` otherwise. Costs about a tenth of the time.
#ifdef PGDR_CHECKED
  bool check_zones = true;
#else
  bool check_zones = false;
#endif

  /// Run CGAL's `is_valid()` on the refined triangulation, Delaunay property included.
  bool verify = false;

  /// Called now and then from the refining thread.
  std::function<void(const Progress&)> progress;

  /// Called for every vertex as it is put on a segment, on a facet or inside, by the thread that does so: by several at once, in an order
  /// that timing decides. It has to be safe for that, and quick. Vertices inside may move later, while slivers are removed.
  std::function<void(const Inserted_vertex&)> inserted;

  /// Set from any thread or a signal handler to stop at the next insertion; the mesh is valid then.
  const std::atomic<bool>* cancel = nullptr;
};

}  // namespace pgdr

#endif
