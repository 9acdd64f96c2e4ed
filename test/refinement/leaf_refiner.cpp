// SPDX-License-Identifier: GPL-3.0-or-later
// The concept LeafRefiner: a toy model in one dimension and the real one, both drained region by region.
#include <pgdr/refinement/leaf_refiner.h>

#include <cmath>
#include <deque>
#include <set>
#include <vector>

#include "catch.h"
#include "conforming/consistency.h"
#include "domain/shapes.h"
#include "refinement/refined.h"

using namespace pgdr_test;
using pgdr::Leaf_region;

namespace {

/// Halves intervals of a line until each is no longer than a bound at its midpoint.
class Interval_refiner {
 public:
  struct Interval {
    double lower, upper;
    double middle() const { return 0.5 * (lower + upper); }
  };
  struct Worklist {
    std::deque<Interval> poor;
    std::vector<Interval> forwarded;
    bool empty() const { return poor.empty(); }
    std::size_t size() const { return poor.size(); }
  };

  explicit Interval_refiner(double (*bound)(double)) : bound_(bound) {}

  void classify(const Interval& i, Worklist& worklist) const {
    if (i.upper - i.lower > bound_(i.middle())) worklist.poor.push_back(i);
  }

  pgdr::Drain_result drain(const Leaf_region& region, Worklist& worklist) {
    pgdr::Drain_result result;
    while (!worklist.empty()) {
      const Interval i = worklist.poor.front();
      worklist.poor.pop_front();
      if (!region.contains({i.middle(), 0, 0})) {
        worklist.forwarded.push_back(i);
        ++result.forwarded;
        continue;
      }
      points.insert(i.middle());
      ++result.inserted;
      classify({i.lower, i.middle()}, worklist);
      classify({i.middle(), i.upper}, worklist);
    }
    return result;
  }

  std::set<double> points;

 private:
  double (*bound_)(double);
};

/// A scheduler in its simplest form: one leaf after the other, round and round; what a leaf forwards is the work of
/// the next one.
template <pgdr::LeafRefiner R>
pgdr::Drain_result drain_in_turn(R& refiner, const std::vector<Leaf_region>& leaves,
                                 typename R::Worklist& worklist) {
  pgdr::Drain_result total;
  for (std::size_t k = 0; !worklist.empty(); ++k) {
    const auto result = refiner.drain(leaves[k % leaves.size()], worklist);
    REQUIRE(worklist.empty());
    REQUIRE(worklist.forwarded.size() == result.forwarded);
    total.inserted += result.inserted;
    total.refused += result.refused;
    total.forwarded += result.forwarded;
    worklist.poor.assign(worklist.forwarded.begin(), worklist.forwarded.end());
    worklist.forwarded.clear();
  }
  return total;
}

/// All of space in n slabs, with walls at multiples of 1/n.
std::vector<Leaf_region> slabs(int n) {
  std::vector<Leaf_region> leaves(static_cast<std::size_t>(n));
  for (std::size_t k = 0; k + 1 < leaves.size(); ++k)
    leaves[k].upper.x = leaves[k + 1].lower.x = static_cast<double>(k + 1) / n;
  return leaves;
}

using Tr = Mesh::Triangulation;
using Criteria = pgdr::Quality_criteria_3<pgdr::Default_kernel, pgdr::Uniform_sizing_field>;
using Refiner = pgdr::Delaunay_leaf_refiner_3<Tr, Criteria>;

static_assert(pgdr::LeafRefiner<Interval_refiner>);
static_assert(pgdr::LeafRefiner<Refiner>);
struct Not_a_refiner {
  struct Worklist {};
};
static_assert(!pgdr::LeafRefiner<Not_a_refiner>);

}  // namespace

TEST_CASE("A leaf region is half open", "[refinement]") {
  Leaf_region region;
  CHECK(region.contains({1e300, -1e300, 0}));
  region.lower = {0, 0, 0};
  region.upper = {1, 2, 3};
  CHECK(region.contains({0, 0, 0}));
  CHECK(region.contains({0.5, 1.5, 2.5}));
  for (const pgdr::Vec_3& p :
       {pgdr::Vec_3{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {-0.1, 0, 0}, {0, -0.1, 0}, {0, 0, -0.1}})
    CHECK(!region.contains(p));
  // Every point is in exactly one of the leaves.
  const auto leaves = slabs(7);
  Random random(41);
  for (int k = 0; k < 1000; ++k) {
    const double x = k < 8 ? k / 7.0 : random.between(-1, 2);
    int in = 0;
    for (const auto& leaf : leaves) in += leaf.contains({x, 0, 0});
    CHECK(in == 1);
  }
}

TEST_CASE("A toy refiner gives the same points leaf by leaf as at once", "[refinement]") {
  for (double (*bound)(double) :
       {+[](double) { return 0.01; }, +[](double x) { return 0.001 + 0.1 * std::abs(x - 0.3); }}) {
    Interval_refiner once(bound);
    Interval_refiner::Worklist worklist;
    once.classify({0, 1}, worklist);
    const auto whole = once.drain(Leaf_region{}, worklist);
    CHECK(whole.inserted == once.points.size());
    CHECK(whole.forwarded == 0);
    REQUIRE(once.points.size() > 30);
    for (const int n : {1, 2, 3, 5, 16}) {
      CAPTURE(n);
      Interval_refiner leafwise(bound);
      leafwise.classify({0, 1}, worklist);
      const auto result = drain_in_turn(leafwise, slabs(n), worklist);
      CHECK(leafwise.points == once.points);
      CHECK(result.inserted == once.points.size());
      CHECK((result.forwarded > 0) == (n > 1));
    }
  }
}

TEST_CASE("The Delaunay refiner reaches the same quality leaf by leaf", "[refinement]") {
  for (const auto& plc : {box(), tilted(box())})
    for (const int n : {1, 2, 5}) {
      CAPTURE(n);
      // Nothing is poor in the unrefined mesh by ratio, so it is recovered, labelled and all.
      Mesh mesh = refined(plc);
      const pgdr::Acute_neighborhood_3 acute(mesh.domain());
      pgdr::Feature_refiner_3<Tr> features(mesh.triangulation(), mesh.complex(), acute, 1e-9);
      features.keep_fresh_cells(true);
      const double size = 0.15;
      const Criteria criteria(2, pgdr::Uniform_sizing_field(size), mesh.subdomains());
      Refiner refiner(mesh.triangulation(), features, criteria, [] { return false; });
      Refiner::Worklist worklist;
      Tr& tr = mesh.triangulation();
      const std::size_t before = tr.number_of_vertices();
      for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) refiner.classify(c, worklist);
      REQUIRE(!worklist.empty());
      const auto result = drain_in_turn(refiner, slabs(n), worklist);
      CHECK(tr.number_of_vertices() == before + result.inserted);
      CHECK(result.refused == 0);
      CHECK((result.forwarded > 0) == (n > 1));
      CHECK(tr.is_valid());
      CHECK(inconsistency(tr, mesh.complex()) == "");
      const auto indexed = pgdr::indexed_mesh_3(mesh);
      CHECK(failures(pgdr::check_mesh(indexed, &mesh.domain())) == "");
      CHECK(pgdr::mesh_quality(indexed).max_circumradius <= size * (1 + 1e-9));
    }
}

TEST_CASE("The Delaunay refiner leaves what is outside of its leaf alone", "[refinement]") {
  Mesh mesh = refined(box());
  const pgdr::Acute_neighborhood_3 acute(mesh.domain());
  pgdr::Feature_refiner_3<Tr> features(mesh.triangulation(), mesh.complex(), acute, 1e-9);
  features.keep_fresh_cells(true);
  const Criteria criteria(2, pgdr::Uniform_sizing_field(0.05), mesh.subdomains());
  Refiner refiner(mesh.triangulation(), features, criteria, [] { return false; });
  Refiner::Worklist worklist;
  Tr& tr = mesh.triangulation();
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) refiner.classify(c, worklist);
  Leaf_region half;
  half.upper.x = 0.6;
  const auto result = refiner.drain(half, worklist);
  CHECK(worklist.empty());
  CHECK(result.forwarded == worklist.forwarded.size());
  CHECK(result.inserted > 20);
  REQUIRE(result.forwarded > 0);
  // Everything that is still poor was forwarded, and its circumcenter is not in the leaf.
  std::size_t poor = 0;
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) {
    const auto& p = c->vertex(0)->point();
    const auto center =
        CGAL::circumcenter(p, c->vertex(1)->point(), c->vertex(2)->point(), c->vertex(3)->point());
    if (CGAL::squared_distance(center, p) <= 0.05 * 0.05 * (1 + 1e-9)) continue;
    ++poor;
    CHECK(center.x() >= 0.6 - 1e-9);
  }
  CHECK(poor > 0);
}

TEST_CASE("The Delaunay refiner stops when it is asked to", "[refinement]") {
  Mesh mesh = refined(box());
  const pgdr::Acute_neighborhood_3 acute(mesh.domain());
  pgdr::Feature_refiner_3<Tr> features(mesh.triangulation(), mesh.complex(), acute, 1e-9);
  features.keep_fresh_cells(true);
  const Criteria criteria(2, pgdr::Uniform_sizing_field(0.1), mesh.subdomains());
  Tr& tr = mesh.triangulation();
  Refiner refiner(tr, features, criteria, [&tr] { return tr.number_of_vertices() >= 50; });
  Refiner::Worklist worklist;
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) refiner.classify(c, worklist);
  const auto result = refiner.drain(Leaf_region{}, worklist);
  CHECK(result.stopped);
  CHECK(tr.number_of_vertices() >= 50);
  CHECK(tr.number_of_vertices() < 70);  // some to leave every facet whole
  CHECK(result.inserted + 8 == tr.number_of_vertices());
  CHECK(inconsistency(tr, mesh.complex()) == "");
  CHECK(!worklist.empty());
}
