// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_FACET_STAR_3_H
#define PGDR_CONFORMING_FACET_STAR_3_H

#include <array>
#include <cstdint>
#include <vector>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/mesh/territory_3.h>

namespace pgdr {

/// What a point on a facet does to the facet's sheet: the subfacets that it removes, and the edges around them
/// that it is joined to (Bowyer-Watson in the facet's plane).
///
/// The sheet follows the 3D triangulation where the removed subfacets exist there and the equatorial balls where
/// they do not, so that both agree even where rounding separates cocircular points.
template <class Tr>
class Facet_star_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Point = typename Tr::Point;
  using Vertex_handle = typename Tr::Vertex_handle;

  static constexpr std::uint8_t deleted_bit = 1;  ///< in `Subfacet::scratch`: its cells are both in the cavity at hand
  static constexpr std::uint8_t region_bit = 2;   ///< in `Subfacet::scratch`: removed by this star

  struct Edge {
    Vertex_handle source, target;  ///< the removed side on its left
    std::uint32_t outside;         ///< neighbour code across it
  };

  /// Collects the star of p, which lies in `seed` or on one of its edges: on the subsegment `split`, or `none`.
  /// The largest region first; where p does not see all of its boundary, only what p lies in.
  /// False if even that fails (p is outside the seed's facet, or on a vertex), or if the star is not within the territory.
  bool plan(Complex& complex, std::uint32_t seed, const Point& p, std::uint32_t split, const Territory_3<Tr>& territory) {
    territory_ = territory;
    is_foreign_ = !territory.owns(complex.subfacet(seed).vertices);
    if (is_foreign_) return false;
    facet_ = complex.subfacet(seed).facet;
    split_ = split;
    return collect(complex, seed, p, true) || (!is_foreign_ && collect(complex, seed, p, false));
  }
  /// Whether the last `plan` came to nothing because the star is not own.
  bool is_foreign() const { return is_foreign_; }

  Index facet() const { return facet_; }
  const std::vector<std::uint32_t>& removed() const { return removed_; }

  /// Replaces the removed subfacets by the star of v. `halves` are the two new subsegments when one was split:
  /// (source, v) and (v, target). Appends the new subfacets, none of them marked present.
  void apply(Complex& complex, typename Complex::Pool& pool, Vertex_handle v,
             const std::array<std::uint32_t, 2>& halves, std::vector<std::uint32_t>& made) const {
    for (const std::uint32_t t : removed_) complex.remove_subfacet(pool, t);
    const std::size_t first = made.size();
    for (const Edge& e : edges_) {
      const std::uint32_t t = complex.add_subfacet(pool, e.source, e.target, v, facet_);
      made.push_back(t);
      complex.subfacet(t).neighbors[2] = e.outside;
      if (e.outside & Complex::subsegment_bit)
        complex.subsegment(e.outside & ~Complex::subsegment_bit).subfacets.push_back(t);
      else
        join_back(complex, e, t);
    }
    for (std::size_t k = first; k < made.size(); ++k) {
      // The edge (target, v) faces the subfacet that starts at target, if any, else one half of the subsegment.
      auto& t = complex.subfacet(made[k]);
      const std::uint32_t next = starting_at(complex, made, first, t.vertices[1]);
      if (next != Complex::none) {
        t.neighbors[0] = next;
        complex.subfacet(next).neighbors[1] = made[k];
      } else {
        attach_half(complex, made[k], 0, t.vertices[1], halves);
      }
      if (!ends_at(complex, made, first, t.vertices[0])) attach_half(complex, made[k], 1, t.vertices[0], halves);
    }
  }

 private:
  bool collect(Complex& complex, std::uint32_t seed, const Point& p, bool all) {
    removed_.assign(1, seed);
    edges_.clear();
    complex.subfacet(seed).scratch |= region_bit;
    for (std::size_t k = 0; k < removed_.size(); ++k) {
      const auto& t = complex.subfacet(removed_[k]);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t n = t.neighbors[i];
        if (n == (split_ | Complex::subsegment_bit) && split_ != Complex::none) continue;
        const bool open = !(n & Complex::subsegment_bit);
        if (open && (complex.subfacet(n).scratch & region_bit)) continue;
        const Vertex_handle u = t.vertices[(i + 1) % 3], w = t.vertices[(i + 2) % 3];
        const bool grow = all ? open && is_doomed(complex, n, p)
                              : open && complex.orientation(facet_, u->point(), w->point(), p) != CGAL::POSITIVE;
        is_foreign_ |= grow && !territory_.owns(complex.subfacet(n).vertices);
        if (grow && !is_foreign_ && removed_.size() < max_region) {
          complex.subfacet(n).scratch |= region_bit;
          removed_.push_back(n);
        } else {
          edges_.push_back({u, w, n});
        }
      }
    }
    drop_inner_edges(complex);
    for (const std::uint32_t t : removed_)
      complex.subfacet(t).scratch &= static_cast<std::uint8_t>(~region_bit);
    return !is_foreign_ && sees_all(complex, p);
  }

  /// A neighbour that joined the region after its edge was noted is no longer outside.
  void drop_inner_edges(const Complex& complex) {
    std::size_t kept = 0;
    for (const Edge& e : edges_)
      if ((e.outside & Complex::subsegment_bit) || !(complex.subfacet(e.outside).scratch & region_bit))
        edges_[kept++] = e;
    edges_.resize(kept);
  }

  static bool is_doomed(const Complex& complex, std::uint32_t n, const Point& p) {
    const auto& t = complex.subfacet(n);
    if (t.present) return t.scratch & deleted_bit;
    return is_encroached(t, p);
  }

  /// The star is a disk of counterclockwise triangles: p is strictly left of every edge, and no vertex starts two. What it
  /// replaces has no vertices inside, which would be lost: it has two triangles fewer than sides.
  bool sees_all(const Complex& complex, const Point& p) const {
    const std::size_t sides = edges_.size() + (split_ == Complex::none ? 0 : 1);
    if (removed_.size() + 2 != sides) return false;
    for (const Edge& e : edges_) {
      if (complex.orientation(facet_, e.source->point(), e.target->point(), p) != CGAL::POSITIVE) return false;
      int starts = 0;
      for (const Edge& f : edges_) starts += f.source == e.source;
      if (starts != 1) return false;
    }
    return true;
  }

  static void join_back(Complex& complex, const Edge& e, std::uint32_t t) {
    auto& n = complex.subfacet(e.outside);
    for (std::size_t j = 0; j < 3; ++j)
      if (n.vertices[(j + 1) % 3] == e.target && n.vertices[(j + 2) % 3] == e.source) n.neighbors[j] = t;
  }

  static std::uint32_t starting_at(const Complex& complex, const std::vector<std::uint32_t>& made,
                                   std::size_t first, Vertex_handle v) {
    for (std::size_t k = first; k < made.size(); ++k)
      if (complex.subfacet(made[k]).vertices[0] == v) return made[k];
    return Complex::none;
  }
  static bool ends_at(const Complex& complex, const std::vector<std::uint32_t>& made, std::size_t first,
                      Vertex_handle v) {
    for (std::size_t k = first; k < made.size(); ++k)
      if (complex.subfacet(made[k]).vertices[1] == v) return true;
    return false;
  }

  static void attach_half(Complex& complex, std::uint32_t t, std::size_t edge, Vertex_handle end,
                          const std::array<std::uint32_t, 2>& halves) {
    for (const std::uint32_t h : halves) {
      if (h == Complex::none) continue;
      const auto& ends = complex.subsegment(h).vertices;
      if (ends[0] != end && ends[1] != end) continue;
      complex.subfacet(t).neighbors[edge] = h | Complex::subsegment_bit;
      complex.subsegment(h).subfacets.push_back(t);
      return;
    }
  }

  static constexpr std::size_t max_region = 100000;

  Territory_3<Tr> territory_;
  bool is_foreign_ = false;
  Index facet_ = 0;
  std::uint32_t split_ = Complex::none;
  std::vector<std::uint32_t> removed_;
  std::vector<Edge> edges_;
};

}  // namespace pgdr

#endif
