// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_SIZING_FIELD_H
#define PGDR_SIZING_SIZING_FIELD_H

#include <concepts>
#include <stdexcept>

namespace pgdr {

/// A sizing field had a value that is negative or no number; `what()` names it and the point.
class Sizing_error : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// A callable from a point to the upper bound of the circumradius of the tetrahedra whose circumcenter it is.
///
/// Unit: that of the input's coordinates. The value is positive, or 0 where the minimum edge length is what bounds sizes; infinity means no
/// bound. Anything else makes `refine_mesh_3` throw a `Sizing_error`. The same point must give the same value each time, on any thread: the mesh
/// is a function of it.
/// Models: any lambda or function object, `Uniform_sizing_field`, `Local_sizing_field`, `Distance_sizing_field`.
template <class S, class K>
concept SizingField = std::copy_constructible<S> && requires(const S& sizing, const typename K::Point_3& p) {
  { sizing(p) } -> std::convertible_to<double>;
};

/// A sizing field whose values take a while: `size_if_below(p, limit)` is below `limit()` if and only if the size at p is, and is no less than
/// the size then; that is all the refinement asks most of the time. The limit is a function since it takes a root. Model: `Distance_sizing_field`.
template <class S, class K>
concept LimitedSizingField = SizingField<S, K> && requires(const S& sizing, const typename K::Point_3& p, double (*limit)()) {
  { sizing.size_if_below(p, limit) } -> std::convertible_to<double>;
};

}  // namespace pgdr

#endif
