// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_FUSE_FACETS_H
#define PGDR_DOMAIN_DETAIL_FUSE_FACETS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <pgdr/domain/detail/facet_pieces.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_sort.h>

namespace pgdr::domain_detail {

/// One or several pieces in one plane.
struct Facet_group {
  std::vector<Index> pieces;  ///< ascending
  Facet_plane plane;          ///< of the largest piece
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index_pair> segments;  ///< on its boundary and inside it, ascending
};

/// Fuses adjacent coplanar pieces with the same marker and of the same group.
///
/// Groups grow breadth-first from the largest piece that has no group yet. Every vertex of a group lies
/// within the tolerance of the plane of that one piece: comparing neighbours pairwise would drift around a
/// cylinder.
class Facet_fuser {
 public:
  /// \param segments explicit segments, sorted: nothing is fused across them.
  Facet_fuser(const std::vector<Vec_3>& points, const std::vector<Facet_piece>& pieces,
              const std::vector<Explicit_segment>& segments, double tolerance)
      : points_(points), pieces_(pieces), tolerance_(tolerance) {
    collect_edges(segments);
  }

  /// The groups, ordered by their first piece.
  std::vector<Facet_group> fuse() {
    group_of_.assign(pieces_.size(), none);
    find_alone();
    std::vector<Facet_group> several;  // of more than one piece
    std::vector<Index> seeds;
    std::vector<Index> number(pieces_.size(), none);  // in `several`, of the group with this seed
    for (const Index seed : largest_first()) {
      if (group_of_[seed] != none) continue;
      group_of_[seed] = seed;
      if (is_alone_[seed]) continue;
      Facet_group group{grow(seed), pieces_[seed].plane, {}, {}};
      if (group.pieces.size() == 1) continue;
      number[seed] = static_cast<Index>(several.size());
      seeds.push_back(seed);
      several.push_back(std::move(group));
    }
    std::vector<char> is_plane(several.size());
    parallel_for(0, several.size(), [&](std::size_t i) { is_plane[i] = triangulate(several[i], seeds[i]); });
    for (std::size_t i = 0; i < several.size(); ++i) {
      if (is_plane[i]) continue;
      // The projections overlap: each piece stays by itself.
      number[seeds[i]] = none;
      for (const Index alone : several[i].pieces) group_of_[alone] = alone;
    }
    std::vector<Index> first_pieces;
    first_pieces.reserve(pieces_.size());
    for (Index p = 0; p < pieces_.size(); ++p)
      if (const Index n = number[group_of_[p]]; n == none || several[n].pieces[0] == p) first_pieces.push_back(p);
    std::vector<Facet_group> ordered(first_pieces.size());
    parallel_for_chunks(ordered.size(), default_grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const Index p = first_pieces[i], seed = group_of_[p];
        const auto& triangles = pieces_[p].triangles;
        if (number[seed] != none)
          ordered[i] = std::move(several[number[seed]]);
        else
          ordered[i] = {{p}, pieces_[p].plane, {triangles.begin(), triangles.end()}, {}};
        ordered[i].segments = group_segments(ordered[i], seed);
      }
    });
    return ordered;
  }

 private:
  static constexpr Index none = std::numeric_limits<Index>::max();

  struct Edge_use {
    Index piece;
    Index apex;
    bool internal;
  };
  struct Edge {
    Index_pair ends;
    std::size_t first_use;
    std::size_t end_use;
    bool fusable;
  };

  void collect_edges(const std::vector<Explicit_segment>& segments) {
    struct Entry {
      Index_pair ends;
      Index piece, edge;
    };
    first_edge_.push_back(0);
    for (const Facet_piece& p : pieces_) first_edge_.push_back(first_edge_.back() + static_cast<Index>(p.edges.size()));
    std::vector<Entry> entries;
    entries.reserve(first_edge_.back());
    for (Index p = 0; p < pieces_.size(); ++p)
      for (Index i = 0; i < pieces_[p].edges.size(); ++i) entries.push_back({pieces_[p].edges[i].ends, p, i});
    parallel_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return std::tie(a.ends, a.piece, a.edge) < std::tie(b.ends, b.piece, b.edge); });
    edge_ids_.resize(entries.size());
    uses_.reserve(entries.size());
    for (const Entry& e : entries) {
      const Piece_edge& use = pieces_[e.piece].edges[e.edge];
      if (edges_.empty() || edges_.back().ends != e.ends)
        edges_.push_back({e.ends, uses_.size(), uses_.size(), false});
      uses_.push_back({e.piece, use.apex, use.internal});
      edges_.back().end_use = uses_.size();
      edge_ids_[first_edge_[e.piece] + e.edge] = static_cast<Index>(edges_.size() - 1);
    }
    auto explicit_segment = segments.begin();
    for (Edge& e : edges_) {
      while (explicit_segment != segments.end() && explicit_segment->ends < e.ends) ++explicit_segment;
      const bool named = explicit_segment != segments.end() && explicit_segment->ends == e.ends;
      if (named || e.end_use - e.first_use != 2) continue;
      const Edge_use& a = uses_[e.first_use];
      const Edge_use& b = uses_[e.first_use + 1];
      const Facet_piece &p = pieces_[a.piece], &q = pieces_[b.piece];
      e.fusable = !a.internal && !b.internal && p.marker == q.marker && p.group == q.group && p.group != fused_with_none;
    }
  }

  /// Places of a piece's edges in `edges_`, as `Facet_piece::edges`.
  std::span<const Index> edges_of(Index piece) const {
    return {edge_ids_.data() + first_edge_[piece], first_edge_[piece + 1] - first_edge_[piece]};
  }

  std::vector<Index> largest_first() const {
    std::vector<std::pair<double, Index>> order;
    order.reserve(pieces_.size());
    for (Index p = 0; p < pieces_.size(); ++p) order.emplace_back(-pieces_[p].area, p);
    parallel_sort(order.begin(), order.end());
    std::vector<Index> result;
    result.reserve(order.size());
    for (const auto& entry : order) result.push_back(entry.second);
    return result;
  }

  /// On a curved surface nearly all pieces; in the order of the file, which is kinder to the cache than that of areas.
  void find_alone() {
    is_alone_.resize(pieces_.size());
    parallel_for_chunks(pieces_.size(), default_grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t p = first; p < last; ++p)
        is_alone_[p] = std::ranges::none_of(edges_of(static_cast<Index>(p)), [&](Index edge) {
          const Edge& e = edges_[edge];
          if (!e.fusable) return false;
          const Index q = uses_[e.first_use].piece;
          return in_plane(q != p ? q : uses_[e.first_use + 1].piece, pieces_[p].plane);
        });
    });
  }

  std::vector<Index> grow(Index seed) {
    const Facet_plane& plane = pieces_[seed].plane;
    std::vector<Index> members{seed};
    for (std::size_t next = 0; next < members.size(); ++next) {
      const Index p = members[next];
      for (const Index edge : edges_of(p)) {
        const Edge& e = edges_[edge];
        if (!e.fusable) continue;
        const bool first = uses_[e.first_use].piece == p;
        const Edge_use& here = uses_[e.first_use + (first ? 0 : 1)];
        const Edge_use& there = uses_[e.first_use + (first ? 1 : 0)];
        if (group_of_[there.piece] != none || !in_plane(there.piece, plane)) continue;
        if (!opposite_sides(e.ends, here.apex, there.apex, plane.normal)) continue;
        group_of_[there.piece] = seed;
        members.push_back(there.piece);
      }
    }
    std::sort(members.begin(), members.end());
    return members;
  }

  bool in_plane(Index piece, const Facet_plane& plane) const {
    // A needle thinner than the tolerance may stand at any angle; one that stands upright has no side.
    if (std::abs(dot(pieces_[piece].plane.normal, plane.normal)) < 0.5) return false;
    for (const auto& t : pieces_[piece].triangles)
      for (Index v : t)
        if (std::abs(dot(plane.normal, points_[v] - plane.origin)) > tolerance_) return false;
    return true;
  }

  /// Whether the two pieces lie on different sides of their edge, seen along the normal.
  bool opposite_sides(const Index_pair& edge, Index apex, Index other_apex, const Vec_3& normal) const {
    const CGAL::Projection_traits_3<Work_kernel> traits(Work_kernel::Vector_3(normal.x, normal.y, normal.z));
    const auto orientation = traits.orientation_2_object();
    const Work_point a = point(edge[0]), b = point(edge[1]);
    const CGAL::Orientation here = orientation(a, b, point(apex));
    return here != CGAL::COLLINEAR && orientation(a, b, point(other_apex)) == -here;
  }

  Work_point point(Index v) const { return to_work_point(points_[v]); }

  bool separates(const Edge& e, Index seed) const {
    if (!e.fusable) return true;
    return group_of_[uses_[e.first_use].piece] != seed || group_of_[uses_[e.first_use + 1].piece] != seed;
  }

  std::vector<Index_pair> group_segments(const Facet_group& group, Index seed) const {
    std::vector<Index_pair> result;
    for (Index p : group.pieces)
      for (const Index edge : edges_of(p))
        if (separates(edges_[edge], seed)) result.push_back(edges_[edge].ends);
    sort_unique(result);
    return result;
  }

  /// \return false when the projections of the pieces overlap, so that they are no planar facet together.
  bool triangulate(Facet_group& group, Index seed) const {
    const std::vector<Index_pair> segments = group_segments(group, seed);
    std::vector<Index> used;
    std::size_t expected = 0;
    for (Index p : group.pieces) {
      expected += pieces_[p].triangles.size();
      for (const auto& t : pieces_[p].triangles) used.insert(used.end(), t.begin(), t.end());
    }
    sort_unique(used);
    Planar_triangulation plane_mesh(points_, used, group.plane.normal);
    if (!plane_mesh.one_to_one()) return false;
    for (const Index_pair& s : segments)
      if (!plane_mesh.insert_constraint(s[0], s[1])) return false;
    for (const Index_pair& s : segments)
      if (!plane_mesh.has_edge(s[0], s[1])) return false;
    plane_mesh.mark_odd(outline(group, segments));
    group.triangles = plane_mesh.inside_triangles();
    // Any triangulation of one region over the same vertices has the same number of triangles.
    return group.triangles.size() == expected;
  }

  /// The segments with the group on exactly one side.
  std::vector<Index_pair> outline(const Facet_group& group, const std::vector<Index_pair>& segments) const {
    std::vector<Index_pair> once;
    for (Index p : group.pieces)
      for (const Piece_edge& e : pieces_[p].edges)
        if (!e.internal && contains(segments, e.ends)) once.push_back(e.ends);
    std::sort(once.begin(), once.end());
    std::vector<Index_pair> result;
    for (std::size_t i = 0; i < once.size();) {
      std::size_t j = i;
      while (j < once.size() && once[j] == once[i]) ++j;
      if (j - i == 1) result.push_back(once[i]);
      i = j;
    }
    return result;
  }

  const std::vector<Vec_3>& points_;
  const std::vector<Facet_piece>& pieces_;
  double tolerance_;
  std::vector<Edge_use> uses_;
  std::vector<Edge> edges_;
  std::vector<Index> first_edge_;  ///< of each piece, in `edge_ids_`, and the end
  std::vector<Index> edge_ids_;
  std::vector<char> is_alone_;  ///< of each piece, whether none of those beside it lies in its plane
  std::vector<Index> group_of_;  ///< of each piece, the seed of its group
};

}  // namespace pgdr::domain_detail

#endif
