// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_SIZING_FIELD_H
#define PGDR_SIZING_SIZING_FIELD_H

#include <concepts>

namespace pgdr {

/// A callable from a point to the upper bound of the circumradius of the tetrahedra whose circumcenter it is.
///
/// Unit: that of the input's coordinates. The value is positive; infinity means no bound. The same point must give
/// the same value each time, on any thread: the mesh is a function of it.
/// Models: any lambda or function object, `Uniform_sizing_field`, `Box_sizing_field`.
template <class S, class K>
concept SizingField = std::copy_constructible<S> && requires(const S& sizing, const typename K::Point_3& p) {
  { sizing(p) } -> std::convertible_to<double>;
};

}  // namespace pgdr

#endif
