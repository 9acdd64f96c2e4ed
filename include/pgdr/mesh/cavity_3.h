// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_CAVITY_3_H
#define PGDR_MESH_CAVITY_3_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <pgdr/mesh/edge_table.h>
#include <pgdr/mesh/mesh_triangulation_3.h>
#include <pgdr/mesh/prefetch.h>
#include <pgdr/mesh/territory_3.h>
#include <pgdr/mesh/zone_guard_3.h>

namespace pgdr {

/// The cavity C(p) of a point and the ball B(p) that replaces it (Bowyer-Watson): the one place that inserts points.
///
/// Use: `find`, look at `cells()` and `boundary()`, then either `commit` or `abandon`. Between them the cells of the
/// cavity carry CGAL's conflict mark and the cells around it the boundary mark; both calls clear them. One object
/// serves one thread; its scratch memory is kept from point to point.
template <class Tr>
class Cavity_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Facet = typename Tr::Facet;
  using Point = typename Tr::Point;

  explicit Cavity_3(Tr& tr) : tr_(&tr), partner_(table_side * table_side) {}

  /// Whom to tell about every cell that is touched; null for nobody.
  void set_guard(Zone_guard_3<Tr>* guard) { guard_ = guard; }

  /// Where cavities have to be from now on; everywhere to begin with.
  void set_territory(const Territory_3<Tr>& territory) { territory_ = territory; }
  const Territory_3<Tr>& territory() const { return territory_; }
  /// Whether the last `find` came to nothing because the cavity is not own.
  bool is_foreign() const { return is_foreign_; }

  /// Collects C(p) from a cell in conflict with p. False, with nothing marked, if `seed` is not in conflict, or if the
  /// cavity is not within the territory.
  /// \pre p is no vertex and not outside the convex hull.
  bool find(const Point& p, Cell_handle seed) {
    return find(p, seed, [](Cell_handle) { return true; });
  }

  /// The same, but gives up, with nothing marked, at the first cell of the cavity that is not `acceptable`, or the first boundary triangle
  /// of which `acceptable_face(cell, i)` says so, as seen from inside.
  template <class Acceptable>
  bool find(const Point& p, Cell_handle seed, const Acceptable& acceptable) {
    return find(p, seed, acceptable, [](Cell_handle, int) { return true; });
  }
  template <class Acceptable, class Acceptable_face>
  bool find(const Point& p, Cell_handle seed, const Acceptable& acceptable, const Acceptable_face& acceptable_face) {
    cells_.clear();
    boundary_.clear();
    is_foreign_ = false;
    const bool is_own = territory_.owns(seed);
    if (guard_ && is_own) guard_->touch(seed);
    if (!tr_->in_conflict(seed, p)) return false;
    if (!is_own) return reject();
    seed->tds_data().mark_in_conflict();
    cells_.push_back(seed);
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      const Cell_handle c = cells_[k];
      if (!acceptable(c)) {
        abandon();
        return false;
      }
      for (int i = 0; i < 4; ++i) {
        const Cell_handle n = c->neighbor(i);
        if (guard_) guard_->touch(n);
        if (n->tds_data().is_in_conflict()) continue;
        if (n->tds_data().is_clear()) {
          if (tr_->in_conflict(n, p)) {
            if (!territory_.owns(n)) return reject();
            n->tds_data().mark_in_conflict();
            cells_.push_back(n);
            for (int j = 0; j < 4; ++j) prefetch(n->neighbor(j));
            continue;
          }
          n->tds_data().mark_on_boundary();
        }
        boundary_.push_back(Facet(c, i));
        if (!acceptable_face(c, i)) {
          abandon();
          return false;
        }
      }
    }
    return true;
  }

  /// C(p), in breadth-first order from the seed.
  const std::vector<Cell_handle>& cells() const { return cells_; }
  /// The boundary triangles, each as seen from inside the cavity.
  const std::vector<Facet>& boundary() const { return boundary_; }
  /// Whether c belongs to the cavity at hand.
  static bool contains(Cell_handle c) { return c->tds_data().is_in_conflict(); }

  /// Squared distance from p to the nearest vertex of the cavity, hence of the triangulation (the nearest
  /// neighbour of a new Delaunay vertex is adjacent to it).
  double squared_insertion_radius(const Vec_3& p) const {
    return squared_insertion_radius(p, [](Vertex_handle) { return false; });
  }

  /// The same without the vertices that a predicate names.
  template <class Ignored>
  double squared_insertion_radius(const Vec_3& p, const Ignored& is_ignored) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Facet& f : boundary_)
      for (int j = 0; j < 4; ++j) {
        const Vertex_handle v = f.first->vertex(j);
        if (j == f.second || v == tr_->infinite_vertex()) continue;
        const double d2 = squared_distance(p, position(v));
        if (d2 < nearest && !is_ignored(v)) nearest = d2;
      }
    return nearest;
  }

  /// Takes back the marks; the triangulation is as before `find`.
  void abandon() {
    for (const Cell_handle c : cells_) c->tds_data().clear();
    for (const Facet& f : boundary_) f.first->neighbor(f.second)->tds_data().clear();
  }

  /// Replaces C(p) by B(p). Each new tetrahedron inherits subdomain, subfacet and subsegments from the cavity
  /// cell behind its boundary triangle; what touches p itself is unmarked.
  Vertex_handle commit(const Point& p) {
    const Vertex_handle v = tr_->tds().create_vertex();
    commit(p, v);
    return v;
  }
  /// The same with a vertex that has no tetrahedra at present (`Vertex_hole_3`).
  void commit(const Point& p, Vertex_handle v) {
    copy_boundary();
    v->set_point(p);
    v->set_territory(territory_.number);
    fill_star(v);
    glue_star();
  }

  /// B(p) after `commit`, in the order of the boundary triangles.
  const std::vector<Cell_handle>& star() const { return star_; }
  /// In each tetrahedron of `star()`, the position of the new vertex.
  int apex(std::size_t k) const { return faces_[k].apex; }

 private:
  static constexpr std::size_t table_side = 64;

  /// What a new tetrahedron needs to know of its boundary triangle, copied out before slots are reused.
  struct Face {
    Vertex_handle vertices[4];
    std::uint32_t numbers[4];  ///< of the vertices, within this boundary
    Cell_handle outside;
    std::uint32_t subfacet;
    std::int32_t subdomain;
    std::uint8_t edges;
    std::uint8_t outside_index;
    std::uint8_t apex;
  };

  bool reject() {
    abandon();
    is_foreign_ = true;
    return false;
  }

  void copy_boundary() {
    constexpr std::uint32_t unnumbered = std::numeric_limits<std::uint32_t>::max();
    faces_.resize(boundary_.size());
    std::uint32_t number = 0;
    // The infinite vertex is everybody's: its number is kept here.
    const Vertex_handle infinite = tr_->infinite_vertex();
    std::uint32_t number_of_infinite = unnumbered;
    for (const Facet& f : boundary_)
      for (int j = 0; j < 4; ++j)
        if (j != f.second && f.first->vertex(j) != infinite) f.first->vertex(j)->set_number(unnumbered);
    for (std::size_t k = 0; k < boundary_.size(); ++k) {
      const Cell_handle c = boundary_[k].first;
      const int i = boundary_[k].second;
      Face& face = faces_[k];
      for (int j = 0; j < 4; ++j) {
        const Vertex_handle v = c->vertex(j);
        face.vertices[j] = v;
        if (j == i) continue;
        std::uint32_t n = v == infinite ? number_of_infinite : v->number();
        if (n == unnumbered) {
          n = number++;
          if (v == infinite)
            number_of_infinite = n;
          else
            v->set_number(n);
        }
        face.numbers[j] = n;
      }
      face.apex = static_cast<std::uint8_t>(i);
      face.outside = c->neighbor(i);
      face.outside_index = static_cast<std::uint8_t>(face.outside->index(c));
      face.subfacet = c->subfacet(i);
      face.subdomain = c->subdomain();
      face.edges = static_cast<std::uint8_t>(c->subsegment_edges() & ~edges_at(i));
    }
    boundary_vertices_ = number;
  }

  void fill_star(Vertex_handle v) {
    star_.clear();
    // The infinite vertex's cell is not kept up to date: see `restore_infinite_cell`.
    const Vertex_handle infinite = tr_->infinite_vertex();
    for (std::size_t k = 0; k < faces_.size(); ++k) {
      Cell_handle c;
      if (k < cells_.size()) {
        // A slot taken over in place saves the container a free and an allocation.
        c = cells_[k];
        c->advance_generation();
        c->tds_data().clear();
        c->ball().forget();
        c->set_state(Cell_state::good);
      } else {
        c = tr_->tds().create_cell();
        if (guard_) guard_->adopt(c);
      }
      const Face& face = faces_[k];
      for (int j = 0; j < 4; ++j) {
        c->set_subfacet(j, Tr::Cell::no_subfacet);
        if (j == face.apex) continue;
        c->set_vertex(j, face.vertices[j]);
        if (face.vertices[j] != infinite) face.vertices[j]->set_cell(c);
      }
      c->set_vertex(face.apex, v);
      c->set_subfacet(face.apex, face.subfacet);
      c->set_subdomain(face.subdomain);
      c->set_subsegment_edges(face.edges);
      c->set_neighbor(face.apex, face.outside);
      face.outside->set_neighbor(face.outside_index, c);
      face.outside->tds_data().clear();
      star_.push_back(c);
    }
    v->set_cell(star_.front());
    for (std::size_t k = faces_.size(); k < cells_.size(); ++k) tr_->tds().delete_cell(cells_[k]);
  }

  /// Joins the tetrahedra of the star across the triangles at p: two of them for every edge of the boundary.
  void glue_star() {
    if (boundary_vertices_ <= table_side) {
      glue([this](std::uint32_t a, std::uint32_t b) -> std::uint32_t& { return partner_[a * table_side + b]; });
    } else {
      edges_.reset(faces_.size() + faces_.size() / 2);
      glue([this](std::uint32_t a, std::uint32_t b) -> std::uint32_t& { return edges_(a, b); });
    }
  }

  template <class Slot>
  void glue(const Slot& slot) {
    for (std::uint32_t k = 0; k < star_.size(); ++k) {
      const Face& face = faces_[k];
      for (int j = 0; j < 4; ++j) {
        if (j == face.apex) continue;
        // The two vertices of the triangle opposite j that are not p.
        int others[2], n = 0;
        for (int m = 0; m < 4; ++m)
          if (m != j && m != face.apex) others[n++] = m;
        const std::uint32_t a = face.numbers[others[0]], b = face.numbers[others[1]];
        std::uint32_t& s = slot(std::min(a, b), std::max(a, b));
        if (s == 0) {
          s = 4 * k + static_cast<std::uint32_t>(j) + 1;
        } else {
          const Cell_handle c = star_[k], other = star_[(s - 1) / 4];
          c->set_neighbor(j, other);
          other->set_neighbor(static_cast<int>((s - 1) % 4), c);
          s = 0;  // leaves the table empty for the next point
        }
      }
    }
  }

  Tr* tr_;
  Zone_guard_3<Tr>* guard_ = nullptr;
  Territory_3<Tr> territory_;
  bool is_foreign_ = false;
  std::vector<Cell_handle> cells_;
  std::vector<Facet> boundary_;
  std::vector<Face> faces_;
  std::vector<Cell_handle> star_;
  std::vector<std::uint32_t> partner_;
  Edge_table edges_;  ///< the same for boundaries with more vertices
  std::uint32_t boundary_vertices_ = 0;
};

}  // namespace pgdr

#endif
