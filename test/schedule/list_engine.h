// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_SCHEDULE_LIST_ENGINE_H
#define PGDR_TEST_SCHEDULE_LIST_ENGINE_H

#include <cstddef>
#include <functional>
#include <vector>

#include <pgdr/refinement/leaf_refiner.h>

namespace pgdr_test {

/// As much of a refiner as decisions need: worklists that say what a test wants them to say.
struct List_engine {
  struct Parcel {
    pgdr::Vec_3 at;
  };
  struct Worker {};
  struct Worklist {
    bool has_work() const { return false; }
    std::size_t active() const { return 0; }
    std::size_t deferred() const { return estimate.insertions > 0; }
    bool is_torn() const { return false; }
    double coarsest() const { return coarsest_radius; }
    void reset_coarsest(double radius) { coarsest_radius = radius; }
    void measure_deferred() {}
    double measured_deferred() const { return deferred_radius; }
    std::vector<Parcel>& outgoing() { return parcels; }

    pgdr::Work_estimate estimate;
    double outside = 0;  ///< insertions that a split would ask for
    double coarsest_radius = 0, deferred_radius = 0;
    std::vector<Parcel> parcels;
  };

  pgdr::Drain_result drain(Worker&, const pgdr::Leaf_task&, Worklist&) { return {}; }
  void receive(Worklist&, Parcel&&, double, double) const {}
  void activate(Worklist&, double, double) const {}
  struct Division {
    std::vector<Worklist> parts;
    std::vector<pgdr::Territory_id> territories;
  };
  Division divide(Worker&, Worklist&, const pgdr::Leaf_task&, std::size_t, unsigned) { return {}; }
  void unite(Worklist&, std::vector<Worklist>&, double, double) const {}
  pgdr::Work_estimate estimate(const Worklist& list) const { return list.estimate; }
  double estimate_outside(const Worklist& list, double) const { return list.outside; }
  pgdr::Volumes volumes() const { return all; }
  pgdr::Scan_result scan(const pgdr::Region_3& box, const pgdr::Region_3& hole, double bound,
                         const Worklist& list) const {
    return {finer(box, hole, bound), list.coarsest_radius};
  }

  pgdr::Volumes all{1, 0};

  /// Whether all elements that meet a box, but not those inside a hole in it, are smaller than a bound.
  std::function<bool(const pgdr::Region_3&, const pgdr::Region_3&, double)> finer =
      [](const pgdr::Region_3&, const pgdr::Region_3&, double) { return true; };
};

static_assert(pgdr::LeafRefiner<List_engine>);

}  // namespace pgdr_test

#endif
