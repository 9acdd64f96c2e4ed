// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_INITIAL_COMPLEX_3_H
#define PGDR_CONFORMING_INITIAL_COMPLEX_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/reproducible_functions.h>

namespace pgdr {

/// Whether the domain's own boundary is its bounding box: six axis-aligned sides, each covered by facets. Exactly: of a side that is
/// bent or tilted by no more than rounding, the hull would be whatever points lie farthest out.
template <class K>
bool is_box(const Domain_3<K>& domain) {
  double covered[3][2] = {};
  Vec_3 size;
  for (int i = 0; i < 3; ++i)
    size[i] = domain.upper[static_cast<std::size_t>(i)] - domain.lower[static_cast<std::size_t>(i)];
  for (const auto& f : domain.facets)
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const bool low = f.origin[k] == domain.lower[k], high = f.origin[k] == domain.upper[k];
      if (!low && !high) continue;
      for (const auto& t : f.triangles) {
        if (std::ranges::any_of(t, [&](auto v) { return to_vec(domain.vertices[v])[i] != f.origin[k]; })) continue;
        const Vec_3 a = to_vec(domain.vertices[t[0]]);
        covered[i][high] +=
            0.5 * length(cross(to_vec(domain.vertices[t[1]]) - a, to_vec(domain.vertices[t[2]]) - a));
      }
    }
  for (int i = 0; i < 3; ++i) {
    const double area = size[(i + 1) % 3] * size[(i + 2) % 3];
    for (const double c : covered[i])
      if (std::abs(c - area) > 1e-9 * area) return false;
  }
  return true;
}

/// Inserts the domain's vertices, inside a box whose faces are between half of the diagonal and twice of it away,
/// unless the domain is a box itself: the hull of the triangulation is always axis-aligned. Farther away, more would
/// have to be refined outside for leaves of the same size. Returns the handle of every domain vertex.
template <class Tr, class K>
std::vector<typename Tr::Vertex_handle> insert_domain_vertices(Tr& tr, const Domain_3<K>& domain) {
  using Point = typename Tr::Point;
  typename Tr::Vertex_handle last;
  if (!is_box(domain)) {
    // Rounded to few bits, so that the box's coordinates are exact in all that is computed from them.
    const double margin = ceil_power_of_two(domain.diagonal) / 2;
    std::array<double, 3> lo, hi;
    for (std::size_t i = 0; i < 3; ++i) {
      lo[i] = std::floor((domain.lower[i] - margin) / margin) * margin;
      hi[i] = std::ceil((domain.upper[i] + margin) / margin) * margin;
    }
    for (int k = 0; k < 8; ++k) {
      last = tr.insert(Point(k & 1 ? hi[0] : lo[0], k & 2 ? hi[1] : lo[1], k & 4 ? hi[2] : lo[2]));
      last->set_feature(4, Tr::Vertex::none);
    }
  }
  std::vector<std::size_t> order(domain.vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  auto points = CGAL::make_property_map(domain.vertices);
  CGAL::spatial_sort(order.begin(), order.end(),
                     CGAL::Spatial_sort_traits_adapter_3<typename Tr::Geom_traits, decltype(points)>(points));
  std::vector<typename Tr::Vertex_handle> handles(order.size());
  for (const std::size_t i : order) {
    last = last == typename Tr::Vertex_handle() ? tr.insert(domain.vertices[i])
                                                : tr.insert(domain.vertices[i], last->cell());
    last->set_feature(0, static_cast<std::uint32_t>(i));
    handles[i] = last;
  }
  return handles;
}

/// A vertex on the convex hull: the lexicographically smallest one.
template <class Tr>
typename Tr::Vertex_handle corner_of_hull(const Tr& tr) {
  typename Tr::Vertex_handle corner;
  for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v)
    if (corner == typename Tr::Vertex_handle() || v->point() < corner->point()) corner = v;
  return corner;
}

/// Fills a complex with the domain's segments and facets, none of them marked present.
template <class Tr>
void build_complex(Constraint_complex_3<Tr>& complex, typename Constraint_complex_3<Tr>::Pool& pool,
                   const std::vector<typename Tr::Vertex_handle>& handles) {
  using Complex = Constraint_complex_3<Tr>;
  using Key = std::array<Index, 2>;
  const auto key = [](Index a, Index b) { return a < b ? Key{a, b} : Key{b, a}; };
  const auto& domain = complex.domain();

  std::vector<std::pair<Key, std::uint32_t>> segments;
  for (Index s = 0; s < domain.segments.size(); ++s) {
    const auto& v = domain.segments[s].vertices;
    segments.emplace_back(key(v[0], v[1]), complex.add_subsegment(pool, handles[v[0]], handles[v[1]], s));
  }
  std::sort(segments.begin(), segments.end());

  struct Side {
    Key key;
    std::uint32_t slot;
    std::uint32_t edge;
    bool operator<(const Side& o) const {
      return std::tie(key, slot, edge) < std::tie(o.key, o.slot, o.edge);
    }
  };
  std::vector<Side> sides;
  for (Index f = 0; f < domain.facets.size(); ++f) {
    sides.clear();
    for (const auto& t : domain.facets[f].triangles) {
      const std::uint32_t slot = complex.add_subfacet(pool, handles[t[0]], handles[t[1]], handles[t[2]], f);
      for (std::uint32_t i = 0; i < 3; ++i) {
        const Key k = key(t[(i + 1) % 3], t[(i + 2) % 3]);
        const auto at = std::lower_bound(segments.begin(), segments.end(), std::make_pair(k, 0u));
        if (at != segments.end() && at->first == k) {
          complex.subfacet(slot).neighbors[i] = at->second | Complex::subsegment_bit;
          complex.subsegment(at->second).subfacets.push_back(slot);
        } else {
          sides.push_back({k, slot, i});
        }
      }
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 0; i < sides.size(); i += 2) {
      if (i + 1 == sides.size() || sides[i].key != sides[i + 1].key)
        throw std::logic_error("a facet ends at an edge that is no segment");
      complex.subfacet(sides[i].slot).neighbors[sides[i].edge] = sides[i + 1].slot;
      complex.subfacet(sides[i + 1].slot).neighbors[sides[i + 1].edge] = sides[i].slot;
    }
  }
}

}  // namespace pgdr

#endif
