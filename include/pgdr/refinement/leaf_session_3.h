// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_LEAF_SESSION_3_H
#define PGDR_REFINEMENT_LEAF_SESSION_3_H

#include <exception>
#include <utility>
#include <vector>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/conforming/feature_refiner_3.h>
#include <pgdr/conforming/sheet_shift_3.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/mesh/zone_guard_3.h>
#include <pgdr/refinement/leaf_refiner.h>
#include <pgdr/refinement/leaf_worklist_3.h>
#include <pgdr/refinement/measured_star_3.h>
#include <pgdr/refinement/obstacles_3.h>

namespace pgdr {

/// The scratch memory of one thread.
template <class Tr>
struct Leaf_worker_3 {
  Leaf_worker_3(Tr& tr, Constraint_complex_3<Tr>& complex, const Acute_neighborhood_3& acute, double min_edge_length)
      : features(tr, complex, acute, min_edge_length) {
    features.keep_fresh_cells(true);
  }

  Feature_refiner_3<Tr> features;
  Zone_guard_3<Tr> guard;
  Obstacles_3<Tr> obstacles;
  Sheet_shift_3<Tr> sheets;
  Measured_star_3<Tr> star;  ///< of the point whose cavity is found, where several are compared
};

/// One leaf's turn on one thread: lends the queues of the leaf to the thread's `Feature_refiner_3`, and takes them back in the end.
template <class Tr>
class Leaf_session_3 {
 public:
  using Worker = Leaf_worker_3<Tr>;
  using Worklist = Leaf_worklist_3<Tr>;
  using Cell_id = typename Worklist::Cell_id;
  using Kind = typename Worklist::Parcel::Kind;
  using Features = Feature_refiner_3<Tr>;

  Leaf_session_3(Tr& tr, Worker& worker, const Leaf_task& task, Worklist& list) : worker_(worker), task_(task), list_(list) {
    Features& f = worker.features;
    f.set_region(task.region, task.near);
    f.set_territory({task.territory});
    f.set_cancel(task.cancel);
    swap_queues();
    // Beside a torn facet of another leaf, labels are as unknown as beside one of its own.
    f.set_torn(list.torn_ || task.features_only);
    if (task.tag) {
      worker.guard.open(tr, task.reach, task.tag);
      f.cavity().set_guard(&worker.guard);
    }
  }

  Leaf_session_3(const Leaf_session_3&) = delete;
  Leaf_session_3& operator=(const Leaf_session_3&) = delete;

  /// After an exception nothing is taken back: the run is over.
  ~Leaf_session_3() noexcept(false) {
    if (std::uncaught_exceptions() == exceptions_) close();
  }

  const Leaf_task& task() const { return task_; }
  Worklist& list() { return list_; }
  Features& features() { return worker_.features; }
  Cavity_3<Tr>& cavity() { return worker_.features.cavity(); }
  Obstacles_3<Tr>& obstacles() { return worker_.obstacles; }
  Sheet_shift_3<Tr>& sheets() { return worker_.sheets; }
  Measured_star_3<Tr>& star() { return worker_.star; }

  /// Looks through the features on the cavity of p, which is found. True if one of them is an obstacle.
  bool collect_obstacles(Constraint_complex_3<Tr>& complex, const typename Tr::Point& p) {
    features().features().gather(complex, cavity());
    return obstacles().collect(complex, features().features(), p);
  }

  Drain_result result;            ///< so far, but for points on features
  bool collects_coarse = false;  ///< whether tetrahedra that are fine are told to the leaves where they are

  /// Sends work to the leaf, or territory, where `at` is.
  void send(const Vec_3& at, Kind kind, const Cell_id& id) { list_.outgoing_.push_back({at, kind, id, nullptr}); }
  /// A tetrahedron of another territory is looked at when that is at work.
  void send_fresh(const Cell_id& id) { send(position(id.cell->vertex(0)), Kind::fresh, id); }

  /// Where a facet cannot be mended within the territory, gives away the vertices of the tetrahedra made since it was torn:
  /// nobody touches these then, and the territory goes on around them.
  void cede_unlabelled() {
    Features& f = worker_.features;
    if (f.stranded().size() == std::exchange(stranded_, f.stranded().size())) return;
    for (const Cell_id& id : f.unlabelled_cells())
      if (id.is_live())
        for (int i = 0; i < 4; ++i)
          if (f.cavity().territory().leads_on(id.cell->vertex(i))) id.cell->vertex(i)->set_territory(task_.territory.first);
    ceded_.insert(ceded_.end(), f.unlabelled_cells().begin(), f.unlabelled_cells().end());
    f.unlabelled_cells().clear();
    f.note_mended();
  }

 private:
  void swap_queues() {
    Features& f = worker_.features;
    std::swap(f.queues(), list_.queues_);
    std::swap(f.stranded(), list_.stranded_);
    std::swap(f.fresh_cells(), list_.fresh_);
    std::swap(f.unlabelled_cells(), list_.unlabelled_);
  }

  void close() {
    Features& f = worker_.features;
    for (auto& [at, errand] : f.outgoing()) list_.outgoing_.push_back({at, Kind::errand, {}, std::move(errand)});
    f.outgoing().clear();
    // Torn beyond this task: what is stranded, and what could not be mended because a neighbour is torn.
    list_.torn_ = !f.stranded().empty() || !f.unlabelled_cells().empty() || !ceded_.empty();
    swap_queues();
    list_.unlabelled_.insert(list_.unlabelled_.end(), ceded_.begin(), ceded_.end());
    if (task_.tag) {
      f.cavity().set_guard(nullptr);
      worker_.guard.close();
    }
    list_.release_memory();
  }

  Worker& worker_;
  const Leaf_task task_;
  Worklist& list_;
  std::vector<Cell_id> ceded_;  ///< unlabelled tetrahedra that are not own any more
  std::size_t stranded_ = 0;    ///< pieces, as of the last time that some were ceded
  int exceptions_ = std::uncaught_exceptions();
};

}  // namespace pgdr

#endif
