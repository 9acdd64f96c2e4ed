// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_COCIRCULAR_POLYGON_3_H
#define PGDR_CONFORMING_COCIRCULAR_POLYGON_3_H

#include <algorithm>
#include <cstdint>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/presence_3.h>
#include <pgdr/mesh/triangle_ball.h>

namespace pgdr {

/// Where vertices of a facet are (nearly) cocircular, the sheet and the 3D triangulation may have chosen other
/// diagonals, or rounding may have. Rather than split a subfacet that is missing only for that reason, the polygon
/// of its circle takes over whatever triangulation of itself the 3D triangulation shows.
template <class Tr>
class Cocircular_polygon_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Vertex_handle = typename Tr::Vertex_handle;

  Cocircular_polygon_3(Complex& complex, typename Complex::Pool& pool) : complex_(complex), pool_(pool) {}

  /// Replaces the subfacets around a missing one by present ones. False if 3D has no triangulation of the polygon.
  bool adopt(std::uint32_t slot) {
    facet_ = complex_.subfacet(slot).facet;
    const bool usable = collect(slot) && chain_boundary();
    for (const std::uint32_t t : members_) complex_.subfacet(t).scratch = 0;
    if (!usable || members_.size() < 2) return false;
    const std::size_t n = corners_.size();
    middle_.assign(n * n, unknown);
    if (!solve(0, n - 1)) return false;
    replace();
    return true;
  }

 private:
  static constexpr std::size_t max_corners = 24;
  static constexpr int unknown = -2, impossible = -1;
  /// Relative to the circle's radius.
  static constexpr double cocircularity = 1e-6;

  bool collect(std::uint32_t slot) {
    const auto& first = complex_.subfacet(slot);
    const Vec_3 center = triangle_circumcenter(position(first.vertices[0]), position(first.vertices[1]),
                                               position(first.vertices[2]));
    const double radius = length(position(first.vertices[0]) - center);
    members_.assign(1, slot);
    edges_.clear();
    complex_.subfacet(slot).scratch = 1;
    for (std::size_t k = 0; k < members_.size(); ++k) {
      const auto& t = complex_.subfacet(members_[k]);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t n = t.neighbors[i];
        if (!(n & Complex::subsegment_bit)) {
          auto& other = complex_.subfacet(n);
          if (other.scratch) continue;
          const int j = complex_.edge_with_neighbor(n, members_[k]);
          const Vec_3 w = position(other.vertices[static_cast<std::size_t>(j)]);
          if (std::abs(length(w - center) - radius) <= cocircularity * radius) {
            other.scratch = 1;
            members_.push_back(n);
            continue;
          }
        }
        edges_.push_back({t.vertices[(i + 1) % 3], t.vertices[(i + 2) % 3], n});
      }
      if (members_.size() > max_corners) return false;
    }
    // An edge noted before its other side joined is inside.
    std::erase_if(edges_, [this](const Edge& e) {
      return !(e.outside & Complex::subsegment_bit) && complex_.subfacet(e.outside).scratch;
    });
    return true;
  }

  /// Orders the boundary into one cycle; a polygon with k corners has k - 2 triangles.
  bool chain_boundary() {
    if (edges_.size() != members_.size() + 2) return false;
    for (std::size_t k = 1; k < edges_.size(); ++k) {
      const auto next = std::find_if(edges_.begin() + static_cast<std::ptrdiff_t>(k), edges_.end(),
                                     [&](const Edge& e) { return e.source == edges_[k - 1].target; });
      if (next == edges_.end()) return false;
      std::swap(edges_[k], *next);
    }
    corners_.clear();
    for (const Edge& e : edges_) corners_.push_back(e.source);
    return edges_.back().target == corners_.front();
  }

  /// Whether corners i..j, cut off by the diagonal (i, j), can be triangulated by facets of the triangulation.
  bool solve(std::size_t i, std::size_t j) {
    if (j == i + 1) return true;
    int& m = middle_[i * corners_.size() + j];
    if (m != unknown) return m != impossible;
    for (std::size_t k = i + 1; k < j; ++k)
      if (is_present(corners_[i], corners_[k], corners_[j]) && solve(i, k) && solve(k, j)) {
        m = static_cast<int>(k);
        return true;
      }
    m = impossible;
    return false;
  }

  bool is_present(Vertex_handle a, Vertex_handle b, Vertex_handle c) {
    return complex_.orientation(facet_, a->point(), b->point(), c->point()) == CGAL::POSITIVE &&
           star_.find_facet(a, b, c) != typename Tr::Cell_handle();
  }

  void replace() {
    unmark_survivors(complex_, star_, members_);
    for (const std::uint32_t t : members_) complex_.remove_subfacet(pool_, t);
    build(0, corners_.size() - 1, edges_.back().outside);
  }

  /// Makes the triangles of corners i..j and returns the one on the diagonal (i, j), whose other side is `across`.
  std::uint32_t build(std::size_t i, std::size_t j, std::uint32_t across) {
    const std::size_t k = static_cast<std::size_t>(middle_[i * corners_.size() + j]);
    const std::uint32_t t = complex_.add_subfacet(pool_, corners_[i], corners_[k], corners_[j], facet_);
    mark_subfacet(complex_, star_, t);
    join(t, 1, across, corners_[i], corners_[j]);
    const std::uint32_t left = k == i + 1 ? edges_[i].outside : build(i, k, t);
    join(t, 2, left, corners_[i], corners_[k]);
    const std::uint32_t right = j == k + 1 ? edges_[k].outside : build(k, j, t);
    join(t, 0, right, corners_[k], corners_[j]);
    return t;
  }

  /// Sets the neighbour of t across the edge opposite to its vertex `edge`, between u and w, on both sides.
  void join(std::uint32_t t, std::size_t edge, std::uint32_t code, Vertex_handle u, Vertex_handle w) {
    complex_.subfacet(t).neighbors[edge] = code;
    if (code & Complex::subsegment_bit) {
      complex_.subsegment(code & ~Complex::subsegment_bit).subfacets.push_back(t);
      return;
    }
    auto& other = complex_.subfacet(code);
    for (std::size_t m = 0; m < 3; ++m)
      if (other.vertices[m] != u && other.vertices[m] != w) other.neighbors[m] = t;
  }

  struct Edge {
    Vertex_handle source, target;
    std::uint32_t outside;
  };

  Complex& complex_;
  typename Complex::Pool& pool_;
  Vertex_star_3<Tr> star_;
  Index facet_ = 0;
  std::vector<std::uint32_t> members_;
  std::vector<Edge> edges_;
  std::vector<Vertex_handle> corners_;
  std::vector<int> middle_;
};

}  // namespace pgdr

#endif
