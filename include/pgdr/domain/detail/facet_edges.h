// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_FACET_EDGES_H
#define PGDR_DOMAIN_DETAIL_FACET_EDGES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/domain_3.h>

namespace pgdr::domain_detail {

/// A facet's triangle that has a segment as its edge.
struct Sheet {
  Index segment = 0;
  Index facet = 0;
  Index triangle = 0;    ///< position in `Facet::triangles`
  bool forward = false;  ///< the triangle runs along the segment from its smaller vertex to its larger one
};

/// The direction in which a sheet leaves its segment, which runs along `axis` from its smaller vertex to its larger one; in the
/// plane of the facet rather than of its triangle, which may be a needle. As long as the axis.
template <class K>
Vec_3 inward(const Domain_3<K>& domain, const Sheet& sheet, const Vec_3& axis) {
  return (sheet.forward ? 1.0 : -1.0) * cross(to_vec(domain.facets[sheet.facet].normal), axis);
}

/// The angle of a facet between two consecutive segments at a vertex.
struct Facet_corner {
  Index facet = 0;
  Index vertex = 0;
  std::array<Index, 2> others{};  ///< the other ends of the segments
  double angle_deg = 0;
};

/// Lists of values per key, in the order of insertion.
template <class Value>
class Grouped {
 public:
  Grouped() = default;
  Grouped(std::size_t keys, const std::vector<std::pair<Index, Value>>& entries) : start_(keys + 1, 0) {
    for (const auto& e : entries) ++start_[e.first + 1];
    for (std::size_t i = 0; i < keys; ++i) start_[i + 1] += start_[i];
    values_.resize(entries.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (const auto& e : entries) values_[next[e.first]++] = e.second;
  }
  std::span<const Value> operator[](std::size_t key) const {
    return {values_.data() + start_[key], start_[key + 1] - start_[key]};
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<Value> values_;
};

/// Which triangles of facets meet at which segments.
class Facet_edges {
 public:
  template <class K>
  explicit Facet_edges(const Domain_3<K>& domain) {
    std::vector<std::pair<Index, Sheet>> sheets;
    std::vector<std::pair<std::array<Index, 2>, Index>> own;
    for (Index f = 0; f < domain.facets.size(); ++f) {
      const auto& facet = domain.facets[f];
      own.clear();
      for (Index s : facet.segments) own.push_back({domain.segments[s].vertices, s});
      std::sort(own.begin(), own.end());
      for (Index t = 0; t < facet.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
          const Index a = facet.triangles[t][i], b = facet.triangles[t][(i + 1) % 3];
          const std::pair<std::array<Index, 2>, Index> key{{std::min(a, b), std::max(a, b)}, 0};
          const auto found = std::lower_bound(own.begin(), own.end(), key);
          const bool segment = found != own.end() && found->first == key.first;
          if (segment) sheets.push_back({found->second, {found->second, f, t, a < b}});
          wedges_.push_back({f, facet.triangles[t][i], b, facet.triangles[t][(i + 2) % 3], segment});
        }
    }
    sheets_ = Grouped<Sheet>(domain.segments.size(), sheets);
  }

  /// The sheets at a segment, by facet.
  std::span<const Sheet> sheets(std::size_t segment) const { return sheets_[segment]; }

  /// All corners between two segments that follow each other around a vertex inside one facet.
  std::vector<Facet_corner> corners(const std::vector<Vec_3>& points) const {
    std::vector<Facet_corner> result;
    // Wedges of one facet are consecutive: three per triangle.
    for (std::size_t begin = 0; begin < wedges_.size();) {
      std::size_t end = begin;
      while (end < wedges_.size() && wedges_[end].facet == wedges_[begin].facet) ++end;
      std::vector<Wedge> by_side(wedges_.begin() + static_cast<std::ptrdiff_t>(begin),
                                 wedges_.begin() + static_cast<std::ptrdiff_t>(end));
      const auto less = [](const Wedge& a, const Wedge& b) {
        return a.vertex < b.vertex || (a.vertex == b.vertex && a.from < b.from);
      };
      std::sort(by_side.begin(), by_side.end(), less);
      for (const Wedge& first : by_side) {
        if (!first.from_segment) continue;
        double angle = 0;
        for (Wedge w = first;;) {
          angle += angle_deg(points[w.from] - points[w.vertex], points[w.to] - points[w.vertex]);
          const Wedge key{w.facet, w.vertex, w.to, 0, false};
          const auto next = std::lower_bound(by_side.begin(), by_side.end(), key, less);
          const bool more = next != by_side.end() && next->vertex == w.vertex && next->from == w.to;
          if (!more || next->from_segment) {
            // An internal segment that ends here has no neighbour: the angle is the whole turn.
            if (w.to != first.from) result.push_back({w.facet, w.vertex, {first.from, w.to}, angle});
            break;
          }
          w = *next;
        }
      }
      begin = end;
    }
    return result;
  }

 private:
  /// A triangle's angle at `vertex`, counterclockwise from one neighbour to the other.
  struct Wedge {
    Index facet, vertex, from, to;
    bool from_segment;  ///< vertex-from is a segment
  };

  Grouped<Sheet> sheets_;
  std::vector<Wedge> wedges_;
};

/// Which segments and facet triangles meet at which vertices.
class Vertex_features {
 public:
  template <class K>
  explicit Vertex_features(const Domain_3<K>& domain) {
    std::vector<std::pair<Index, Index>> segments;
    for (Index s = 0; s < domain.segments.size(); ++s)
      for (Index v : domain.segments[s].vertices) segments.push_back({v, s});
    std::vector<std::pair<Index, std::pair<Index, Index>>> triangles;
    for (Index f = 0; f < domain.facets.size(); ++f)
      for (Index t = 0; t < domain.facets[f].triangles.size(); ++t)
        for (Index v : domain.facets[f].triangles[t]) triangles.push_back({v, {f, t}});
    segments_ = Grouped<Index>(domain.vertices.size(), segments);
    triangles_ = Grouped<std::pair<Index, Index>>(domain.vertices.size(), triangles);
  }
  std::span<const Index> segments(std::size_t vertex) const { return segments_[vertex]; }
  /// Facet and position in its `triangles`.
  std::span<const std::pair<Index, Index>> triangles(std::size_t vertex) const { return triangles_[vertex]; }

 private:
  Grouped<Index> segments_;
  Grouped<std::pair<Index, Index>> triangles_;
};

}  // namespace pgdr::domain_detail

#endif
