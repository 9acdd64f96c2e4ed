// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MESH_VERTEX_HOLE_3_H
#define PGDR_MESH_VERTEX_HOLE_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <pgdr/mesh/mesh_triangulation_3.h>
#include <pgdr/mesh/prefetch.h>
#include <pgdr/mesh/territory_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>

namespace pgdr {

/// The hole that a vertex leaves when it is taken out, and the Delaunay tetrahedra that fill it: the one place that removes points.
///
/// Use: `find`, look at `star()`, `fill`, look at `filling()`, then perhaps `commit`. Nothing is written before that but the vertices' scratch numbers.
/// The filling is found by gift wrapping (Chand and Kapur, J. ACM 17, 1970): behind an open triangle of the hole comes the vertex whose
/// ball with it holds no other. The perturbed in-sphere test makes the Delaunay triangulation a function of the points, so the result is
/// that part of it which the vertex had covered.
///
/// It is wrapped in doubles first, and kept if exact tests find that it is right, which are fewer than to wrap it with them: positive
/// tetrahedra, no triangle left open, and none that is not locally Delaunay (docs/theory.md, section 12).
template <class Tr>
class Vertex_hole_3 {
 public:
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Facet = typename Tr::Facet;
  using Point = typename Tr::Point;

  /// Vertices around a hole, at most: a vertex of a graded mesh has about 15 neighbors, and the search is quadratic.
  static constexpr std::size_t most_vertices = 64;

  /// A tetrahedron of the filling, positively oriented.
  struct Tetrahedron {
    std::array<std::uint8_t, 4> corners;       ///< positions in `vertices()`
    std::array<std::int32_t, 4> neighbors{};   ///< opposite to each corner: in the filling, or `beyond(k)` for the boundary triangle k
    Certified_ball ball;
  };
  static constexpr std::int32_t beyond(std::size_t k) { return -1 - static_cast<std::int32_t>(k); }
  static constexpr bool is_beyond(std::int32_t neighbor) { return neighbor < 0; }
  static constexpr std::size_t boundary_triangle(std::int32_t neighbor) { return static_cast<std::size_t>(-1 - neighbor); }

  explicit Vertex_hole_3(Tr& tr) : tr_(&tr) {}

  /// Where holes have to be from now on; everywhere to begin with.
  void set_territory(const Territory_3<Tr>& territory) { territory_ = territory; }

  /// Looks at the vertex's star. False if the star is not within the territory, touches the convex hull, has subfacets
  /// at the vertex or tetrahedra of different subdomains, or is too large. \pre v is own
  bool find(Vertex_handle v) {
    vertex_ = v;
    is_foreign_ = false;
    return collect_star() && number_vertices();
  }

  /// Fills the hole with tetrahedra. \pre `find` was true
  bool fill() {
    return (wrap([this](const Open& o) { return guess_behind(o); }) && is_locally_delaunay()) ||
           wrap([this](const Open& o) { return vertex_behind(o); });
  }

  /// Whether the last `find` came to nothing because the star is not own.
  bool is_foreign() const { return is_foreign_; }

  /// The tetrahedra at the vertex.
  const std::vector<Cell_handle>& star() const { return star_; }
  /// In each of them, the position of the vertex.
  int apex(std::size_t k) const { return star_[k]->index(vertex_); }
  const std::vector<Vertex_handle>& vertices() const { return vertices_; }
  const std::vector<Vec_3>& points() const { return points_; }
  const std::vector<Tetrahedron>& filling() const { return filling_; }
  /// Which of the filling is behind the triangle of `star()[k]` opposite to the vertex.
  std::int32_t filling_behind(std::size_t k) const { return behind_[k]; }
  Tetrahedron_points points_of(const Tetrahedron& t) const {
    return {points_[t.corners[0]], points_[t.corners[1]], points_[t.corners[2]], points_[t.corners[3]]};
  }

  /// Whether the open circumball of a tetrahedron of the filling holds p, as `Mesh_triangulation_3::in_conflict`. Exact.
  bool in_conflict(const Tetrahedron& t, const Point& p) const { return in_conflict(t.corners, t.ball, to_vec(p), p); }

  /// Replaces the star by the filling, after which the vertex has no tetrahedra: it has to be put back with `Cavity_3::commit`, or
  /// deleted. Subdomain, subfacets and subsegments are kept.
  const std::vector<Cell_handle>& commit() {
    const auto outer = copy_boundary();
    const std::int32_t subdomain = star_.front()->subdomain();
    std::vector<Cell_handle>& made = star_;
    for (std::size_t k = filling_.size(); k < made.size(); ++k) tr_->tds().delete_cell(made[k]);
    const std::size_t reused = std::min(made.size(), filling_.size());
    made.resize(filling_.size());
    for (std::size_t k = 0; k < made.size(); ++k) {
      if (k < reused) {
        made[k]->advance_generation();
        made[k]->set_state(Cell_state::good);
      } else {
        made[k] = tr_->tds().create_cell();
      }
      for (int i = 0; i < 4; ++i) {
        const Vertex_handle u = vertices_[filling_[k].corners[static_cast<std::size_t>(i)]];
        made[k]->set_vertex(i, u);
        made[k]->set_subfacet(i, Tr::Cell::no_subfacet);
        u->set_cell(made[k]);
      }
      made[k]->set_subdomain(subdomain);
      made[k]->set_subsegment_edges(subsegments_of(filling_[k]));
      made[k]->ball() = filling_[k].ball;
    }
    for (std::size_t k = 0; k < made.size(); ++k)
      for (int i = 0; i < 4; ++i) {
        const std::int32_t n = filling_[k].neighbors[static_cast<std::size_t>(i)];
        if (!is_beyond(n)) {
          made[k]->set_neighbor(i, made[static_cast<std::size_t>(n)]);
          continue;
        }
        const Beyond& b = outer[boundary_triangle(n)];
        made[k]->set_neighbor(i, b.cell);
        b.cell->set_neighbor(b.index, made[k]);
        made[k]->set_subfacet(i, b.subfacet);
      }
    return made;
  }

 private:
  struct Beyond {
    Cell_handle cell;
    int index;
    std::uint32_t subfacet;
  };
  /// A triangle of the hole that has no tetrahedron yet: the corners other than `apex` of a positive tetrahedron that lies inside.
  struct Open {
    std::uint32_t key;
    std::array<std::uint8_t, 4> corners;
    int apex;
    std::int32_t owner;  ///< whose it is on the other side
    int owner_index;
  };

  const Point& point(std::uint8_t k) const { return vertices_[k]->point(); }

  /// `at` is where p is.
  bool in_conflict(const std::array<std::uint8_t, 4>& corners, const Certified_ball& ball, const Vec_3& at, const Point& p) const {
    if (ball.is_known())
      if (const int side = ball.side(at); side != 0) return side > 0;
    return tr_->in_ball(point(corners[0]), point(corners[1]), point(corners[2]), point(corners[3]), p);
  }

  /// Wraps the hole's inside. `behind(open)`: position of the vertex behind an open triangle, or -1.
  template <class Behind>
  bool wrap(const Behind& behind) {
    filling_.clear();
    open_.clear();
    behind_.assign(star_.size(), 0);
    for (std::size_t k = 0; k < star_.size(); ++k) {
      Open o{0, {}, apex(k), beyond(k), 0};
      for (int i = 0; i < 4; ++i)
        if (i != o.apex) o.corners[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(star_[k]->vertex(i)->number());
      o.key = key_of(o.corners, o.apex);
      open_.push_back(o);
    }
    while (!open_.empty()) {
      const Open o = open_.back();
      open_.pop_back();
      const int next = behind(o);
      // None of this can be, with exact predicates; but nothing has been written yet.
      if (next < 0 || filling_.size() >= 8 * most_vertices || !add_tetrahedron(o, static_cast<std::uint8_t>(next))) return false;
    }
    return true;
  }

  /// Whether the triangles between tetrahedra of the filling are locally Delaunay.
  bool is_locally_delaunay() const {
    for (std::size_t k = 0; k < filling_.size(); ++k)
      for (std::size_t i = 0; i < 4; ++i) {
        const std::int32_t n = filling_[k].neighbors[i];
        if (n < static_cast<std::int32_t>(k)) continue;  // beyond, or looked at
        const Tetrahedron& other = filling_[static_cast<std::size_t>(n)];
        const auto at = static_cast<std::size_t>(std::ranges::find(other.neighbors, static_cast<std::int32_t>(k)) - other.neighbors.begin());
        const std::uint8_t corner = other.corners[at];
        if (in_conflict(filling_[k].corners, filling_[k].ball, points_[corner], point(corner))) return false;
      }
    return true;
  }

  bool collect_star() {
    star_.clear();
    star_.push_back(vertex_->cell());
    for (std::size_t k = 0; k < star_.size(); ++k) {
      const Cell_handle c = star_[k];
      if (k + 2 < star_.size())
        for (int i = 0; i < 4; ++i) prefetch(star_[k + 2]->vertex(i));
      is_foreign_ = !territory_.owns(c);
      if (is_foreign_ || tr_->is_infinite(c) || c->subdomain() != star_.front()->subdomain()) return false;
      const int at = c->index(vertex_);
      prefetch(c->neighbor(at));
      for (int i = 0; i < 4; ++i) {
        if (i == at) continue;
        if (c->subfacet(i) != Tr::Cell::no_subfacet) return false;
        const Cell_handle n = c->neighbor(i);
        if (std::ranges::find(star_, n) == star_.end()) {
          prefetch(n);
          star_.push_back(n);
        }
      }
      // Twice as many triangles as vertices, less four, bound the hole.
      if (star_.size() > 2 * most_vertices - 4) return false;
    }
    return true;
  }

  bool number_vertices() {
    vertices_.clear();
    points_.clear();
    subsegments_.fill(0);
    const auto is_numbered = [this](Vertex_handle u) { return u->number() < vertices_.size() && vertices_[u->number()] == u; };
    for (const Cell_handle c : star_)
      for (int i = 0; i < 4; ++i) {
        const Vertex_handle u = c->vertex(i);
        if (u == vertex_ || is_numbered(u)) continue;
        u->set_number(static_cast<std::uint32_t>(vertices_.size()));
        vertices_.push_back(u);
        points_.push_back(position(u));
      }
    if (vertices_.size() > most_vertices) return false;
    for (const Cell_handle c : star_) {
      if (c->subsegment_edges() == 0) continue;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
          if (i != j && (c->subsegment_edges() & edge_bit(i, j)) && c->vertex(i) != vertex_ && c->vertex(j) != vertex_)
            subsegments_[c->vertex(i)->number()] |= std::uint64_t{1} << c->vertex(j)->number();
    }
    return true;
  }

  std::uint8_t subsegments_of(const Tetrahedron& t) const {
    unsigned edges = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j)
        if (subsegments_[t.corners[static_cast<std::size_t>(i)]] >> t.corners[static_cast<std::size_t>(j)] & 1) edges |= edge_bit(i, j);
    return static_cast<std::uint8_t>(edges);
  }

  /// The triangle's key: whatever the order of its corners, but other than that of the same one with its inside on the other side.
  static std::uint32_t key_of(const std::array<std::uint8_t, 4>& corners, int apex) {
    std::uint32_t a = corners[static_cast<std::size_t>((apex + 1) & 3)], b = corners[static_cast<std::size_t>((apex + 2) & 3)],
                  c = corners[static_cast<std::size_t>((apex + 3) & 3)];
    auto side = static_cast<std::uint32_t>(apex & 1);
    if (a > b) std::swap(a, b), side ^= 1;
    if (b > c) std::swap(b, c), side ^= 1;
    if (a > b) std::swap(a, b), side ^= 1;
    return side << 24 | a << 16 | b << 8 | c;
  }
  static std::uint32_t from_other_side(std::uint32_t key) { return key ^ 1U << 24; }

  static bool is_corner(const Open& o, std::size_t k) {
    bool is = false;
    for (int i = 0; i < 4; ++i) is |= i != o.apex && o.corners[static_cast<std::size_t>(i)] == k;
    return is;
  }

  /// The vertex that looks like the one behind an open triangle, in doubles: the center of the ball through the triangle and the vertex is
  /// least far on the inner side.
  int guess_behind(const Open& o) const {
    const auto corner = [&](int i) { return points_[o.corners[static_cast<std::size_t>((o.apex + i) & 3)]]; };
    const Vec_3 a = corner(1), ab = corner(2) - a, ac = corner(3) - a;
    const Vec_3 n = (o.apex & 1 ? 1.0 : -1.0) * cross(ab, ac);
    const double nn = squared_length(n);
    const Vec_3 center = (0.5 / nn) * (squared_length(ac) * cross(cross(ab, ac), ab) + squared_length(ab) * cross(ac, cross(ab, ac)));
    const double squared_radius = squared_length(center);
    int best = -1;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Vec_3 u = points_[k] - a - center;
      const double height = dot(u, n);
      if (!(height > 0) || is_corner(o, k)) continue;
      if (const double t = (squared_length(u) - squared_radius) / height; t < nearest) nearest = t, best = static_cast<int>(k);
    }
    return best;
  }

  /// The vertex on the inner side of an open triangle in whose ball with it there is no other. Exact.
  int vertex_behind(const Open& o) const {
    std::array<std::uint8_t, 4> corners = o.corners;
    Certified_ball ball;
    int best = -1;
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      const auto next = static_cast<std::uint8_t>(k);
      if (is_corner(o, k) || (best >= 0 && !in_conflict(corners, ball, points_[k], point(next)))) continue;
      const std::uint8_t before = std::exchange(corners[static_cast<std::size_t>(o.apex)], next);
      if (is_positive(corners)) {
        best = static_cast<int>(k);
        ball = ball_of(corners);
      } else {
        corners[static_cast<std::size_t>(o.apex)] = before;
      }
    }
    return best;
  }

  bool is_positive(const std::array<std::uint8_t, 4>& corners) const {
    return tr_->geom_traits().orientation_3_object()(point(corners[0]), point(corners[1]), point(corners[2]), point(corners[3])) == CGAL::POSITIVE;
  }

  Certified_ball ball_of(const std::array<std::uint8_t, 4>& corners) const {
    const Tetrahedron_ball ball = tetrahedron_ball({points_[corners[0]], points_[corners[1]], points_[corners[2]], points_[corners[3]]});
    Certified_ball certified;
    certified.set(ball.center, std::sqrt(ball.squared_radius), ball_error);
    return certified;
  }

  /// Puts a tetrahedron between an open triangle and a vertex. False if it is not positive.
  bool add_tetrahedron(const Open& o, std::uint8_t next) {
    const auto number = static_cast<std::int32_t>(filling_.size());
    Tetrahedron t;
    t.corners = o.corners;
    t.corners[static_cast<std::size_t>(o.apex)] = next;
    if (!is_positive(t.corners)) return false;
    link(t, number, o.apex, o);
    for (int i = 0; i < 4; ++i) {
      if (i == o.apex) continue;
      const std::uint32_t key = key_of(t.corners, i);
      const auto other = std::ranges::find(open_, key, &Open::key);
      if (other != open_.end()) {
        link(t, number, i, *other);
        *other = open_.back();
        open_.pop_back();
        continue;
      }
      Open fresh{from_other_side(key), t.corners, i, number, i};
      std::swap(fresh.corners[static_cast<std::size_t>((i + 1) & 3)], fresh.corners[static_cast<std::size_t>((i + 2) & 3)]);
      open_.push_back(fresh);
    }
    t.ball = ball_of(t.corners);
    filling_.push_back(t);
    return true;
  }

  void link(Tetrahedron& t, std::int32_t number, int i, const Open& other) {
    t.neighbors[static_cast<std::size_t>(i)] = other.owner;
    if (is_beyond(other.owner))
      behind_[boundary_triangle(other.owner)] = number;
    else
      filling_[static_cast<std::size_t>(other.owner)].neighbors[static_cast<std::size_t>(other.owner_index)] = number;
  }

  /// What is beyond each boundary triangle, before slots are reused.
  std::vector<Beyond> copy_boundary() const {
    std::vector<Beyond> outer;
    outer.reserve(star_.size());
    for (std::size_t k = 0; k < star_.size(); ++k) {
      const int i = apex(k);
      const Cell_handle n = star_[k]->neighbor(i);
      outer.push_back({n, n->index(star_[k]), star_[k]->subfacet(i)});
    }
    return outer;
  }

  Tr* tr_;
  Territory_3<Tr> territory_;
  bool is_foreign_ = false;
  Vertex_handle vertex_;
  std::vector<Cell_handle> star_;
  std::vector<Vertex_handle> vertices_;
  std::vector<Vec_3> points_;
  std::array<std::uint64_t, most_vertices> subsegments_{};  ///< of each vertex, to which others
  std::vector<Tetrahedron> filling_;
  std::vector<std::int32_t> behind_;
  std::vector<Open> open_;
};

}  // namespace pgdr

#endif
