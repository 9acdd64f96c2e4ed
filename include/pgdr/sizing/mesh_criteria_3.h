// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_MESH_CRITERIA_3_H
#define PGDR_SIZING_MESH_CRITERIA_3_H

#include <concepts>
#include <functional>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/sizing/combined_sizing_field.h>

namespace pgdr {

/// What a mesh is asked for, in the terms of CGAL's class of this name: sizes of edges, facets and cells, all of them upper bounds. Lengths are in the
/// user's unit; infinity, the default, bounds nothing.
///
///     pgdr::make_mesh_3<C3t3>(surface, {.edge_size = 0.1, .cell_size = [](const auto& p) { return 0.1 + 0.2 * p.z(); }})
///
/// Sizes of edges and facets hold for all tetrahedra that touch them, and away from there the bound grows by `gradation` for each unit of distance (see
/// `sizes_around`), so that the mesh is graded. A mesh conforms to its facets, so that CGAL's `facet_distance`, `facet_angle` and `facet_topology` have nothing to ask for.
struct Mesh_criteria_3 {
  static constexpr double unbounded = std::numeric_limits<double>::infinity();

  /// A number, or a function of a point with x(), y() and z(): a `SizingField`. Functions are called from several threads at once.
  class Cell_size {
   public:
    using Point_3 = Default_kernel::Point_3;

    Cell_size() = default;
    /// \param radius above 0; `sizing_of` refuses others
    Cell_size(double radius) : radius_(radius) {}  // NOLINT(google-explicit-constructor): as in CGAL
    template <class Field>
      requires(!std::convertible_to<Field, double> && !std::same_as<std::remove_cvref_t<Field>, Cell_size> && std::is_invocable_r_v<double, const Field&, const Point_3&>)
    Cell_size(Field field) : field_(std::move(field)) {}  // NOLINT(google-explicit-constructor)

    double radius() const { return radius_; }
    const std::function<double(const Point_3&)>& field() const { return field_; }

   private:
    double radius_ = unbounded;
    std::function<double(const Point_3&)> field_;
  };

  double edge_size = unbounded;   ///< length of the edges on segments
  double facet_size = unbounded;  ///< circumradius of the triangles on facets
  Cell_size cell_size{};          ///< circumradius of tetrahedra

  std::map<int, double> curve_sizes{};  ///< `edge_size` of the segments with these markers
  std::map<int, double> patch_sizes{};  ///< `facet_size` of the facets with these markers

  double edges_per_turn = 0;  ///< around a curved surface, see `curvature_sizes`; 0: no bound
  double cells_across = 0;    ///< what is narrow, see `local_feature_sizes`; 0: no bound

  double cell_radius_edge_ratio = 2;  ///< 2 or more, see `Parameters::radius_edge_ratio`
  double gradation = 0.5;             ///< above 0 and below 1
};

/// The sizing field that `criteria` make for a domain. It is the one that the library comes compiled for.
/// Throws `std::invalid_argument` for sizes and gradations without sense, and for markers that no segment or facet has.
Combined_sizing_field sizing_of(const Mesh_criteria_3& criteria, const Domain_3<Default_kernel>& domain);

}  // namespace pgdr

#endif
