// SPDX-License-Identifier: GPL-3.0-or-later
// The splitting lemma (docs/theory.md): once every tetrahedron whose center lies in leaf K has r < l*(K)/16, a split
// that leaves the octree balanced, and new leaves without smaller ones beside them, keeps every zone condition.
#include <algorithm>
#include <cstdint>
#include <vector>

#include <pgdr/independence/zone_condition.h>
#include <pgdr/octree/linear_octree_3.h>

#include "catch.h"
#include "octree/random_octree.h"
#include "seeded_random.h"

using pgdr::Linear_octree_3;
using pgdr::Requirement;
using pgdr_test::Seeded_random;
using pgdr_test::unit_cube;

namespace {

struct Split {
  std::vector<std::uint32_t> parent;
  Linear_octree_3 finer;
};

Split split(const Linear_octree_3& octree, const std::vector<std::uint8_t>& which) {
  std::vector<std::uint32_t> parent;
  Linear_octree_3 finer = octree.split(which, &parent);
  return {std::move(parent), std::move(finer)};
}

bool allowed(const Linear_octree_3& octree, const Split& s) {
  for (std::uint32_t n = 0; n < s.finer.size(); ++n) {
    const bool is_new = s.finer[n].level > octree[s.parent[n]].level;
    if (is_new && s.finer.shortest_touching_edge(n) < s.finer.edge(n)) return false;
  }
  return s.finer.is_balanced();
}

/// Distance of a leaf of one octree from a leaf of another, maximum norm.
double distance(const Linear_octree_3& a, std::uint32_t i, const Linear_octree_3& b, std::uint32_t j) {
  double result = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result = std::max({result, b.lower(j)[axis] - a.upper(i)[axis], a.lower(i)[axis] - b.upper(j)[axis]});
  }
  return result;
}

/// Counts the pairs of a new leaf N and an old leaf K where a tetrahedron with its center in K and r < factor * l*(K)
/// may be in N's shell and break its bound.
std::size_t breaches(const Linear_octree_3& octree, const Linear_octree_3& finer, double factor) {
  std::size_t count = 0;
  std::vector<Requirement> requirement;
  std::vector<double> radius(octree.size());
  for (std::uint32_t k = 0; k < octree.size(); ++k) radius[k] = factor * octree.shortest_touching_edge(k);
  for (std::uint32_t n = 0; n < finer.size(); ++n) {
    pgdr::Zone_condition().requirements(finer, n, requirement);
    const double shell = requirement[0].hole_lower[0] - requirement[0].lower[0];
    for (std::uint32_t k = 0; k < octree.size(); ++k) {
      count += distance(finer, n, octree, k) < shell + radius[k] && radius[k] > requirement[0].bound;
    }
  }
  return count;
}

}  // namespace

TEST_CASE("splitting lemma: refined to l*/16, a balanced split keeps the zone condition") {
  Seeded_random random(61);
  std::size_t split_leaves = 0, above = 0, unrestricted = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Linear_octree_3 octree = pgdr_test::balanced(pgdr_test::random_octree(random, unit_cube(), 4, 40));
    std::vector<std::uint8_t> which(octree.size(), 0);
    for (int attempt = 0; attempt < 25; ++attempt) {
      const std::uint32_t i = random.below(octree.size());
      if (which[i] != 0) continue;
      which[i] = 1;
      if (allowed(octree, split(octree, which))) {
        ++split_leaves;
      } else {
        unrestricted += breaches(octree, octree.split(which), 1.0 / 16);
        which[i] = 0;
      }
    }
    const Linear_octree_3 finer = octree.split(which);
    CHECK(breaches(octree, finer, 1.0 / 16) == 0);
    above += breaches(octree, finer, 1.0 / 15);
  }
  CHECK(split_leaves > 200);
  CHECK(above > 0);         // a larger target does not do
  CHECK(unrestricted > 0);  // nor does any split
}
