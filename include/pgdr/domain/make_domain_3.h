// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_MAKE_DOMAIN_3_H
#define PGDR_DOMAIN_MAKE_DOMAIN_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/detail/facet_pieces.h>
#include <pgdr/domain/detail/fuse_facets.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/input_error.h>
#include <pgdr/domain/plc.h>
#include <pgdr/domain/scale.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_sort.h>

namespace pgdr {

namespace domain_detail {

/// Coordinates and indices that nothing further can work with.
template <class K>
std::vector<Input_problem> unusable_input(const Piecewise_linear_complex_3<K>& plc) {
  using Kind = Input_problem::Kind;
  std::vector<Input_problem> problems;
  const auto finite = [](const auto& p) {
    const Vec_3 v = to_vec(p);
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  const auto number = [&](std::size_t i) { return std::to_string(i + plc.first_index); };
  for (std::size_t i = 0; i < plc.vertices.size(); ++i)
    if (!finite(plc.vertices[i]))
      problems.push_back({Kind::bad_coordinate,
                          "vertex " + number(i) + " has a coordinate that is not finite",
                          {},
                          {static_cast<Index>(i)}});
    // Sizes and angles are measured in double precision, and points that round alike are taken for one.
    else if (const Vec_3 p = to_vec(plc.vertices[i]); plc.vertices[i] != typename K::Point_3(p.x, p.y, p.z))
      problems.push_back({Kind::bad_coordinate,
                          "vertex " + number(i) + " has a coordinate that is not a number of double precision",
                          {},
                          {static_cast<Index>(i)}});
  for (std::size_t i = 0; i < plc.holes.size(); ++i)
    if (!finite(plc.holes[i]))
      problems.push_back({Kind::bad_coordinate,
                          "hole seed " + std::to_string(i + 1) + " has a coordinate that is not finite"});
  for (std::size_t i = 0; i < plc.regions.size(); ++i)
    if (!finite(plc.regions[i].point))
      problems.push_back({Kind::bad_coordinate,
                          "region seed " + std::to_string(i + 1) + " has a coordinate that is not finite"});
  for (std::size_t f = 0; f < plc.facets.size(); ++f) {
    const Index facet = static_cast<Index>(f);
    for (const auto& hole : plc.facets[f].holes)
      if (!finite(hole)) {
        problems.push_back({Kind::bad_coordinate,
                            "a hole seed of facet " + number(f) + " has a coordinate that is not finite",
                            {facet}});
        break;
      }
    for (const auto& polygon : plc.facets[f].polygons) {
      const auto bad =
          std::find_if(polygon.begin(), polygon.end(), [&](Index v) { return v >= plc.vertices.size(); });
      if (bad == polygon.end()) continue;
      problems.push_back({Kind::bad_index,
                          "facet " + number(f) + " names vertex " +
                              std::to_string(std::size_t{*bad} + plc.first_index) + ", which does not exist",
                          {facet}});
      break;
    }
  }
  for (std::size_t s = 0; s < plc.segments.size(); ++s)
    for (Index v : {plc.segments[s].source, plc.segments[s].target})
      if (v >= plc.vertices.size())
        problems.push_back({Kind::bad_index, "segment " + number(s) + " names vertex " +
                                                 std::to_string(std::size_t{v} + plc.first_index) +
                                                 ", which does not exist"});
  return problems;
}

/// For each input vertex, the first one with the same coordinates; those in `skipped` stand for themselves.
inline std::vector<Index> first_equal_vertex(const std::vector<Vec_3>& points,
                                             const std::vector<char>& skipped) {
  const auto key = [&](Index i) { return to_array(points[i]); };  // -0.0 equals 0.0
  std::vector<Index> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!skipped[i]) order.push_back(static_cast<Index>(i));
  parallel_sort(order.begin(), order.end(), [&](Index a, Index b) { return key(a) < key(b) || (key(a) == key(b) && a < b); });
  std::vector<Index> first(points.size());
  std::iota(first.begin(), first.end(), Index{0});
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1])) first[order[i]] = first[order[i - 1]];
  return first;
}

/// The facet's polygons over merged vertices, repeated corners left out.
template <class K>
Facet_polygons merged_polygons(const Plc_facet<K>& facet, const std::vector<Index>& merged) {
  Facet_polygons result;
  for (const std::vector<Index>& polygon : facet.polygons) {
    std::vector<Index> loop;
    for (Index v : polygon) {
      result.used.push_back(merged[v]);
      if (loop.empty() || loop.back() != merged[v]) loop.push_back(merged[v]);
    }
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    ++result.polygons;
    if (polygon.size() >= 3) {
      std::vector<Index> distinct = loop;
      sort_unique(distinct);
      result.collapsed = result.collapsed || distinct.size() < 3;
      result.loops.push_back(std::move(loop));
    } else if (loop.size() == 2) {
      result.segments.push_back(sorted_pair(loop[0], loop[1]));
    }
  }
  sort_unique(result.used);
  for (const auto& hole : facet.holes) result.holes.push_back(to_work_point(to_vec(hole)));
  return result;
}

/// The explicit segments (sorted) between vertices (ascending) of one facet.
inline std::vector<Explicit_segment> segments_among(const std::vector<Index>& used, const std::vector<Explicit_segment>& segments) {
  std::vector<Explicit_segment> result;
  if (segments.empty()) return result;
  for (const Index v : used)
    for (auto s = std::lower_bound(segments.begin(), segments.end(), Explicit_segment{{v, 0}, 0}); s != segments.end() && s->ends[0] == v; ++s)
      if (std::ranges::binary_search(used, s->ends[1])) result.push_back(*s);
  return result;
}

}  // namespace domain_detail

/// Understands a PLC: merges exact duplicates, fuses adjacent coplanar facets, finds the segments and
/// triangulates every fused facet.
///
/// Adjacent facets are fused when they have the same marker and group, no explicit segment between them, and every
/// vertex within the tolerance of the plane of the group's largest facet. Otherwise input stays as it is:
/// every input vertex remains (isolated ones too), collinear segments are not joined. The orientation of
/// facets does not matter.
/// \param relative_tolerance distance from a plane that counts as none, relative to the bounding box's
///   diagonal; never less than 16 ulp of the largest coordinate.
/// \param triangulate accept facets that are not planar as triangles.
/// \throws Input_error with every problem of these kinds, found in one pass: `bad_coordinate`, `bad_index`,
///   `degenerate_facet`, `non_planar_facet`, and `self_intersection` within one facet. What other facets and
///   volumes may have wrong is up to `validate_domain_3`.
template <class K>
Domain_3<K> make_domain_3(const Piecewise_linear_complex_3<K>& plc, double relative_tolerance = 1e-6,
                          bool triangulate = false) {
  using namespace domain_detail;
  if (exponent_for(plc) != 0) return make_domain_3(normalized(plc), relative_tolerance, triangulate);
  std::vector<Input_problem> problems = unusable_input(plc);
  std::vector<Vec_3> input_points;
  std::vector<char> unusable(plc.vertices.size(), 0);
  input_points.reserve(plc.vertices.size());
  for (const auto& p : plc.vertices) input_points.push_back(to_vec(p));
  for (const Input_problem& p : problems)
    for (Index v : p.vertices) unusable[v] = 1;

  Domain_3<K> domain;
  domain.nesting = plc.nesting;
  domain.holes = plc.holes;
  domain.regions = plc.regions;
  domain.exponent = plc.exponent;
  domain.first_index = plc.first_index;
  domain.names = plc.names;

  // Vertices.
  const std::vector<Index> first = first_equal_vertex(input_points, unusable);
  std::vector<Index> merged(first.size());
  std::vector<Vec_3> points;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const int marker = i < plc.vertex_markers.size() ? plc.vertex_markers[i] : 0;
    if (first[i] != i) {
      merged[i] = merged[first[i]];
      if (domain.vertex_markers[merged[i]] == 0) domain.vertex_markers[merged[i]] = marker;
      ++domain.duplicate_vertices;
      continue;
    }
    merged[i] = static_cast<Index>(points.size());
    points.push_back(input_points[i]);
    domain.vertices.push_back(plc.vertices[i]);
    domain.vertex_markers.push_back(marker);
    domain.input_vertex.push_back(static_cast<Index>(i));
  }
  double largest = 0;
  bool any = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (unusable[domain.input_vertex[i]]) continue;
    const std::array<double, 3> p = to_array(points[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      domain.lower[k] = any ? std::min(domain.lower[k], p[k]) : p[k];
      domain.upper[k] = any ? std::max(domain.upper[k], p[k]) : p[k];
      largest = std::max(largest, std::abs(p[k]));
    }
    any = true;
  }
  domain.diagonal = length(to_vec(domain.upper) - to_vec(domain.lower));
  const double ulp = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  domain.tolerance = std::max(relative_tolerance * domain.diagonal, 16 * ulp);

  // Input facets.
  std::vector<Explicit_segment> segments;
  for (const Plc_segment& s : plc.segments) {
    if (s.source >= merged.size() || s.target >= merged.size()) continue;
    const Index_pair ends = sorted_pair(merged[s.source], merged[s.target]);
    if (ends[0] != ends[1]) segments.push_back({ends, s.marker});
  }
  // Also those named by a facet's two-vertex polygons: they may lie inside other facets.
  for (const auto& f : plc.facets)
    for (const auto& p : f.polygons)
      if (p.size() == 2 && p[0] < merged.size() && p[1] < merged.size() && merged[p[0]] != merged[p[1]])
        segments.push_back({sorted_pair(merged[p[0]], merged[p[1]]), 0});
  std::sort(segments.begin(), segments.end());
  std::vector<Facet_reader> readers(chunk_count(plc.facets.size(), default_grain), Facet_reader(points, domain.tolerance, triangulate, plc.first_index));
  parallel_for_chunks(plc.facets.size(), default_grain, [&](std::size_t begin, std::size_t end) {
    Facet_reader& chunk = readers[begin / default_grain];
    chunk.pieces.reserve(end - begin);
    for (std::size_t f = begin; f < end; ++f) {
      const auto& facet = plc.facets[f];
      if (std::ranges::any_of(facet.polygons, [&](const auto& polygon) { return std::ranges::any_of(polygon, [&](Index v) { return v >= merged.size() || unusable[v]; }); })) continue;
      const Facet_polygons polygons = merged_polygons(facet, merged);
      const bool is_triangle = polygons.used.size() <= 3;
      chunk.read(static_cast<Index>(f), facet.marker, polygons, is_triangle ? std::vector<Explicit_segment>{} : segments_among(polygons.used, segments));
    }
  });
  Facet_reader reader(points, domain.tolerance, triangulate, plc.first_index);
  reader.pieces.reserve(plc.facets.size());
  for (Facet_reader& chunk : readers) reader.append(std::move(chunk));
  problems.insert(problems.end(), reader.problems.begin(), reader.problems.end());
  if (!problems.empty()) throw Input_error(std::move(problems));
  for (Facet_piece& piece : reader.pieces) piece.group = plc.facets[piece.input_facet].group;

  // Fused facets.
  sort_unique(reader.replaced);
  std::erase_if(segments, [&](const Explicit_segment& s) { return contains(reader.replaced, s.ends); });
  segments.insert(segments.end(), reader.segments.begin(), reader.segments.end());
  std::sort(segments.begin(), segments.end());
  segments.erase(
      std::unique(segments.begin(), segments.end(),
                  [](const Explicit_segment& a, const Explicit_segment& b) { return a.ends == b.ends; }),
      segments.end());
  std::vector<Facet_group> groups =
      Facet_fuser(points, reader.pieces, segments, domain.tolerance).fuse();

  std::vector<Index_pair> all;
  for (const Explicit_segment& s : segments) all.push_back(s.ends);
  for (const Facet_group& g : groups) all.insert(all.end(), g.segments.begin(), g.segments.end());
  parallel_sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  domain.segments.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) domain.segments[i].vertices = all[i];
  const auto segment_index = [&](const Index_pair& ends) {
    return static_cast<Index>(std::lower_bound(all.begin(), all.end(), ends) - all.begin());
  };
  for (const Explicit_segment& s : segments) domain.segments[segment_index(s.ends)].marker = s.marker;

  domain.facets.resize(groups.size());
  parallel_for_chunks(groups.size(), default_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Facet_group& g = groups[i];
      auto& facet = domain.facets[i];
      facet.marker = reader.pieces[g.pieces[0]].marker;
      facet.origin = to_array(g.plane.origin);
      facet.normal = to_array(g.plane.normal);
      for (const Index p : g.pieces) facet.input_facets.push_back(reader.pieces[p].input_facet);
      sort_unique(facet.input_facets);
      facet.triangles = std::move(g.triangles);
      for (const auto& t : facet.triangles) facet.vertices.insert(facet.vertices.end(), t.begin(), t.end());
      sort_unique(facet.vertices);
      for (const Index_pair& ends : g.segments) facet.segments.push_back(segment_index(ends));
    }
  });
  for (Index f = 0; f < domain.facets.size(); ++f)
    for (const Index s : domain.facets[f].segments) domain.segments[s].facets.push_back(f);
  return domain;
}

// Compiled in the library.
extern template Domain_3<Default_kernel> make_domain_3(const Plc&, double, bool);
}  // namespace pgdr

#endif
