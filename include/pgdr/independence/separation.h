// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_INDEPENDENCE_SEPARATION_H
#define PGDR_INDEPENDENCE_SEPARATION_H

#include <array>
#include <concepts>
#include <cstdint>
#include <vector>

#include <pgdr/octree/linear_octree_3.h>

namespace pgdr {

/// What a condition asks of the tetrahedra in some part of space; lengths in the units of the mesh.
///
/// `circumball` false: every finite tetrahedron that meets the closed box `lower`..`upper` without the closed hole
/// has m < `bound`, where m is the radius of the smallest ball that encloses the tetrahedron. One that lies in the
/// hole altogether is free. All four corners are exact.
/// `circumball` true: every finite tetrahedron whose open circumball meets the closed box has circumradius < `bound`.
/// There is no hole: `hole_lower` equals `hole_upper` and counts for nothing.
///
/// Whoever evaluates it may ask for more than this, never for less: m and the circumradius are rounded up, and
/// "meets" may be widened, for instance to bounding boxes.
struct Requirement {
  std::array<double, 3> lower{}, upper{};
  std::array<double, 3> hole_lower{}, hole_upper{};
  double bound = 0;
  bool circumball = false;
};

/// A condition on the mesh around a leaf under which the tasks of leaves may run at the same time.
///
/// `requirements(octree, leaf, out)` replaces `out` by what must hold before the leaf's task may run beside others.
/// `conflicting(octree, leaf, out)` replaces `out` by the leaves, ascending, whose tasks must not run at the same
/// time as this leaf's although the requirements of both hold. It is symmetric. Models: `Zone_condition`,
/// `Buffer_condition`.
template <class C>
concept SeparationCondition = requires(const C& condition, const Linear_octree_3& octree, std::uint32_t leaf,
                                       std::vector<Requirement>& requirements,
                                       std::vector<std::uint32_t>& leaves) {
  { condition.requirements(octree, leaf, requirements) } -> std::same_as<void>;
  { condition.conflicting(octree, leaf, leaves) } -> std::same_as<void>;
};

}  // namespace pgdr

#endif
