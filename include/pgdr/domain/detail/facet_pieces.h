// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_FACET_PIECES_H
#define PGDR_DOMAIN_DETAIL_FACET_PIECES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>

#include <pgdr/domain/detail/facet_plane.h>
#include <pgdr/domain/detail/planar_triangulation.h>
#include <pgdr/domain/input_error.h>

namespace pgdr::domain_detail {

/// An edge of a piece that may become a segment.
struct Piece_edge {
  Index_pair ends;        ///< smaller first
  Index apex = 0;         ///< third vertex of the piece's triangle on it: which side the piece is on
  bool internal = false;  ///< the piece lies on both sides
};

/// What fusing works on: one planar input facet, or one triangle of an input facet that is not planar.
struct Facet_piece {
  Index input_facet = 0;
  int marker = 0;
  Index group = 0;
  Facet_plane plane;
  double area = 0;
  boost::container::small_vector<std::array<Index, 3>, 1> triangles;  ///< counterclockwise about `plane.normal`
  boost::container::small_vector<Piece_edge, 3> edges;                ///< ascending
};

struct Explicit_segment {
  Index_pair ends;
  int marker = 0;
  friend bool operator<(const Explicit_segment& a, const Explicit_segment& b) {
    // Among equals, one with a marker comes first.
    return std::tuple(a.ends, a.marker == 0, a.marker) < std::tuple(b.ends, b.marker == 0, b.marker);
  }
};

/// The polygons of one facet over merged vertices.
struct Facet_polygons {
  std::vector<std::vector<Index>> loops;
  std::vector<Index_pair> segments;
  std::vector<Index> used;  ///< all vertices, ascending
  std::vector<Work_point> holes;
  std::size_t polygons = 0;
  bool collapsed = false;  ///< a loop has fewer than three distinct vertices
};

inline double triangle_area(const std::vector<Vec_3>& points, const std::array<Index, 3>& t) {
  return length(twice_area_vector(points, t)) / 2;
}

/// Turns input facets into pieces, and gathers what is wrong with them.
class Facet_reader {
 public:
  /// \param points merged vertices.
  Facet_reader(const std::vector<Vec_3>& points, double tolerance, bool triangulate, std::size_t first_index)
      : points_(points), tolerance_(tolerance), triangulate_(triangulate), first_index_(first_index) {}

  std::vector<Facet_piece> pieces;
  std::vector<Explicit_segment> segments;  ///< of facets' two-vertex polygons
  std::vector<Index_pair> replaced;        ///< explicit segments that vertices of a facet cut into several
  std::vector<Input_problem> problems;

  /// \param extra explicit segments with both ends among the facet's vertices.
  void read(Index facet, int marker, const Facet_polygons& in, const std::vector<Explicit_segment>& extra) {
    facet_ = facet;
    marker_ = marker;
    if (in.polygons == 0 && in.holes.empty()) return;  // taken away, and keeps its number
    if (in.collapsed || in.used.empty()) {
      report(Input_problem::Kind::degenerate_facet, "has fewer than three distinct vertices");
    } else if (in.polygons == 1 && in.loops.size() == 1 && in.loops[0].size() == 3 && in.used.size() == 3) {
      read_triangle({in.loops[0][0], in.loops[0][1], in.loops[0][2]});
    } else {
      read_polygons(in, extra);
    }
  }

  /// Adds what another reader has read after this one.
  void append(Facet_reader&& later) {
    std::ranges::move(later.pieces, std::back_inserter(pieces));
    std::ranges::move(later.problems, std::back_inserter(problems));
    segments.insert(segments.end(), later.segments.begin(), later.segments.end());
    replaced.insert(replaced.end(), later.replaced.begin(), later.replaced.end());
  }

 private:
  void report(Input_problem::Kind kind, const std::string& what) {
    problems.push_back({kind, "facet " + std::to_string(facet_ + first_index_) + " " + what, {facet_}, {}});
  }

  Work_point work_point(Index v) const { return to_work_point(points_[v]); }

  void read_triangle(const std::array<Index, 3>& t) {
    const Vec_3 direction = twice_area_vector(points_, t);
    if (CGAL::collinear(work_point(t[0]), work_point(t[1]), work_point(t[2])) || length(direction) == 0) {
      report(Input_problem::Kind::degenerate_facet, "has no area");
      return;
    }
    add_triangle(t, direction);
  }

  void read_polygons(const Facet_polygons& in, const std::vector<Explicit_segment>& extra) {
    Vec_3 direction;
    for (const std::vector<Index>& loop : in.loops)
      if (const Vec_3 d = twice_area_vector(points_, loop); dot(d, d) > dot(direction, direction))
        direction = d;
    if (length(direction) == 0) direction = spread_normal(points_, in.used);
    if (length(direction) == 0) {
      leave_segments(in);
      return;
    }
    double thickness = 0;
    const Facet_plane plane = plane_through(points_, in.used, direction, thickness);
    const bool planar = thickness <= tolerance_;
    if (!planar && !triangulate_) {
      report(Input_problem::Kind::non_planar_facet,
             "is not planar: its vertices lie up to " + short_number(thickness) + " from one plane");
      return;
    }
    Planar_triangulation plane_mesh(points_, in.used, plane.normal);
    if (!plane_mesh.one_to_one()) {
      report(Input_problem::Kind::non_planar_facet, "folds over itself");
      return;
    }
    bool proper = true;
    for (const std::vector<Index>& loop : in.loops)
      for (std::size_t i = 0; i < loop.size() && proper; ++i)
        proper = plane_mesh.insert_constraint(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
    for (const Index_pair& s : in.segments) proper = proper && plane_mesh.insert_constraint(s[0], s[1]);
    if (!proper) {
      report(Input_problem::Kind::self_intersection, "crosses itself");
      return;
    }
    if (plane_mesh.dimension() < 2) {
      leave_segments(in);
      return;
    }
    const std::vector<Index_pair> walls = plane_mesh.constrained_edges();
    if (planar)
      for (const Explicit_segment& s : extra)
        proper = proper && plane_mesh.insert_constraint(s.ends[0], s.ends[1]);
    if (!proper) {
      report(Input_problem::Kind::self_intersection, "is crossed by a segment in its plane");
      return;
    }
    plane_mesh.mark_enclosed(walls);
    for (const Work_point& seed : in.holes) plane_mesh.remove_region(seed, walls);
    const std::vector<std::array<Index, 3>> triangles = plane_mesh.inside_triangles();
    if (triangles.empty()) {
      leave_segments(in);
      return;
    }

    std::vector<Index_pair> kept = walls;
    const auto keep_explicit = [&](const Explicit_segment& s) {
      const std::vector<Index_pair> parts = plane_mesh.pieces_of(s.ends[0], s.ends[1]);
      for (const Index_pair& e : parts) {
        segments.push_back({e, s.marker});
        kept.push_back(e);
      }
      if (parts.size() > 1) replaced.push_back(s.ends);
    };
    for (const Index_pair& s : in.segments) keep_explicit({s, 0});
    if (planar)
      for (const Explicit_segment& s : extra) keep_explicit(s);
    sort_unique(kept);
    if (planar) {
      add_piece(triangles, plane, kept);
    } else {
      for (const std::array<Index, 3>& t : triangles) {
        const Vec_3 d = twice_area_vector(points_, t);
        if (length(d) > 0) add_triangle(t, d);
      }
    }
  }

  /// A facet without area: segments when it is made of nothing else, an error otherwise.
  void leave_segments(const Facet_polygons& in) {
    if (!in.loops.empty()) {
      report(Input_problem::Kind::degenerate_facet, "has no area");
      return;
    }
    for (const Index_pair& s : in.segments) segments.push_back({s, marker_});
  }

  void add_triangle(const std::array<Index, 3>& t, const Vec_3& direction) {
    double thickness = 0;
    add_piece(std::span(&t, 1), plane_through(points_, t, direction, thickness), {});
  }

  /// \param kept edges to keep although the piece may lie on both sides, sorted.
  void add_piece(std::span<const std::array<Index, 3>> triangles, const Facet_plane& plane, const std::vector<Index_pair>& kept) {
    Facet_piece& piece = pieces.emplace_back();
    piece.input_facet = facet_;
    piece.marker = marker_;
    piece.plane = plane;
    piece.triangles.assign(triangles.begin(), triangles.end());
    for (const auto& t : triangles) {
      piece.area += triangle_area(points_, t);
      for (std::size_t i = 0; i < 3; ++i)
        piece.edges.push_back({sorted_pair(t[i], t[(i + 1) % 3]), t[(i + 2) % 3], false});
    }
    std::sort(piece.edges.begin(), piece.edges.end(),
              [](const Piece_edge& a, const Piece_edge& b) { return a.ends < b.ends; });
    std::size_t n = 0;
    for (std::size_t i = 0; i < piece.edges.size(); ++i) {
      const bool twice = i + 1 < piece.edges.size() && piece.edges[i].ends == piece.edges[i + 1].ends;
      if (!twice || contains(kept, piece.edges[i].ends)) {
        Piece_edge e = piece.edges[i];
        e.internal = twice;
        piece.edges[n++] = e;
      }
      if (twice) ++i;
    }
    piece.edges.resize(n);
  }

  static std::string short_number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", x);
    return text;
  }

  const std::vector<Vec_3>& points_;
  double tolerance_;
  bool triangulate_;
  std::size_t first_index_;
  Index facet_ = 0;
  int marker_ = 0;
};

}  // namespace pgdr::domain_detail

#endif
