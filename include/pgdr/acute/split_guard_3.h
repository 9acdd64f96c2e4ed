// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_ACUTE_SPLIT_GUARD_3_H
#define PGDR_ACUTE_SPLIT_GUARD_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/acute/narrow_angles_3.h>
#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/domain/feature_id.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/mesh/triangle_ball.h>

namespace pgdr {

/// Why a subsegment or subfacet is to be split.
enum class Split_reason : std::uint8_t {
  missing,     ///< the 3D triangulation lacks it: conformity demands the split
  encroached,  ///< a vertex lies in its diametral or equatorial ball, or a tetrahedron's Steiner point would
  flat         ///< a tetrahedron has all four vertices on its facet
};

/// The shortest edge that a split may make next to small input angles. Away from these there is no such limit, unless it is strict, since
/// the theory promises one; next to them it is what keeps the refinement from going on for ever.
struct Split_guard {
  double floor = 0;                     ///< no new edge below this
  std::array<Vec_3, 4> where{};         ///< "next to" is: one of these points
  std::size_t count = 0;                ///< how many of them; 0: the split point itself
  double reach = 0;                     ///< within this distance of a small angle; for `count` 0, 4 radii of the piece at least
  double floor_apart = 0;               ///< if positive, in the place of `floor` for pieces without a vertex in which
  std::array<Feature_id, 2> meeting{};  ///< these two meet at a small angle
  double relaxed = 0;                   ///< the relaxed insertion radius that a new vertex has at least
  double inherited = 0;                 ///< the insertion radius that it has at least
  bool is_at_wedge = false;             ///< the client's shortest edge is as short as a small dihedral angle makes it
  double size = 0;                      ///< that the client is over; 0: it is not
  bool is_strict = false;               ///< the floor holds everywhere

  /// Whether the client is given up as soon as one piece in its way refuses: with an edge as short as a small angle makes it, unless
  /// that is much shorter than what is around, or the client is too large.
  bool gives_up_at_once() const { return size == 0 && (is_at_wedge || floor_apart > 0); }
  /// For a piece that is larger than the size itself: it is split whatever is near, which is done only as often as the size fits it.
  Split_guard for_piece(double radius) const {
    Split_guard guard = *this;
    if (size > 0 && radius > size) guard.floor = guard.floor_apart = 0;
    return guard;
  }
  /// Whether one of the points is next to a small angle.
  bool is_near(const Acute_neighborhood_3& acute) const {
    return std::any_of(where.begin(), where.begin() + static_cast<std::ptrdiff_t>(count),
                       [&](const Vec_3& p) { return acute.contains(p, reach); });
  }
};

/// Calls `found(i, j)` with the ends of each edge that is as short as the shortest one.
template <class Found>
void for_each_shortest_edge(const Tetrahedron_ball& ball, const Tetrahedron_points& corners, const Found& found) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      if (squared_distance(corners[i], corners[j]) <= ball.squared_shortest) found(i, j);
}

/// Calls `found(i, j, radius)` with each of these that is shorter than the insertion radii of its ends, and with the smaller of the
/// two. Only a small angle brings two vertices that close.
template <class Cell_handle, class Found>
void for_each_narrow_edge(Cell_handle c, const Tetrahedron_ball& ball, const Tetrahedron_points& corners, const Found& found) {
  for_each_shortest_edge(ball, corners, [&](std::size_t i, std::size_t j) {
    const auto radius_at = [&](std::size_t k) { return c->vertex(static_cast<int>(k))->insertion_radius(); };
    const double radius = std::min(radius_at(i), radius_at(j));
    if (radius * radius > ball.squared_shortest) found(i, j, radius);
  });
}

/// Whether no mesh can do without a tetrahedron like this one: with the shortest edge between two features that meet in another of
/// its corners, at an angle too small for the ratio bound. Refined, it would only be there again, smaller.
template <class Cell_handle>
bool is_hopeless(Cell_handle c, const Tetrahedron_ball& ball, const Tetrahedron_points& corners, double ratio,
                 const Narrow_angles_3& narrow) {
  const double least = ratio * std::sqrt(ball.squared_shortest);
  const auto on = [&](std::size_t i) { return feature_of(c->vertex(static_cast<int>(i))); };
  bool is_hopeless = false;
  for_each_shortest_edge(ball, corners, [&](std::size_t i, std::size_t j) {
    if (on(i).dimension > 2 || on(j).dimension > 2) return;
    const double limit = to_degrees(arc_tangent(1, std::sqrt(4 * ratio * ratio - 1)));
    for (std::size_t k = 0; k < 4; ++k)
      is_hopeless |= k != i && k != j && triangle_circumradius(corners[i], corners[j], corners[k]) > least &&
                     narrow.are_narrow(on(k), on(i), on(j), limit);
  });
  return is_hopeless;
}

/// What the Steiner point of a tetrahedron has for an insertion radius at least, however close to other vertices it is: that of the ends
/// of the shortest edge. For an edge as short as an angle makes it, that is what it would have without the angle. So no
/// point comes closer to a small angle than those did that are there already, for whose sake it is inserted, and none of
/// what follows from it (the argument of J. Shewchuk and H. Si, SoCG 2014, who leave such tetrahedra alone).
template <class Cell_handle>
double inherited_radius(Cell_handle c, const Tetrahedron_ball& ball, const Tetrahedron_points& corners) {
  double inherited = 0;
  for_each_narrow_edge(c, ball, corners, [&](std::size_t, std::size_t, double radius) { inherited = std::max(inherited, radius); });
  return inherited;
}

/// What follows from a tetrahedron has for a relaxed radius at least: that of its shortest edge, whose ends that are not of the input have
/// the smaller one of theirs, and its length if that is more.
template <class Cell_handle>
double relaxed_length(Cell_handle c, const Tetrahedron_ball& ball, const Tetrahedron_points& corners) {
  double most = std::sqrt(ball.squared_shortest);
  for_each_shortest_edge(ball, corners, [&](std::size_t i, std::size_t j) {
    const auto radius_at = [&](std::size_t k) { return static_cast<double>(c->vertex(static_cast<int>(k))->relaxed_radius()); };
    const double a = radius_at(i), b = radius_at(j);
    most = std::max(most, a > 0 && b > 0 ? std::min(a, b) : std::max(a, b));  // of the input: 0
  });
  return most;
}

/// What keeps a tetrahedron's splits from going on for ever next to small angles: a split on its behalf may not make
/// edges shorter than this there.
///
/// Half its shortest edge, but no less than a part of its relaxed length, so that a chain of tetrahedra that each halve what the one before
/// kept has an end (theorem 5 in docs/theory.md). Between vertices on features that meet at a small angle the smaller of their insertion
/// radii, where that is more: the edge is as short as the angle makes it, and splits could go on towards the place where they meet. Where
/// that place is a vertex, pieces that do not touch it may be split down to half of the edge after all: away from the vertex its length is
/// bounded from below. That costs as many points as insertion radii fit the edge more than once, so it is done up to a ratio of
/// `most_points` only, and the part above is half of an edge of that ratio.
/// \param size the bound that the tetrahedron is over, if there is one: then edges of a part of that may be made, too
template <class Cell_handle>
Split_guard split_guard(Cell_handle c, const Tetrahedron_ball& ball, const Tetrahedron_points& corners, std::optional<double> size,
                        const Acute_neighborhood_3& acute) {
  constexpr double most_points = 10;  // table in docs/robustness.md
  // Of a segment in the way of a circumcenter, which is at least so far from all vertices, the middle is half as far, and a point on a shell two thirds of
  // that: with 1/2, six of 83 parts kept edges of 2.1 to 3.8 times the size, with 1/4 one did, before large pieces were split anyway.
  constexpr double part_of_size = 0.25;
  const double relaxed_of_edge = relaxed_length(c, ball, corners);
  const double half = std::max(0.5 * std::sqrt(ball.squared_shortest), relaxed_of_edge / (2 * most_points));
  Split_guard guard{.floor = half, .where = corners, .count = 4, .reach = 4 * std::sqrt(ball.squared_radius), .relaxed = relaxed_of_edge};
  for_each_narrow_edge(c, ball, corners, [&](std::size_t i, std::size_t j, double radius) {
    guard.floor = std::max(guard.floor, radius);
    const Feature_id a = feature_of(c->vertex(static_cast<int>(i))), b = feature_of(c->vertex(static_cast<int>(j)));
    if (!acute.explains(a, corners[i], b, corners[j])) return;
    guard.reach = std::numeric_limits<double>::infinity();  // it is next to the angle, however large
    const bool is_at_wedge = !acute.meet_at_vertices_only(a, b);
    guard.is_at_wedge |= is_at_wedge;
    const double relaxed = std::min(c->vertex(static_cast<int>(i))->relaxed_radius(), c->vertex(static_cast<int>(j))->relaxed_radius());
    if (is_at_wedge || relaxed * relaxed > most_points * most_points * ball.squared_shortest) return;
    guard.meeting = {a, b};
    guard.floor_apart = half;
  });
  if (size) {
    guard.size = *size;
    guard.floor = std::min(guard.floor, part_of_size * guard.size);
  }
  guard.floor_apart = std::min(guard.floor_apart, guard.floor);
  return guard;
}

}  // namespace pgdr

#endif
