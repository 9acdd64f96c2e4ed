// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_PLANAR_TRIANGULATION_H
#define PGDR_DOMAIN_DETAIL_PLANAR_TRIANGULATION_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Projection_traits_3.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/plc.h>

namespace pgdr::domain_detail {

using Index_pair = std::array<Index, 2>;

inline Index_pair sorted_pair(Index a, Index b) { return a < b ? Index_pair{a, b} : Index_pair{b, a}; }

inline bool contains(const std::vector<Index_pair>& sorted, const Index_pair& pair) {
  return std::binary_search(sorted.begin(), sorted.end(), pair);
}

template <class T>
void sort_unique(std::vector<T>& v) {
  std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
}

/// Projects along a normal. Orientations are exact, because they decide topology. Points that are cocircular
/// up to rounding count as cocircular, because regular grids are full of them and exact numbers are slow:
/// every flip is one that improves the triangulation beyond doubt, so that flipping ends.
class Planar_traits : public CGAL::Projection_traits_3<Work_kernel> {
  using Base = CGAL::Projection_traits_3<Work_kernel>;

 public:
  explicit Planar_traits(const Vec_3& normal)
      : Base(Work_kernel::Vector_3(normal.x, normal.y, normal.z)),
        u_(normalized(cross(normal, std::abs(normal.x) < 0.5 ? Vec_3{1, 0, 0} : Vec_3{0, 1, 0}))),
        v_(cross(normal, u_)) {}

  class Side_of_oriented_circle_2 {
   public:
    Side_of_oriented_circle_2(const Vec_3& u, const Vec_3& v) : u_(u), v_(v) {}
    CGAL::Oriented_side operator()(const Work_point& p, const Work_point& q, const Work_point& r,
                                   const Work_point& s) const {
      const Vec_3 o = to_vec(s);
      const std::array<double, 3> a = lifted(p, o), b = lifted(q, o), c = lifted(r, o);
      const double bc = b[0] * c[1] - b[1] * c[0], ca = c[0] * a[1] - c[1] * a[0],
                   ab = a[0] * b[1] - a[1] * b[0];
      const double determinant = a[2] * bc + b[2] * ca + c[2] * ab;
      const double size =
          a[2] * std::sqrt(b[2] * c[2]) + b[2] * std::sqrt(c[2] * a[2]) + c[2] * std::sqrt(a[2] * b[2]);
      if (std::abs(determinant) <= 1e-12 * size) return CGAL::ON_ORIENTED_BOUNDARY;
      return determinant > 0 ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
    }

   private:
    /// Plane coordinates relative to `o`, and their sum of squares.
    std::array<double, 3> lifted(const Work_point& p, const Vec_3& o) const {
      const Vec_3 d = to_vec(p) - o;
      const double x = dot(u_, d), y = dot(v_, d);
      return {x, y, x * x + y * y};
    }
    Vec_3 u_, v_;
  };
  Side_of_oriented_circle_2 side_of_oriented_circle_2_object() const { return {u_, v_}; }

  /// Orthonormal coordinates in the plane, rounded.
  Work_kernel::Point_2 flat(const Vec_3& p) const { return {dot(u_, p), dot(v_, p)}; }

 private:
  Vec_3 u_, v_;
};

/// A constrained Delaunay triangulation of vertices of the complex in the plane with the given normal.
///
/// The predicates project, not the points, so that vertices that are collinear in space are collinear here.
class Planar_triangulation {
  using Traits = Planar_traits;
  using Vb = CGAL::Triangulation_vertex_base_with_info_2<Index, Traits>;
  using Fb = CGAL::Triangulation_face_base_with_info_2<int, Traits,
                                                       CGAL::Constrained_triangulation_face_base_2<Traits>>;
  using Tds = CGAL::Triangulation_data_structure_2<Vb, Fb>;
  using Cdt = CGAL::Constrained_Delaunay_triangulation_2<
      Traits, Tds, CGAL::No_constraint_intersection_requiring_constructions_tag>;
  using Vertex_handle = Cdt::Vertex_handle;
  using Face_handle = Cdt::Face_handle;

 public:
  /// \param used the vertices, ascending, each once.
  Planar_triangulation(const std::vector<Vec_3>& points, const std::vector<Index>& used, const Vec_3& normal);

  /// Whether no two vertices fall on one point of the plane.
  bool one_to_one() const { return one_to_one_; }

  /// Makes the segment an edge, or several if vertices lie on it.
  /// \return false when it crosses an earlier one; the triangulation is of no use then.
  bool insert_constraint(Index a, Index b);

  bool has_edge(Index a, Index b) const;

  /// All constrained edges, sorted.
  std::vector<Index_pair> constrained_edges() const;

  /// The edges that the inserted constraint a, b became, in order from a to b.
  std::vector<Index_pair> pieces_of(Index a, Index b) const;

  /// Marks as inside what cannot be reached from infinity without crossing an edge of `walls` (sorted).
  void mark_enclosed(const std::vector<Index_pair>& walls);

  /// Marks as inside what an odd number of edges of `walls` (sorted) separates from infinity.
  void mark_odd(const std::vector<Index_pair>& walls);

  /// Takes the region around `seed` out of the inside.
  /// \return false when the seed does not lie in the inside.
  bool remove_region(const Work_point& seed, const std::vector<Index_pair>& walls);

  /// One point in each part of the plane that is outside but cut off from infinity by `walls` (sorted):
  /// the middle of its largest triangle. Call after marking; the marks are lost.
  std::vector<Vec_3> hole_seeds(const std::vector<Index_pair>& walls);

  /// The inside, counterclockwise about the normal, smallest vertex first, sorted.
  std::vector<std::array<Index, 3>> inside_triangles() const;

  int dimension() const { return cdt_.dimension(); }

 private:
  /// Order along a Hilbert curve in the plane, which makes insertion fast.
  std::vector<std::size_t> insertion_order(const std::vector<Vec_3>& points) const;

  Vertex_handle handle(Index v) const;
  static Index_pair ends(const Cdt::Edge& e);
  bool is_wall(Face_handle f, int i, const std::vector<Index_pair>& walls) const;
  /// The outside faces around one, which become neither inside nor outside.
  std::vector<Face_handle> collect_region(Face_handle from, const std::vector<Index_pair>& walls);
  void spread(Face_handle from, const std::vector<Index_pair>& walls);

  std::vector<Index> used_;
  std::vector<Vertex_handle> handles_;
  Cdt cdt_;
  bool one_to_one_ = true;
};

}  // namespace pgdr::domain_detail

#endif
