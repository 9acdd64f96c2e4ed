// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_INDEPENDENCE_BUFFER_CONDITION_H
#define PGDR_INDEPENDENCE_BUFFER_CONDITION_H

#include <cstdint>
#include <vector>

#include <pgdr/independence/separation.h>
#include <pgdr/octree/linear_octree_3.h>

namespace pgdr {

/// The buffer condition of the paper: A. Chernikov, N. Chrisochoides, *Three-dimensional Delaunay refinement for
/// multi-core processors*, ICS 2008, definition 4, inequality (18).
///
/// **Condition (18).** Every tetrahedron whose open circumball meets a leaf L' in BUF(L) has a circumradius below
/// l(L')/6, l(L') the edge of L'.
/// **Theorem 3.** Then points of L and of any other leaf outside BUF(L) are strongly Delaunay-independent: they, or the
/// circumcenters and midpoints that are inserted for them, may be inserted concurrently into the mesh as it is now.
/// *Why (a sketch in the paper):* the straight way from one leaf to the other crosses buffer leaves on a piece of
/// length w on which all circumradii are below w/6; theorem 2 needs w/2, the rest pays for the displacements.
///
/// It says nothing about two threads that write to one triangulation, and it can be lost while neighbours refine
/// (docs/theory.md). A schedule that runs by it asks for `Zone_condition` as well.
class Buffer_condition {
 public:
  void requirements(const Linear_octree_3& octree, std::uint32_t leaf, std::vector<Requirement>& out) const {
    std::vector<std::uint32_t> buffer;
    octree.buffer(leaf, buffer);
    out.clear();
    out.reserve(buffer.size());
    for (const std::uint32_t i : buffer) {
      Requirement r;
      r.lower = octree.lower(i);
      r.upper = octree.upper(i);
      r.hole_lower = r.hole_upper = r.lower;
      // A sixth of a power of two rounds down (0.00101010...): the bound is never above the true one.
      r.bound = octree.edge(i) / 6;
      r.circumball = true;
      out.push_back(r);
    }
  }

  /// BUF(L), which is symmetric as the union over all orders of the axes.
  void conflicting(const Linear_octree_3& octree, std::uint32_t leaf, std::vector<std::uint32_t>& out) const {
    octree.buffer(leaf, out);
  }
};

static_assert(SeparationCondition<Buffer_condition>);

}  // namespace pgdr

#endif
