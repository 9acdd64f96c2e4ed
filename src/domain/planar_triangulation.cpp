// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/detail/planar_triangulation.h>

#include <algorithm>
#include <cstddef>

#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

namespace pgdr::domain_detail {

Planar_triangulation::Planar_triangulation(const std::vector<Vec_3>& points, const std::vector<Index>& used, const Vec_3& normal)
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

bool Planar_triangulation::insert_constraint(Index a, Index b) {
  if (a == b) return true;
  try {
    cdt_.insert_constraint(handle(a), handle(b));
  } catch (const Cdt::Intersection_of_constraints_exception&) {
    return false;
  }
  return true;
}

bool Planar_triangulation::has_edge(Index a, Index b) const {
  Face_handle f;
  int i = 0;
  return cdt_.is_edge(handle(a), handle(b), f, i);
}

std::vector<Index_pair> Planar_triangulation::constrained_edges() const {
  std::vector<Index_pair> result;
  for (auto e = cdt_.finite_edges_begin(); e != cdt_.finite_edges_end(); ++e)
    if (e->first->is_constrained(e->second)) result.push_back(ends(*e));
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Index_pair> Planar_triangulation::pieces_of(Index a, Index b) const {
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

void Planar_triangulation::mark_enclosed(const std::vector<Index_pair>& walls) {
  if (cdt_.dimension() < 2) return;
  for (Face_handle f : cdt_.all_face_handles()) f->info() = 1;
  spread(cdt_.infinite_face(), walls);
}

void Planar_triangulation::mark_odd(const std::vector<Index_pair>& walls) {
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

bool Planar_triangulation::remove_region(const Work_point& seed, const std::vector<Index_pair>& walls) {
  if (cdt_.dimension() < 2) return false;
  const Face_handle f = cdt_.locate(seed);
  if (f == Face_handle() || f->info() == 0) return false;
  spread(f, walls);
  return true;
}

std::vector<Vec_3> Planar_triangulation::hole_seeds(const std::vector<Index_pair>& walls) {
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

std::vector<std::array<Index, 3>> Planar_triangulation::inside_triangles() const {
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

std::vector<std::size_t> Planar_triangulation::insertion_order(const std::vector<Vec_3>& points) const {
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

Planar_triangulation::Vertex_handle Planar_triangulation::handle(Index v) const {
  return handles_[static_cast<std::size_t>(std::lower_bound(used_.begin(), used_.end(), v) -
                                           used_.begin())];
}

Index_pair Planar_triangulation::ends(const Cdt::Edge& e) {
  return sorted_pair(e.first->vertex(Cdt::cw(e.second))->info(),
                     e.first->vertex(Cdt::ccw(e.second))->info());
}

bool Planar_triangulation::is_wall(Face_handle f, int i, const std::vector<Index_pair>& walls) const {
  return f->is_constrained(i) && contains(walls, ends(Cdt::Edge(f, i)));
}

std::vector<Planar_triangulation::Face_handle> Planar_triangulation::collect_region(Face_handle from, const std::vector<Index_pair>& walls) {
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

void Planar_triangulation::spread(Face_handle from, const std::vector<Index_pair>& walls) {
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

}  // namespace pgdr::domain_detail
