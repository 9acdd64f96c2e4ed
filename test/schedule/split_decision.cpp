// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/schedule/split_decision.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "catch.h"
#include "octree/random_octree.h"
#include "schedule/list_engine.h"

using namespace pgdr_test;
using pgdr::Linear_octree_3;
using pgdr::Region_3;
using Decision = pgdr::Split_decision<List_engine>;

namespace {

/// An octree of the unit cube with its leaves' worklists, before a decision.
struct Situation {
  explicit Situation(Linear_octree_3 tree) : octree(std::move(tree)), leaves(octree.size()) {
    pgdr::connect_leaves(octree, leaves);
  }

  std::uint32_t at(double x, double y, double z) const { return octree.find(std::array<double, 3>{x, y, z}); }

  /// Gives a leaf so much to do below its target, for elements of half that radius.
  void add_work(std::uint32_t i, double insertions) {
    auto& list = leaves[i].work;
    list.estimate.insertions = insertions;
    list.deferred_radius = pgdr::zone_target(leaves[i].shortest);
    list.estimate.largest_size = 0.5 * list.deferred_radius;
  }
  void add_work_everywhere() {
    for (std::uint32_t i = 0; i < octree.size(); ++i) add_work(i, 1e6);
  }

  std::size_t final_leaves() const {
    return static_cast<std::size_t>(
        std::count_if(leaves.begin(), leaves.end(), [](const auto& leaf) { return leaf.final; }));
  }

  /// Decides; true if the octree changes. Then the answers are consistent, and what is new is balanced.
  bool decide() {
    Decision decision(engine, octree, leaves, 0.5);
    const bool change = decision.decide();
    split = decision.split();
    if (change) {
      std::vector<std::uint32_t> parents;
      CHECK(decision.next().leaves() == octree.split(split, &parents).leaves());
      CHECK(decision.parents() == parents);
      CHECK(decision.next().is_balanced());
      CHECK(decision.next().size() > octree.size());
    } else {
      CHECK(std::count(split.begin(), split.end(), 1) == 0);
      CHECK(decision.next().size() == octree.size());
    }
    return change;
  }

  /// A tetrahedron of this size at p will not be refined: the zone condition fails where it is seen.
  void put_coarse(std::array<double, 3> p, double radius) {
    leaves[octree.find(p)].work.coarsest_radius = radius;
    engine.finer = [p, radius](const Region_3& box, const Region_3& hole, double bound) {
      const pgdr::Vec_3 v{p[0], p[1], p[2]};
      return radius < bound || !box.contains_closed(v) || hole.contains_closed(v);
    };
  }

  List_engine engine;
  Linear_octree_3 octree;
  std::vector<pgdr::Scheduled_leaf<List_engine>> leaves;
  std::vector<std::uint8_t> split;
};

Linear_octree_3 uniform(int level) { return Linear_octree_3::uniform(unit_cube(), level); }

}  // namespace

TEST_CASE("The first leaf is split when it has enough to do", "[schedule]") {
  Situation little(uniform(0)), much(uniform(0));
  little.add_work(0, Decision::least_work_of_all - 1);
  CHECK(!little.decide());
  CHECK(little.leaves[0].final);
  much.add_work(0, Decision::least_work_of_all);
  CHECK(much.decide());
  CHECK(!much.leaves[0].final);
}

TEST_CASE("A leaf without enough to do becomes final, the others are split", "[schedule]") {
  Situation s(uniform(2));
  s.add_work_everywhere();
  const std::uint32_t poor = s.at(0.9, 0.9, 0.9), idle = s.at(0.1, 0.1, 0.1);
  s.add_work(poor, Decision::least_work - 1);
  s.add_work(idle, 0);
  REQUIRE(s.decide());
  CHECK(s.leaves[poor].final);
  CHECK(s.split[poor] == 0);
  // Nothing to do is no reason to end: it may have to be split for a neighbour's sake.
  CHECK(!s.leaves[idle].final);
  CHECK(s.split[idle] == 0);
  CHECK(s.final_leaves() == 1);
  CHECK(std::count(s.split.begin(), s.split.end(), 1) == 62);
}

TEST_CASE("A leaf whose children would be smaller than the sizes ask for becomes final", "[schedule]") {
  Situation s(uniform(1));
  s.add_work_everywhere();
  s.leaves[3].work.estimate.largest_size = pgdr::zone_target(s.leaves[3].shortest);
  REQUIRE(s.decide());
  CHECK(s.leaves[3].final);
  CHECK(s.final_leaves() == 1);
}

TEST_CASE("Larger leaves are split with what touches them", "[schedule]") {
  // One child of the root has children of its own, and one of these wants to be split: at the center of the root, so
  // that all seven siblings of its parent touch it.
  Linear_octree_3 octree = uniform(1);
  std::vector<std::uint8_t> first(8, 0);
  first[0] = 1;
  Situation s(octree.split(first));
  const std::uint32_t inner = s.at(0.49, 0.49, 0.49);
  REQUIRE(s.octree[inner].level == 2);
  s.add_work(inner, 1e6);
  REQUIRE(s.decide());
  for (std::uint32_t i = 0; i < s.octree.size(); ++i) {
    CAPTURE(i);
    CHECK((s.split[i] != 0) == (i == inner || s.octree[i].level == 1));
  }
  CHECK(s.final_leaves() == 0);

  // In the corner of the root it can be split alone.
  Situation corner(octree.split(first));
  corner.add_work(corner.at(0.01, 0.01, 0.01), 1e6);
  REQUIRE(corner.decide());
  CHECK(std::count(corner.split.begin(), corner.split.end(), 1) == 1);
}

TEST_CASE("A coarse element for good keeps leaves from being split near it, and nowhere else", "[schedule]") {
  Situation s(uniform(3));
  s.add_work_everywhere();
  // Allowed beside leaves of edge 1/8, too large in the shell of one of 1/16.
  const std::array<double, 3> p{0.515, 0.515, 0.515};
  s.put_coarse(p, 0.01);
  REQUIRE(s.decide());
  // Seven leaves at the center see it in their shells; they cannot be split, nor beside a leaf that is. The eighth
  // has it inside, and so might be split but for the others.
  const auto is_central = [&](std::uint32_t i) {
    return pgdr::leaf_region(s.octree, i).contains_closed({0.5, 0.5, 0.5});
  };
  const std::uint32_t home = s.octree.find(p);
  for (std::uint32_t i = 0; i < s.octree.size(); ++i) {
    bool keeps = is_central(i);
    for (const std::uint32_t n : s.leaves[i].touching) keeps = keeps || (is_central(n) && n != home);
    CAPTURE(i);
    CHECK((s.split[i] == 0) == keeps);
    CHECK(s.leaves[i].final == keeps);
  }
  CHECK(std::count(s.split.begin(), s.split.end(), 0) == 63);
  // The condition holds afterwards at every leaf that changed or has a smaller neighbour now.
  const Linear_octree_3 next = s.octree.split(s.split);
  for (std::uint32_t j = 0; j < next.size(); ++j) {
    std::vector<pgdr::Requirement> r;
    pgdr::Zone_condition().requirements(next, j, r);
    const auto vec = [](const std::array<double, 3>& a) { return pgdr::Vec_3{a[0], a[1], a[2]}; };
    CHECK(s.engine.finer({vec(r[0].lower), vec(r[0].upper)}, {vec(r[0].hole_lower), vec(r[0].hole_upper)},
                         r[0].bound));
  }
}

TEST_CASE("A veto of a larger leaf is one of the smaller leaves beside it", "[schedule]") {
  Linear_octree_3 octree = uniform(1);
  std::vector<std::uint8_t> first(8, 0);
  first[0] = 1;
  Situation s(octree.split(first));
  const std::uint32_t inner = s.at(0.49, 0.49, 0.49);
  s.add_work(inner, 1e6);
  // In the middle of one of the larger leaves, where it is of no concern to `inner` itself.
  s.put_coarse({0.77, 0.77, 0.77}, 0.06);
  CHECK(!s.decide());
  // For ever: it has to finish at the size it has.
  CHECK(s.leaves[inner].final);
  CHECK(s.final_leaves() == 1);
}

TEST_CASE("Who waits is asked to make room first", "[schedule]") {
  Situation s(uniform(2));
  const std::uint32_t eager = s.at(0.3, 0.3, 0.3), waiting = s.at(0.6, 0.3, 0.3);
  s.add_work(eager, 1e6);
  // Its neighbour will not be split, and holds elements that are too large beside leaves of half the size.
  s.add_work(waiting, 1e6);
  s.leaves[waiting].final = true;
  s.leaves[waiting].work.deferred_radius = 0.9 / 4 / 8;
  CHECK(!s.decide());
  CHECK(!s.leaves[eager].final);
  const double bound = pgdr::zone_target(s.leaves[eager].edge);
  CHECK(s.leaves[waiting].cap <= bound);
  // Once they are refined, nothing is in the way.
  s.leaves[waiting].work.deferred_radius = 0.5 * bound;
  CHECK(s.decide());
  CHECK(s.split[eager] == 1);
  CHECK(s.split[waiting] == 0);
}

TEST_CASE("A split has to be worth what it costs outside the domain", "[schedule]") {
  for (const double cost : {0.4e6, 0.6e6}) {
    CAPTURE(cost);
    Situation s(uniform(1));
    s.add_work(0, 1e6);
    s.leaves[7].work.outside = cost;
    CHECK(s.decide() == (cost < 0.5e6));
    CHECK(s.leaves[0].final == (cost > 0.5e6));
  }
  // What is outside far from everything that is split counts for nothing.
  Situation s(uniform(2));
  s.add_work(s.at(0.1, 0.1, 0.1), 1e6);
  s.leaves[s.at(0.9, 0.9, 0.9)].work.outside = 1e9;
  CHECK(s.decide());
}

TEST_CASE("The first leaf is split where leaves that are small beside the domain are worth what they cost outside", "[schedule]") {
  for (const auto& [inside, edge] : {std::pair{0.9, 0.25}, {0.1, 0.125}, {0.01, 0.0625}})
    for (const double cost : {0.4e6, 0.6e6}) {
      CAPTURE(inside, cost);
      Situation s(uniform(0));
      s.add_work(0, 1e6);
      s.engine.all = {inside, cost * std::pow(pgdr::zone_target(edge), 3)};
      CHECK(s.decide() == (cost < 0.5e6));
      CHECK(s.leaves[0].final == (cost > 0.5e6));
    }
}

TEST_CASE("A domain so thin that rounding leaves nothing of it is not split, and a decision comes to an end", "[schedule]") {
  for (const double inside : {0.0, -1e-12}) {
    Situation s(uniform(0));
    s.add_work(0, 1e6);
    s.engine.all = {inside, 1};
    CHECK(!s.decide());
    CHECK(s.leaves[0].final);
  }
}
