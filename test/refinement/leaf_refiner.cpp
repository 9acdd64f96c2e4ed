// SPDX-License-Identifier: GPL-3.0-or-later
// The concept LeafRefiner: a toy model in one dimension and the real one, both drained leaf by leaf.
#include <pgdr/refinement/leaf_refiner.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "catch.h"
#include "conforming/consistency.h"
#include "domain/shapes.h"
#include "refinement/refined.h"
#include "seeded_random.h"

using namespace pgdr_test;
using pgdr::Leaf_task;
using pgdr::Region_3;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Halves intervals of a line until each is no longer than a bound at its midpoint.
class Interval_refiner {
 public:
  struct Interval {
    double lower, upper;
    double middle() const { return 0.5 * (lower + upper); }
    double radius() const { return 0.5 * (upper - lower); }
  };
  struct Parcel {
    pgdr::Vec_3 at;
    Interval interval;
  };
  struct Worker {};
  class Worklist {
   public:
    bool has_work() const { return !active_.empty(); }
    std::size_t active() const { return active_.size(); }
    std::size_t deferred() const { return deferred_.size(); }
    bool is_torn() const { return false; }
    double coarsest() const { return coarsest_; }
    void reset_coarsest(double radius) { coarsest_ = radius; }
    void measure_deferred() {
      measured_ = 0;
      for (const Interval& i : deferred_) measured_ = std::max(measured_, i.radius());
    }
    double measured_deferred() const { return measured_; }
    std::vector<Parcel>& outgoing() { return outgoing_; }

   private:
    friend Interval_refiner;
    std::deque<Interval> active_;
    std::vector<Interval> deferred_;
    std::vector<Parcel> outgoing_;
    double coarsest_ = 0, measured_ = 0;
  };

  explicit Interval_refiner(double (*bound)(double)) : bound_(bound) {}

  void classify(const Interval& i, double target, Worklist& list) const {
    if (2 * i.radius() <= bound_(i.middle()))
      list.coarsest_ = std::max(list.coarsest_, i.radius());
    else if (i.radius() > target)
      list.active_.push_back(i);
    else
      list.deferred_.push_back(i);
  }

  pgdr::Drain_result drain(Worker&, const Leaf_task& task, Worklist& list) {
    pgdr::Drain_result result;
    while (list.has_work()) {
      if (result.inserted >= task.quota) {
        result.stopped = true;
        break;
      }
      const Interval i = list.active_.front();
      list.active_.pop_front();
      const pgdr::Vec_3 at{i.middle(), 0, 0};
      if (!task.region.contains(at)) {
        list.outgoing_.push_back({at, i});
        continue;
      }
      points.insert(i.middle());
      ++result.inserted;
      classify({i.lower, i.middle()}, task.target, list);
      classify({i.middle(), i.upper}, task.target, list);
    }
    return result;
  }

  void receive(Worklist& list, Parcel&& parcel, double target, double) const {
    classify(parcel.interval, target, list);
  }

  void activate(Worklist& list, double target, double) const {
    const auto waiting = std::move(list.deferred_);
    list.deferred_.clear();
    for (const Interval& i : waiting) classify(i, target, list);
  }

  pgdr::Work_estimate estimate(const Worklist& list) const {
    pgdr::Work_estimate e;
    for (const Interval& i : list.deferred_) {
      e.insertions += 2 * i.radius() / bound_(i.middle());
      e.largest_size = std::max(e.largest_size, bound_(i.middle()));
    }
    return e;
  }

  double estimate_outside(const Worklist&, double) const { return 0; }
  pgdr::Volumes volumes() const { return {1, 0}; }

  // Intervals are always fine enough for leaves.
  struct Division {
    std::vector<Worklist> parts;
    std::vector<pgdr::Territory_id> territories;
  };
  Division divide(Worker&, Worklist&, const Leaf_task&, std::size_t, unsigned) const { return {}; }
  void unite(Worklist&, std::vector<Worklist>&, double, double) const {}

  pgdr::Scan_result scan(const Region_3&, const Region_3&, double bound, const Worklist& list) const {
    return {list.coarsest() < bound, list.coarsest()};
  }

  std::set<double> points;

 private:
  double (*bound_)(double);
};

/// What came of draining leaf by leaf.
struct In_turn {
  std::size_t inserted = 0, refused = 0, forwarded = 0, settled = 0;
};

/// A scheduler in its simplest form: one leaf after the other, round and round. What a leaf forwards goes to the one
/// that holds it. The work is in the first list to begin with.
template <pgdr::LeafRefiner R>
In_turn drain_in_turn(R& refiner, typename R::Worker& worker, const std::vector<Region_3>& leaves,
                      std::vector<typename R::Worklist>& lists) {
  In_turn total;
  const auto deliver = [&](typename R::Parcel&& parcel) {
    std::size_t holders = 0, to = 0;
    for (std::size_t k = 0; k < leaves.size(); ++k)
      if (leaves[k].contains(parcel.at)) {
        to = k;
        ++holders;
      }
    REQUIRE(holders == 1);
    refiner.receive(lists[to], std::move(parcel), 0, infinity);
  };
  const auto is_torn = [](const auto& list) { return list.is_torn(); };
  const auto has_work = [](const auto& list) { return list.has_work(); };
  int rounds = 0;
  for (; std::any_of(lists.begin(), lists.end(), has_work) && rounds < 10000; ++rounds) {
    for (std::size_t k = 0; k < leaves.size(); ++k) {
      if (!lists[k].has_work()) continue;
      Leaf_task task;
      task.region = leaves[k];
      for (std::size_t n = 0; n < leaves.size(); ++n) task.features_only |= n != k && lists[n].is_torn();
      const auto result = refiner.drain(worker, task, lists[k]);
      REQUIRE(!result.stopped);
      total.inserted += result.inserted;
      total.refused += result.refused;
      total.forwarded += lists[k].outgoing().size();
      auto parcels = std::move(lists[k].outgoing());
      lists[k].outgoing().clear();
      for (auto& parcel : parcels) deliver(std::move(parcel));
    }
    if constexpr (requires(typename R::Worklist& rest) { refiner.dispatch(worker, rest, deliver); }) {
      std::vector<typename R::Worklist*> torn;
      for (auto& list : lists)
        if (is_torn(list)) torn.push_back(&list);
      if (torn.empty()) continue;
      typename R::Worklist rest;
      total.settled += refiner.settle(worker, torn, false, infinity, rest).inserted;
      refiner.dispatch(worker, rest, deliver);
    }
  }
  CHECK(rounds < 10000);
  CHECK(std::none_of(lists.begin(), lists.end(), is_torn));
  return total;
}

/// All of space in n slabs, with walls at multiples of 1/n.
std::vector<Region_3> slabs(int n) {
  std::vector<Region_3> leaves(static_cast<std::size_t>(n));
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
  struct Worker {};
  struct Parcel {};
};
static_assert(!pgdr::LeafRefiner<Not_a_refiner>);

/// The engine over a mesh that was recovered and labelled, where nothing is poor but by the size that is new.
struct Engine {
  Engine(const Plc& plc, double size)
      : mesh(refined(plc)), tr(mesh.triangulation()), acute(mesh.domain()),
        criteria(2, pgdr::Uniform_sizing_field(size), mesh.subdomains()),
        refiner(tr, mesh.complex(), acute, criteria, 1e-9), worker(refiner.make_worker()) {}

  /// A worklist with all that is poor, every element active.
  Refiner::Worklist everything() {
    Refiner::Worklist list = refiner.everything(*worker);
    CHECK(list.active() == 0);
    REQUIRE(list.deferred() > 0);
    refiner.activate(list, 0, infinity);
    CHECK(list.deferred() == 0);
    return list;
  }

  bool is_valid() {
    tr.restore_infinite_cell(refiner.corner());
    return tr.is_valid();
  }

  Mesh mesh;
  Tr& tr;
  pgdr::Acute_neighborhood_3 acute;
  Criteria criteria;
  Refiner refiner;
  std::unique_ptr<Refiner::Worker> worker;
};

}  // namespace

TEST_CASE("A leaf region is half open", "[refinement]") {
  Region_3 region;
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
  Seeded_random random(41);
  for (int k = 0; k < 1000; ++k) {
    const double x = k < 8 ? k / 7.0 : random.between(-1, 2);
    int in = 0;
    for (const auto& leaf : leaves) in += leaf.contains({x, 0, 0});
    CHECK(in == 1);
  }
}

TEST_CASE("A toy refiner gives the same points leaf by leaf as at once", "[refinement]") {
  Interval_refiner::Worker worker;
  for (double (*bound)(double) :
       {+[](double) { return 0.01; }, +[](double x) { return 0.001 + 0.1 * std::abs(x - 0.3); }}) {
    Interval_refiner once(bound);
    std::vector<Interval_refiner::Worklist> lists(1);
    once.classify({0, 1}, 0, lists[0]);
    const auto whole = drain_in_turn(once, worker, {Region_3{}}, lists);
    CHECK(whole.inserted == once.points.size());
    CHECK(whole.forwarded == 0);
    REQUIRE(once.points.size() > 30);
    for (const int n : {1, 2, 3, 5, 16}) {
      CAPTURE(n);
      Interval_refiner leafwise(bound);
      lists.assign(static_cast<std::size_t>(n), {});
      leafwise.classify({0, 1}, 0, lists[0]);
      const auto result = drain_in_turn(leafwise, worker, slabs(n), lists);
      CHECK(leafwise.points == once.points);
      CHECK(result.inserted == once.points.size());
      CHECK((result.forwarded > 0) == (n > 1));
    }
  }
}

TEST_CASE("The Delaunay refiner reaches the same quality leaf by leaf", "[refinement]") {
  for (const auto& plc : {box(), tilted(box()), tilted(cylinder(12))})
    for (const int n : {1, 2, 5}) {
      CAPTURE(n);
      const double size = 0.15;
      Engine engine(plc, size);
      const std::size_t before = engine.tr.number_of_vertices();
      std::vector<Refiner::Worklist> lists(static_cast<std::size_t>(n));
      lists[0] = engine.everything();
      const auto result = drain_in_turn(engine.refiner, *engine.worker, slabs(n), lists);
      CHECK(engine.tr.number_of_vertices() == before + result.inserted + result.settled);
      CHECK(result.refused == 0);
      CHECK((result.forwarded > 0) == (n > 1));
      for (const auto& list : lists) CHECK(list.empty());
      CHECK(engine.is_valid());
      CHECK(inconsistency(engine.tr, engine.mesh.complex()) == "");
      const auto indexed = pgdr::indexed_mesh_3(engine.mesh);
      CHECK(failures(pgdr::check_mesh(indexed, &engine.mesh.domain())) == "");
      CHECK(pgdr::mesh_quality(indexed).max_circumradius <= size * (1 + 1e-9));
    }
}

TEST_CASE("The Delaunay refiner leaves what is outside of its leaf alone", "[refinement]") {
  const double size = 0.05, wall = 0.6;
  Engine engine(box(), size);
  std::set<Tr::Vertex_handle> before;
  for (auto v = engine.tr.finite_vertices_begin(); v != engine.tr.finite_vertices_end(); ++v) before.insert(v);
  auto list = engine.everything();
  Leaf_task half;
  half.region.upper.x = wall;
  const auto result = engine.refiner.drain(*engine.worker, half, list);
  CHECK(!list.has_work());
  CHECK(!result.stopped);
  CHECK(result.inserted > 20);
  CHECK(engine.tr.number_of_vertices() == before.size() + result.inserted);
  for (auto v = engine.tr.finite_vertices_begin(); v != engine.tr.finite_vertices_end(); ++v)
    if (!before.count(v)) CHECK(v->point().x() < wall);
  // What it left to others is theirs: its Steiner point, or the split point of the feature in its way.
  std::set<Tr::Cell_handle> sent;
  for (const auto& parcel : list.outgoing()) {
    CHECK(!half.region.contains(parcel.at));
    if (parcel.kind == Refiner::Parcel::Kind::poor && parcel.cell.is_live()) sent.insert(parcel.cell.cell);
    if (parcel.errand && parcel.errand->cell.cell != Tr::Cell_handle()) sent.insert(parcel.errand->cell.cell);
  }
  REQUIRE(!sent.empty());
  // Everything that is still poor was sent.
  std::size_t poor = 0;
  for (auto c = engine.tr.finite_cells_begin(); c != engine.tr.finite_cells_end(); ++c) {
    const auto& p = c->vertex(0)->point();
    const auto center =
        CGAL::circumcenter(p, c->vertex(1)->point(), c->vertex(2)->point(), c->vertex(3)->point());
    if (CGAL::squared_distance(center, p) <= size * size * (1 + 1e-9)) continue;
    ++poor;
    CHECK(sent.count(c) == 1);
  }
  CHECK(poor > 0);
}

TEST_CASE("Elements below the target wait for a smaller leaf", "[refinement]") {
  const double size = 0.1, target = 0.25;
  Engine engine(box(), size);
  auto list = engine.refiner.everything(*engine.worker);
  engine.refiner.activate(list, target, infinity);
  REQUIRE(list.active() > 0);
  Leaf_task task;
  task.target = target;
  engine.refiner.drain(*engine.worker, task, list);
  CHECK(!list.has_work());
  REQUIRE(list.deferred() > 0);
  list.measure_deferred();
  CHECK(list.measured_deferred() <= target);
  CHECK(list.measured_deferred() > size);
  CHECK(list.coarsest() <= size * (1 + 1e-5));
  const auto coarse = pgdr::mesh_quality(pgdr::indexed_mesh_3(engine.mesh)).max_circumradius;
  CHECK(coarse <= target * (1 + 1e-9));
  CHECK(coarse > size);
  // The rest of the way, from what was kept.
  engine.refiner.activate(list, 0, infinity);
  engine.refiner.drain(*engine.worker, Leaf_task{}, list);
  CHECK(list.empty());
  CHECK(pgdr::mesh_quality(pgdr::indexed_mesh_3(engine.mesh)).max_circumradius <= size * (1 + 1e-9));
  CHECK(engine.is_valid());
}

TEST_CASE("The Delaunay refiner stops when it is asked to", "[refinement]") {
  Engine engine(box(), 0.1);
  auto list = engine.everything();
  const std::size_t before = engine.tr.number_of_vertices();
  const std::atomic<bool> cancel{true};
  Leaf_task task;
  task.cancel = &cancel;
  auto result = engine.refiner.drain(*engine.worker, task, list);
  CHECK(result.stopped);
  CHECK(result.inserted == 0);
  CHECK(engine.tr.number_of_vertices() == before);
  task.cancel = nullptr;
  task.quota = 42;
  result = engine.refiner.drain(*engine.worker, task, list);
  CHECK(result.stopped);
  CHECK(result.inserted == 42);
  CHECK(engine.tr.number_of_vertices() == before + 42);
  CHECK(list.has_work());
  // It may have stopped with a facet torn; closing makes it whole, with few points.
  std::vector<Refiner::Worklist*> lists{&list};
  Refiner::Worklist rest;
  CHECK(engine.refiner.settle(*engine.worker, lists, true, infinity, rest).inserted < 20);
  CHECK(!rest.is_torn());
  CHECK(engine.is_valid());
  CHECK(inconsistency(engine.tr, engine.mesh.complex()) == "");
}
