// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_LEAF_REFINER_H
#define PGDR_REFINEMENT_LEAF_REFINER_H

#include <algorithm>
#include <atomic>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <pgdr/domain/region_3.h>
#include <pgdr/mesh/territory_3.h>

namespace pgdr {

/// What one task on one leaf may do.
struct Leaf_task {
  Region_3 region;  ///< where it may insert points: the leaf
  Region_3 near;    ///< the leaf grown by a quarter of ell*, where the vertices of every cavity are
  Region_3 reach;   ///< the leaf grown by half of ell*, which it must not leave by reading or writing
  double target = 0;  ///< poor elements with a smaller circumradius are left for a smaller leaf
  /// Elements outside the domain are refined down to this, for the sake of the leaves beside them.
  double outside_target = std::numeric_limits<double>::infinity();
  bool last = false;  ///< the leaf will not be split any more
  std::size_t quota = std::numeric_limits<std::size_t>::max();  ///< it inserts about this many points at most
  std::size_t pause_after = std::numeric_limits<std::size_t>::max();  ///< it ends after so many, as soon as no facet is torn
  bool features_only = false;  ///< elements in the volume have to wait: a facet near by is torn
  std::uint16_t tag = 0;       ///< checked runs: names the task among the running ones; 0: no checks
  Territory_id territory;      ///< that it has to keep to
  const std::atomic<bool>* cancel = nullptr;
};

/// What one `drain` did.
struct Drain_result {
  std::size_t inserted = 0;  ///< points, on features and in the volume
  std::size_t refused = 0;   ///< poor elements that were given up
  std::size_t limited = 0;   ///< those of them that were at the minimum edge length
  bool stopped = false;      ///< by quota or cancellation, before the worklist was empty
};

/// What the deferred elements of a worklist ask for, roughly.
struct Work_estimate {
  double insertions = 0;  ///< points
  double largest_size = 0;  ///< value of the sizing field among them
};

/// What the hull of the triangulation consists of.
struct Volumes {
  double inside = 0;   ///< the domain
  double outside = 0;
};

/// Roughly how many vertices a volume has when all circumradii in it are at most `size`. (Two real models with a uniform size: 0.91
/// and 0.97 of this.) By volume, since the large balls of flat elements on a surface overlap a hundred times over.
inline double expected_vertices(double volume, double size) { return std::min(std::abs(volume) / (size * size * size), 1e12); }

/// What a scan of the elements around a box found.
struct Scan_result {
  bool finer = false;   ///< all of them have m below the bound
  double coarsest = 0;  ///< largest circumradius among those that nobody intends to refine; valid if `finer`
};

/// A sequential engine that a scheduler can run leaf by leaf, several leaves at once where they are far apart.
///
/// - `Worklist`: what one leaf still has to do. *Active* elements are above the leaf's target, *deferred* ones below.
///   `coarsest()` bounds the radius m of every element near the leaf that it does not intend to refine; it never shrinks.
/// - `Worker`: the scratch memory of one thread.
/// - `Parcel`: work on its way to the leaf that contains `at`.
///
/// `drain` works on active elements until none is left whose Steiner point lies in the task's region, and appends to
/// `outgoing()` what belongs to other leaves. What it does is a function of the mesh within `reach` and of the
/// worklist only: no clock, no addresses, no thread. `receive` puts a parcel into a worklist, `activate` applies a new
/// target, `dispatch` empties a worklist, parcel by parcel, into a sink. `settle` does, alone, what no leaf could do:
/// it takes it from all worklists that are torn.
/// `estimate_outside` tells how many points the elements outside the domain ask for at a smaller target.
/// `divide` hands the active elements of a worklist that is everything out to *territories* (`Territory_3`), parts that `drain`
/// may work on at once, each with its territory and the territory's region in the task; `unite` takes back what is left of them.
/// `scan` looks at all elements that meet a box, to tell whether those that are not inside a hole in it have m below a
/// bound; it only reads.
template <class R>
concept LeafRefiner = requires(R refiner, typename R::Worker& worker, typename R::Worklist& list,
                               const typename R::Worklist& const_list, typename R::Parcel parcel,
                               std::vector<typename R::Worklist>& parts, const Leaf_task& task, const Region_3& box,
                               double number) {
  { const_list.has_work() } -> std::convertible_to<bool>;
  { const_list.active() } -> std::convertible_to<std::size_t>;
  { const_list.deferred() } -> std::convertible_to<std::size_t>;
  { const_list.is_torn() } -> std::convertible_to<bool>;
  { const_list.coarsest() } -> std::convertible_to<double>;
  { list.measure_deferred() };
  { const_list.measured_deferred() } -> std::convertible_to<double>;
  { parcel.at } -> std::convertible_to<Vec_3>;
  { list.outgoing().size() } -> std::convertible_to<std::size_t>;
  { refiner.drain(worker, task, list) } -> std::same_as<Drain_result>;
  { refiner.receive(list, std::move(parcel), number, number) };
  { refiner.activate(list, number, number) };
  { refiner.estimate(const_list) } -> std::same_as<Work_estimate>;
  { refiner.estimate_outside(const_list, number) } -> std::convertible_to<double>;
  { refiner.volumes() } -> std::same_as<Volumes>;
  { refiner.divide(worker, list, task, std::size_t{}, unsigned{}).parts[0] } -> std::convertible_to<typename R::Worklist&>;
  { refiner.divide(worker, list, task, std::size_t{}, unsigned{}).territories[0] } -> std::convertible_to<Territory_id>;
  { refiner.unite(list, parts, number, number) };
  { refiner.scan(box, box, number, const_list) } -> std::same_as<Scan_result>;
  { list.reset_coarsest(number) };
};

}  // namespace pgdr

#endif
