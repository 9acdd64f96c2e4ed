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
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

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
  Planar_triangulation(const std::vector<Vec_3>& points, const std::vector<Index>& used, const Vec_3& normal)
      : used_(used), cdt_(Traits(normal)) {
    handles_.resize(used.size());
    Face_handle hint;
    for (std::size_t i : insertion_order(points)) {
      const Vertex_handle v = cdt_.insert(to_work_point(points[used_[i]]), hint);
      handles_[i] = v;
      hint = v->face();
    }
    for (std::size_t i = 0; i < used_.size(); ++i) handles_[i]->info() = used_[i];
    for (std::size_t i = 0; i < used_.size(); ++i)
      one_to_one_ = one_to_one_ && handles_[i]->info() == used_[i];
  }

  /// Whether no two vertices fall on one point of the plane.
  bool one_to_one() const { return one_to_one_; }

  /// Makes the segment an edge, or several if vertices lie on it.
  /// \return false when it crosses an earlier one; the triangulation is of no use then.
  bool insert_constraint(Index a, Index b) {
    if (a == b) return true;
    try {
      cdt_.insert_constraint(handle(a), handle(b));
    } catch (const Cdt::Intersection_of_constraints_exception&) {
      return false;
    }
    return true;
  }

  bool has_edge(Index a, Index b) const {
    Face_handle f;
    int i = 0;
    return cdt_.is_edge(handle(a), handle(b), f, i);
  }

  /// All constrained edges, sorted.
  std::vector<Index_pair> constrained_edges() const {
    std::vector<Index_pair> result;
    for (auto e = cdt_.finite_edges_begin(); e != cdt_.finite_edges_end(); ++e)
      if (e->first->is_constrained(e->second)) result.push_back(ends(*e));
    std::sort(result.begin(), result.end());
    return result;
  }

  /// The edges that the inserted constraint a, b became, in order from a to b.
  std::vector<Index_pair> pieces_of(Index a, Index b) const {
    std::vector<Index_pair> result;
    const auto orientation = cdt_.geom_traits().orientation_2_object();
    Vertex_handle current = handle(a);
    const Vertex_handle target = handle(b);
    while (current != target) {
      if (has_edge(current->info(), b)) {
        result.push_back(sorted_pair(current->info(), b));
        break;
      }
      Vertex_handle next;
      auto circulator = cdt_.incident_vertices(current), done = circulator;
      do {
        const Vertex_handle w = circulator;
        if (cdt_.is_infinite(w)) continue;
        // Collinear and ahead: the angle at w between both ends is flat.
        if (orientation(current->point(), w->point(), target->point()) == CGAL::COLLINEAR &&
            CGAL::angle(current->point(), w->point(), target->point()) == CGAL::OBTUSE)
          next = w;
      } while (++circulator != done);
      if (next == Vertex_handle()) break;
      result.push_back(sorted_pair(current->info(), next->info()));
      current = next;
    }
    return result;
  }

  /// Marks as inside what cannot be reached from infinity without crossing an edge of `walls` (sorted).
  void mark_enclosed(const std::vector<Index_pair>& walls) {
    if (cdt_.dimension() < 2) return;
    for (Face_handle f : cdt_.all_face_handles()) f->info() = 1;
    spread(cdt_.infinite_face(), walls);
  }

  /// Marks as inside what an odd number of edges of `walls` (sorted) separates from infinity.
  void mark_odd(const std::vector<Index_pair>& walls) {
    if (cdt_.dimension() < 2) return;
    for (Face_handle f : cdt_.all_face_handles()) f->info() = -1;
    std::vector<Face_handle> stack{cdt_.infinite_face()};
    stack.front()->info() = 0;
    while (!stack.empty()) {
      const Face_handle f = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Face_handle g = f->neighbor(i);
        if (g->info() >= 0) continue;
        g->info() = is_wall(f, i, walls) ? 1 - f->info() : f->info();
        stack.push_back(g);
      }
    }
  }

  /// Takes the region around `seed` out of the inside.
  /// \return false when the seed does not lie in the inside.
  bool remove_region(const Work_point& seed, const std::vector<Index_pair>& walls) {
    if (cdt_.dimension() < 2) return false;
    const Face_handle f = cdt_.locate(seed);
    if (f == Face_handle() || f->info() == 0) return false;
    spread(f, walls);
    return true;
  }

  /// One point in each part of the plane that is outside but cut off from infinity by `walls` (sorted):
  /// the middle of its largest triangle. Call after marking; the marks are lost.
  std::vector<Vec_3> hole_seeds(const std::vector<Index_pair>& walls) {
    std::vector<Vec_3> seeds;
    if (cdt_.dimension() < 2) return seeds;
    collect_region(cdt_.infinite_face(), walls);
    for (Face_handle f : cdt_.finite_face_handles()) {
      if (f->info() != 0) continue;
      double largest = -1;
      Vec_3 seed;
      for (Face_handle g : collect_region(f, walls)) {
        const Vec_3 a = to_vec(g->vertex(0)->point()), b = to_vec(g->vertex(1)->point()),
                    c = to_vec(g->vertex(2)->point());
        const double area = squared_length(cross(b - a, c - a));
        if (area <= largest) continue;
        largest = area;
        seed = (1.0 / 3) * (a + b + c);
      }
      seeds.push_back(seed);
    }
    return seeds;
  }

  /// The inside, counterclockwise about the normal, smallest vertex first, sorted.
  std::vector<std::array<Index, 3>> inside_triangles() const {
    std::vector<std::array<Index, 3>> result;
    if (cdt_.dimension() < 2) return result;
    for (Face_handle f : cdt_.finite_face_handles()) {
      if (f->info() != 1) continue;
      std::array<Index, 3> t{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      result.push_back(t);
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  int dimension() const { return cdt_.dimension(); }

 private:
  /// Order along a Hilbert curve in the plane, which makes insertion fast.
  std::vector<std::size_t> insertion_order(const std::vector<Vec_3>& points) const {
    std::vector<std::size_t> order(used_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    if (used_.size() < 32) return order;
    std::vector<Work_kernel::Point_2> flat;
    flat.reserve(used_.size());
    for (Index i : used_) flat.push_back(cdt_.geom_traits().flat(points[i]));
    using Map = CGAL::Pointer_property_map<Work_kernel::Point_2>::type;
    CGAL::hilbert_sort(order.begin(), order.end(),
                       CGAL::Spatial_sort_traits_adapter_2<Work_kernel, Map>(CGAL::make_property_map(flat)));
    return order;
  }

  Vertex_handle handle(Index v) const {
    return handles_[static_cast<std::size_t>(std::lower_bound(used_.begin(), used_.end(), v) -
                                             used_.begin())];
  }
  static Index_pair ends(const Cdt::Edge& e) {
    return sorted_pair(e.first->vertex(Cdt::cw(e.second))->info(),
                       e.first->vertex(Cdt::ccw(e.second))->info());
  }
  bool is_wall(Face_handle f, int i, const std::vector<Index_pair>& walls) const {
    return f->is_constrained(i) && contains(walls, ends(Cdt::Edge(f, i)));
  }
  /// The outside faces around one, which become neither inside nor outside.
  std::vector<Face_handle> collect_region(Face_handle from, const std::vector<Index_pair>& walls) {
    std::vector<Face_handle> region{from};
    from->info() = 2;
    for (std::size_t next = 0; next < region.size(); ++next)
      for (int i = 0; i < 3; ++i) {
        const Face_handle g = region[next]->neighbor(i);
        if (g->info() != 0 || is_wall(region[next], i, walls)) continue;
        g->info() = 2;
        region.push_back(g);
      }
    return region;
  }
  void spread(Face_handle from, const std::vector<Index_pair>& walls) {
    std::vector<Face_handle> stack{from};
    from->info() = 0;
    while (!stack.empty()) {
      const Face_handle f = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Face_handle g = f->neighbor(i);
        if (g->info() == 0 || is_wall(f, i, walls)) continue;
        g->info() = 0;
        stack.push_back(g);
      }
    }
  }

  std::vector<Index> used_;
  std::vector<Vertex_handle> handles_;
  Cdt cdt_;
  bool one_to_one_ = true;
};

}  // namespace pgdr::domain_detail

#endif
