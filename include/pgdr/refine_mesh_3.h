// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINE_MESH_3_H
#define PGDR_REFINE_MESH_3_H

#include <algorithm>
#include <atomic>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/conforming/conforming_delaunay_3.h>
#include <pgdr/conforming/subdomains_3.h>
#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/domain/volumes_3.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_walk.h>
#include <pgdr/parallel/thread_arena.h>
#include <pgdr/parameters.h>
#include <pgdr/refinement/delaunay_leaf_refiner_3.h>
#include <pgdr/refinement/indexed_mesh_of_3.h>
#include <pgdr/refinement/point_placement.h>
#include <pgdr/refinement/quality_criteria_3.h>
#include <pgdr/refinement/refined_mesh_3.h>
#include <pgdr/report/format.h>
#include <pgdr/schedule/epoch_scheduler.h>
#include <pgdr/schedule/limit_watch.h>
#include <pgdr/sizing/combined_sizing_field.h>
#include <pgdr/sizing/sizing_field.h>
#include <pgdr/sizing/uniform_sizing_field.h>
#include <pgdr/slivers/optimize_mesh_3.h>
#include <pgdr/slivers/remove_slivers_3.h>

namespace pgdr {

namespace internal {

/// One run from domain to refined mesh: recovery, subdomains, refinement, and the limits on all of them.
template <class K, class Sizing, class Placement>
class Mesher_3 {
  using Mesh = Refined_mesh_3<K>;
  using Tr = typename Mesh::Triangulation;
  using Criteria = Quality_criteria_3<K, Sizing>;
  using Engine = Delaunay_leaf_refiner_3<Tr, Criteria, Placement>;
  using Clock = std::chrono::steady_clock;

  /// The minimum edge length, of the diagonal. A triangle that the tolerance of surfaces leaves, 1e-6 high, can have an angle of 1e-6, and like points on
  /// its sides, 1e-6 from the corner, are this close. Rounding moves the points of a facet by 1e-16, a ten-thousandth of it. With 1e-9, eleven of 236 parts of
  /// `bench/occ_parts.py` stopped before they were conforming.
  static constexpr double least_edge = 1e-12;

 public:
  Mesher_3(Domain_3<K> domain, Sizing sizing, const Parameters& parameters, Placement placement)
      : parameters_(parameters), watch_(parameters.cancel, memory_to_refine(parameters), parameters.time_limit), sizing_(std::move(sizing)), placement_(std::move(placement)),
        mesh_(std::move(domain)), acute_(mesh_.domain(), size_bounds()),
        min_edge_length_(parameters.min_edge_length > 0 ? parameters.min_edge_length / unit_of(mesh_.domain())
                                                        : least_edge * mesh_.domain().diagonal),
        features_(mesh_.triangulation(), mesh_.complex(), acute_, min_edge_length_) {
    parameters_.cancel = watch_.flag();
    if (parameters_.inserted) mesh_.triangulation().set_listener(&listener_);
    mesh_.set_radius_edge_ratio(parameters.radius_edge_ratio);
  }

  Mesh run() {
    start_ = Clock::now();
    build_complex(mesh_.complex(), features_.pool(), insert_domain_vertices(mesh_.triangulation(), mesh_.domain()));
    features_.images().find_facets();
    features_.set_cancel(parameters_.cancel);
    const auto on_hull = corner_of_hull(mesh_.triangulation());
    lap("triangulation");
    start_segment_recovery(mesh_.triangulation(), features_);
    while (features_.has_subsegments() && !should_stop()) features_.step();
    start_facet_recovery(mesh_.triangulation(), features_);
    features_.images().find_facets();
    while (!features_.is_idle() && !should_stop()) features_.step();
    features_.note_mended();
    lap("conforming");
    mesh_.triangulation().restore_infinite_cell(on_hull);
    const bool is_conforming = count_missing() == 0;
    Subdomain_labeler_3<Tr> labeler(mesh_.triangulation(), mesh_.complex());
    mesh_.subdomains() = is_conforming ? labeler.label(parameters_.ignore_region_sizes)
                                       : labeler.label_closed(Volumes_3<K>(mesh_.domain()), parameters_.ignore_region_sizes,
                                                              mesh_.statistics().volumes_left_out);
    lap("labelling");
    const Criteria criteria(parameters_.radius_edge_ratio, sizing_, mesh_.subdomains(), unit_of(mesh_.domain()));
    if (is_conforming && reason_ == Stop_reason::finished) refine(criteria);
    if (reason_ != Stop_reason::finished) note_unrefined(criteria);
    mesh_.triangulation().restore_infinite_cell(on_hull);
    lap("refinement");
    if (reason_ == Stop_reason::finished && parameters_.min_dihedral > 0) {
      remove_slivers(criteria);
      lap("slivers");
    }
    if (reason_ == Stop_reason::finished && parameters_.optimization_rounds > 0) {
      optimize(criteria);
      lap("optimization");
    }
    mesh_.triangulation().restore_infinite_cell(on_hull);
    if (parameters_.verify && !mesh_.triangulation().is_valid())
      throw std::logic_error("the refined triangulation is not a valid Delaunay triangulation");
    if (parameters_.verify) lap("verification");
    conclude();
    return std::move(mesh_);
  }

 private:
  /// Numbering needs a third more than what is refined (docs/performance.md): 160 bytes a tetrahedron instead of 135, and 20 where it
  /// was left poor.
  static std::size_t memory_to_refine(const Parameters& parameters) { return parameters.max_memory > 0 ? std::max<std::size_t>(1, parameters.max_memory / 4 * 3) : 0; }

  Size_bounds size_bounds() const {
    const Domain_3<K>& domain = mesh_.domain();
    Size_bounds bounds;
    // What is wrong with a value is said when the refinement comes there.
    bounds.is_field_below = [this, unit = unit_of(domain)](const Vec_3& p, double length) {
      const typename K::Point_3 q(unit * p.x, unit * p.y, unit * p.z);
      const double limit = unit * length;
      double size;
      if constexpr (LimitedSizingField<Sizing, K>)
        size = sizing_.size_if_below(q, [limit] { return limit; });
      else
        size = sizing_(q);
      return size >= 0 && size < limit;
    };
    const bool ignore = parameters_.ignore_region_sizes;
    if (std::ranges::any_of(domain.regions, [ignore](const auto& r) { return (r.max_volume > 0 && !ignore) || r.max_circumradius > 0; }))
      bounds.at_vertex = region_sizes_at_vertices(Volumes_3<K>(domain), domain, ignore);
    return bounds;
  }

  void refine(const Criteria& criteria) {
    Engine engine(mesh_.triangulation(), mesh_.complex(), acute_, criteria, min_edge_length_, placement_);
    Epoch_scheduler<Engine> scheduler(engine, parameters_, mesh_.triangulation().number_of_vertices());
    if (!scheduler.run()) reason_ = watch_.reached() == Limit_watch::Limit::none ? Stop_reason::vertex_budget : reason_of(watch_.reached());
    if (scheduler.limited() > 0) limited_ = count_limited();
    mesh_.statistics().schedule = std::move(scheduler.statistics());
  }

  void remove_slivers(const Criteria& criteria) {
    Engine engine(mesh_.triangulation(), mesh_.complex(), acute_, criteria, min_edge_length_, placement_);
    const auto notify = [this](std::size_t slivers) {
      if (parameters_.progress) parameters_.progress({"removing slivers", mesh_.triangulation().number_of_vertices(), slivers});
    };
    Sliver_removal_3<Tr, Criteria, Engine> removal(mesh_.triangulation(), mesh_.complex(), criteria, min_edge_length_, cosine_of_degrees(parameters_.min_dihedral),
                                                   engine, parameters_.vertex_limit(), parameters_.cancel);
    mesh_.statistics().slivers = removal.run(notify);
    const std::size_t left = mesh_.statistics().slivers.left;
    if (left > 0 && parameters_.cancel && parameters_.cancel->load(std::memory_order_relaxed))
      reason_ = reason_of(watch_.reached());
    else if (left > 0 && removal.is_limited())
      reason_ = Stop_reason::vertex_budget;
    if (limited_ > 0) limited_ = count_limited();
  }

  void optimize(const Criteria& criteria) {
    const auto notify = [this](std::size_t vertices) {
      if (parameters_.progress) parameters_.progress({"optimization", mesh_.triangulation().number_of_vertices(), vertices});
    };
    const double wanted = parameters_.min_dihedral > 0 ? cosine_of_degrees(parameters_.min_dihedral) : -1;
    mesh_.statistics().optimization =
        Mesh_optimizer_3<Tr, Criteria>(mesh_.triangulation(), mesh_.complex(), criteria, min_edge_length_, wanted, parameters_.cancel)
            .run(parameters_.optimization_rounds, notify);
    if (parameters_.cancel && parameters_.cancel->load(std::memory_order_relaxed)) reason_ = reason_of(watch_.reached());
    if (mesh_.statistics().slivers.left > 0) mesh_.statistics().slivers.left = count_slivers(wanted);
    if (limited_ > 0) limited_ = count_limited();
  }

  /// Asked before every insertion while conforming.
  bool should_stop() {
    if (reason_ != Stop_reason::finished) return true;
    const std::size_t vertices = mesh_.triangulation().number_of_vertices();
    if (parameters_.max_vertices > 0 && vertices >= parameters_.max_vertices) reason_ = Stop_reason::vertex_budget;
    if (parameters_.cancel && parameters_.cancel->load(std::memory_order_relaxed)) reason_ = reason_of(watch_.reached());
    if (parameters_.progress && ++calls_ % 4096 == 0) parameters_.progress({"conforming", vertices, features_.pending()});
    return reason_ != Stop_reason::finished;
  }

  static Stop_reason reason_of(Limit_watch::Limit limit) {
    switch (limit) {
      case Limit_watch::Limit::memory: return Stop_reason::memory_limit;
      case Limit_watch::Limit::time: return Stop_reason::time_limit;
      case Limit_watch::Limit::caller:
      case Limit_watch::Limit::none: break;
    }
    return Stop_reason::cancelled;
  }

  /// f(cell) for all cells that are meshed, on all threads.
  void for_meshed_cells(const auto& f) const {
    const Tr& tr = mesh_.triangulation();
    parallel_for_each(tr.finite_cells_begin(), tr.finite_cells_end(), default_grain, [&f](auto it) {
      if (it->subdomain() != 0) f(typename Tr::Cell_handle(it));
    });
  }

  std::size_t count_meshed(const auto& predicate) const {
    std::atomic<std::size_t> n = 0;
    for_meshed_cells([&](auto c) { n += predicate(c); });
    return n;
  }

  /// Tetrahedra with a dihedral angle below the one with this cosine.
  std::size_t count_slivers(double cosine) const {
    return count_meshed([cosine](auto c) { return largest_dihedral_cosine(tetrahedron_points(c)) > cosine; });
  }

  std::size_t count_limited() const {
    return count_meshed([](auto c) { return c->state() == Cell_state::limited; });
  }

  /// A stop leaves cells that nobody has looked at.
  void note_unrefined(const Criteria& criteria) {
    for_meshed_cells([&criteria](auto c) {
      if (c->state() == Cell_state::good && criteria.is_poor(tetrahedron_ball(tetrahedron_points(c)), c->subdomain()))
        c->set_state(Cell_state::poor);
    });
  }

  void lap(const char* phase) {
    const auto now = Clock::now();
    mesh_.statistics().seconds.emplace_back(phase, std::chrono::duration<double>(now - start_).count());
    start_ = now;
  }

  void conclude() {
    mesh_.triangulation().set_listener(nullptr);
    Run_statistics& s = mesh_.statistics();
    s.unrecovered = count_missing();
    s.steiner_points = mesh_.triangulation().number_of_vertices() - mesh_.domain().vertices.size() -
                       (is_box(mesh_.domain()) ? 0 : 8);
    std::string lost;
    if (reason_ != Stop_reason::finished && s.slivers.left > 0) lost += "; " + counted(s.slivers.left, "sliver is", "slivers are") + " left";
    if (reason_ == Stop_reason::finished && (s.unrecovered > 0 || limited_ > 0)) reason_ = Stop_reason::min_edge_length;
    s.stop = reason_;
    if (s.unrecovered > 0) lost += "; " + std::to_string(s.unrecovered) + " pieces of the input are not in the mesh";
    if (s.volumes_left_out > 0) lost += "; " + counted(s.volumes_left_out, "volume is", "volumes are") + " not closed yet, and left out";
    switch (reason_) {
      case Stop_reason::finished: break;
      case Stop_reason::vertex_budget:
        s.stop_message = "stopped at the limit of " + std::to_string(parameters_.vertex_limit()) + " vertices" + lost;
        break;
      case Stop_reason::cancelled: s.stop_message = "cancelled" + lost; break;
      case Stop_reason::memory_limit:
        s.stop_message = "stopped at the limit of " + memory_size(parameters_.max_memory) + " of memory" + lost;
        break;
      case Stop_reason::time_limit:
        s.stop_message = "stopped at the time limit" + lost;
        break;
      case Stop_reason::min_edge_length:
        // Nobody knows of a missing piece whether a shorter edge would have helped.
        s.stop_message = std::string(limited_ > 0 ? "stopped at the" : "stopped where no point recovers what is missing, down to the") + " minimum edge length of " +
                         significant(unit_of(mesh_.domain()) * min_edge_length_, 3) + lost;
        if (limited_ > 0) s.stop_message += "; " + counted(limited_, "tetrahedron", "tetrahedra") + " could not be refined";
        break;
    }
  }

  std::size_t count_missing() const {
    const auto& complex = mesh_.complex();
    std::size_t n = 0;
    for (std::uint32_t i = 0; i < complex.subsegment_slots(); ++i)
      n += complex.subsegment(i).alive() && !complex.subsegment(i).present;
    for (std::uint32_t i = 0; i < complex.subfacet_slots(); ++i)
      n += complex.subfacet(i).alive() && !complex.subfacet(i).present;
    return n;
  }

  Parameters parameters_;
  Limit_watch watch_;
  Sizing sizing_;
  Placement placement_;
  Mesh mesh_;
  Acute_neighborhood_3 acute_;
  double min_edge_length_;
  Feature_refiner_3<Tr> features_;
  Stop_reason reason_ = Stop_reason::finished;
  std::size_t limited_ = 0;  ///< tetrahedra at the minimum edge length
  std::size_t calls_ = 0;
  const typename Tr::Listener listener_ = [this](const Vec_3& p, int dimension) {
    const double unit = unit_of(mesh_.domain());
    parameters_.inserted({unit * p.x, unit * p.y, unit * p.z, dimension});
  };
  Clock::time_point start_;
};

}  // namespace internal

/// Meshes a domain: a conforming Delaunay tetrahedralization in which every tetrahedron has a radius-edge ratio of
/// at most `parameters.radius_edge_ratio` and a circumradius of at most `sizing` at its circumcenter, but for
/// *exempt* ones next to input angles below 60 degrees.
///
/// Lengths in `sizing` and `parameters` are in the user's unit, those of the triangulation in 2^`Domain_3::exponent` of it.
/// Ends for every domain without acute angles between facets (Shewchuk 1998); else a limit may end it, see
/// `Run_statistics::stop`. \pre `validate_domain_3(domain)` finds no fault.
/// `placement` says where in its selection ball the Steiner point of a tetrahedron goes.
/// Throws `std::invalid_argument` for parameters without sense, `Sizing_error` for sizes that are negative or no numbers.
template <class K, class Sizing, PointPlacement Placement>
  requires SizingField<Sizing, K>
Refined_mesh_3<K> refine_mesh_3(Domain_3<K> domain, const Sizing& sizing, const Parameters& parameters,
                                Placement placement) {
  if (!(parameters.radius_edge_ratio >= 2))
    throw std::invalid_argument("the radius-edge ratio must be at least 2: below it the refinement need not end");
  if (!(parameters.min_dihedral >= 0 && parameters.min_dihedral <= Parameters::largest_min_dihedral))
    throw std::invalid_argument("the smallest dihedral angle must be from 0 to " + significant(Parameters::largest_min_dihedral, 2) + " degrees");
  if (parameters.octree_depth < 0 || parameters.octree_depth > Parameters::largest_octree_depth)
    throw std::invalid_argument("the depth of the octree must be from 0 to " + std::to_string(Parameters::largest_octree_depth));
  return with_threads(parameters.threads, [&] { return internal::Mesher_3<K, Sizing, Placement>(std::move(domain), sizing, parameters, std::move(placement)).run(); });
}

/// The same with Steiner points where `parameters.placement` says. With the default kernel the engine is the library's, which calls a field of the user's
/// through a `std::function`; a `LimitedSizingField` of the user's gets an engine of its own.
template <class K, class Sizing>
  requires SizingField<Sizing, K>
Refined_mesh_3<K> refine_mesh_3(Domain_3<K> domain, const Sizing& sizing, const Parameters& parameters = {}) {
  if constexpr (std::same_as<K, Default_kernel> && (!LimitedSizingField<Sizing, K> || std::same_as<Sizing, Distance_sizing_field>))
    return refine_mesh_3(std::move(domain), Combined_sizing_field::of(sizing), parameters);
  else
    return refine_mesh_3(std::move(domain), sizing, parameters,
                       Standard_placement{parameters.placement, {cosine_of_degrees(angle_of_choice(parameters.min_dihedral))}});
}

/// The same from a PLC as the user wrote it. Throws `Input_error` with every problem that is found in it; where these are only
/// warnings, they are in the statistics.
template <class K, class Sizing>
  requires SizingField<Sizing, K>
Refined_mesh_3<K> refine_mesh_3(const Piecewise_linear_complex_3<K>& plc, const Sizing& sizing,
                                const Parameters& parameters = {}) {
  Domain_3<K> domain = make_domain_3(plc, parameters.coplanar_tolerance, parameters.triangulate_facets);
  std::vector<Input_problem> problems = validate_domain_3(domain);
  if (!std::ranges::all_of(problems, &Input_problem::is_warning)) throw Input_error(std::move(problems));
  Refined_mesh_3<K> mesh = refine_mesh_3(std::move(domain), sizing, parameters);
  mesh.statistics().warnings = std::move(problems);
  return mesh;
}

// Compiled in the library, with one engine for both kinds of sizing field: a single size is no boxes.
extern template Refined_mesh_3<Default_kernel> refine_mesh_3(Domain_3<Default_kernel>, const Combined_sizing_field&, const Parameters&);
extern template Refined_mesh_3<Default_kernel> refine_mesh_3(const Plc&, const Combined_sizing_field&, const Parameters&);
template <>
Refined_mesh_3<Default_kernel> refine_mesh_3(Domain_3<Default_kernel> domain, const Uniform_sizing_field& sizing,
                                             const Parameters& parameters);
extern template Refined_mesh_3<Default_kernel> refine_mesh_3(const Plc&, const Uniform_sizing_field&, const Parameters&);

}  // namespace pgdr

#endif
