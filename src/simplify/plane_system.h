// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_PLANE_SYSTEM_H
#define PGDR_SIMPLIFY_PLANE_SYSTEM_H

#include <array>
#include <vector>

#include <pgdr/domain/plc.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// Points that are to lie on planes which nobody knows exactly: "these vertices are in one plane", many times over.
class Plane_system {
 public:
  using Vertices = std::vector<Index>;

  /// A vertex of it may not move along the axes that are set.
  using Fixed_axes = std::array<bool, 3>;

  /// \param facets the vertices of each plane, at least 3; those with 3 say nothing
  /// \param enough how far off their plane points may be
  Plane_system(const std::vector<Vertices>& facets, const std::vector<Fixed_axes>& fixed, double enough)
      : facets_(facets), fixed_(fixed), enough_(enough) {}

  /// Moves the points of some facets, as little as possible, until those of each are in a plane, no step gets any closer, or there were
  /// as many. Facets without a common vertex may be solved at once.
  void solve(std::vector<Vec_3>& points, const std::vector<Index>& facets, int most_steps) const;

  /// Moves the points roughly to where that moves them: who goes too far is seen, in a small part of the time.
  void approach(std::vector<Vec_3>& points, const std::vector<Index>& facets) const;

  /// Largest distance of the points from the plane that fits them best (least squares).
  static double bend(const Vertices& facet, const std::vector<Vec_3>& points);

 private:
  class Linearization;
  class Rough_step;

  /// A normal without the axes along which the vertex may not move.
  Vec_3 movable(Index vertex, Vec_3 normal) const;

  const std::vector<Vertices>& facets_;
  const std::vector<Fixed_axes>& fixed_;
  double enough_;
};

}  // namespace pgdr

#endif
