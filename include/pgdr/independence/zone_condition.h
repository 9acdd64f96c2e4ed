// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_INDEPENDENCE_ZONE_CONDITION_H
#define PGDR_INDEPENDENCE_ZONE_CONDITION_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pgdr/independence/separation.h>
#include <pgdr/octree/linear_octree_3.h>

namespace pgdr {

/// The zone condition: what makes concurrent writes to one triangulation safe, not only the mesh right.
///
/// **Zone theorem.** Let L be a leaf, l* the shortest edge among L and the leaves that touch it, d = l*/4, and N_t the
/// points of the meshed box within t of L in the maximum norm. If every finite tetrahedron that meets N_{3d/2} \ L has
/// an enclosing ball of radius below d/2, then, whatever points of the box are inserted later, anywhere and in any
/// order, for every p in L all vertices of the cavity of p are within d of L, and all tetrahedra with a vertex of the
/// cavity within 2d = l*/2.
/// *Why:* a later circumball B that holds a point of L and a vertex d away from L holds a point q of the shell deep
/// inside, with power at most -d^2/4. B is empty of today's vertices, so the enclosing ball of today's tetrahedron at
/// q has power at most that of B at q, and its squared radius is at least d^2/4.
///
/// **Gap lemma.** Leaves that do not touch are separated along some axis by at least the larger of their l*. *Why:* the
/// leaf beside one of them towards the other, where they are closest, fits between the two or has bounds on its grid.
///
/// Together: tasks conflict exactly if their leaves touch. Both in full, with the hull and infinite cells, in
/// docs/theory.md; the circumradius form of the idea is A. Chernikov, N. Chrisochoides, ICS 2008, section 4.
class Zone_condition {
 public:
  /// d in units of l*: how far from its leaf a cavity reaches at most; stars reach twice as far.
  static constexpr double cavity_reach = 1.0 / 4;

  void requirements(const Linear_octree_3& octree, std::uint32_t leaf, std::vector<Requirement>& out) const {
    const double d = cavity_reach * octree.shortest_touching_edge(leaf);
    const double shell = 3 * d / 2;  // 3/8 l*: exact, and so are the bounds (`Octree_box`)
    Requirement r;
    r.hole_lower = octree.lower(leaf);
    r.hole_upper = octree.upper(leaf);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      r.lower[axis] = r.hole_lower[axis] - shell;
      r.upper[axis] = r.hole_upper[axis] + shell;
    }
    r.bound = d / 2;
    out.assign(1, r);
  }

  void conflicting(const Linear_octree_3& octree, std::uint32_t leaf, std::vector<std::uint32_t>& out) const {
    octree.touching(leaf, out);
  }
};

static_assert(SeparationCondition<Zone_condition>);

}  // namespace pgdr

#endif
