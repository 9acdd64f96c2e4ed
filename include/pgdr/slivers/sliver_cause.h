// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_SLIVER_CAUSE_H
#define PGDR_SLIVERS_SLIVER_CAUSE_H

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <pgdr/acute/split_guard_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/mesh/mesh_triangulation_3.h>

namespace pgdr {

/// A piece of the input that keeps a sliver where it is, and how far it may be split.
struct Sliver_cause {
  Piece_id piece;
  bool is_subsegment = false;
  Split_guard guard;
};

/// The piece to split where a sliver has its corners on the boundary: of the two edges, or of the three around a cap, at which its
/// dihedral angles are obtuse, a subsegment, the longer one; else a subfacet, the largest; else, if `any_subsegment`, the longest one. A tetrahedron that fills
/// the fold between two facets that are nearly one has a subsegment there, a flat one between cocircular vertices of a facet has two subfacets, and one between
/// segments that run beside each other has only these.
template <class Tr>
std::optional<Sliver_cause> sliver_cause(const Constraint_complex_3<Tr>& complex, typename Tr::Cell_handle c, bool any_subsegment) {
  using Complex = Constraint_complex_3<Tr>;
  const Tetrahedron_points p = tetrahedron_points(c);
  const Tetrahedron_ball ball = tetrahedron_ball(p);
  Sliver_cause cause;
  cause.guard = {.floor = 0.5 * std::sqrt(ball.squared_shortest), .where = p, .count = 4, .reach = 4 * std::sqrt(ball.squared_radius), .is_strict = true};
  const auto at = [&p](int i) { return p[static_cast<std::size_t>(i)]; };
  double largest = 0;
  const auto longest_subsegment = [&](bool only_obtuse) {
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        if (!(c->subsegment_edges() & edge_bit(i, j))) continue;
        // The other two corners, seen along the edge.
        const int k = i == 0 ? (j == 1 ? 2 : 1) : 0, l = 6 - i - j - k;
        const Vec_3 e = at(j) - at(i), u = cross(e, at(k) - at(i)), v = cross(e, at(l) - at(i));
        const double length2 = squared_length(e);
        if ((only_obtuse && dot(u, v) >= 0) || length2 <= largest) continue;
        const std::uint32_t s = complex.find_subsegment(c->vertex(i), c->vertex(j));
        if (s == Complex::none) continue;
        largest = length2;
        cause.piece = complex.subsegment_id(s);
        cause.is_subsegment = true;
      }
    return largest > 0;
  };
  if (longest_subsegment(true)) return cause;
  for (int i = 0; i < 4; ++i) {
    if (c->subfacet(i) == Complex::none) continue;
    const double area2 = squared_length(cross(at((i + 2) & 3) - at((i + 1) & 3), at((i + 3) & 3) - at((i + 1) & 3)));
    if (area2 <= largest) continue;
    largest = area2;
    cause.piece = complex.subfacet_id(c->subfacet(i));
  }
  if (largest > 0 || (any_subsegment && longest_subsegment(false))) return cause;
  return std::nullopt;
}

}  // namespace pgdr

#endif
