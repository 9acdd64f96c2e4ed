// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_VALIDATE_DOMAIN_3_H
#define PGDR_DOMAIN_VALIDATE_DOMAIN_3_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/detail/facet_edges.h>
#include <pgdr/domain/detail/intersecting_triangles.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/input_error.h>
#include <pgdr/domain/scale.h>
#include <pgdr/domain/volumes_3.h>

namespace pgdr {

namespace domain_detail {

/// Writes problems in the numbering of the input file.
template <class K>
class Problem_writer {
 public:
  explicit Problem_writer(const Domain_3<K>& domain) : domain_(domain) {}

  Index input_facet(Index facet) const { return domain_.facets[facet].input_facets.front(); }
  std::string facet_name(Index facet) const { return "facet " + facet_number(facet); }
  std::string facet_number(Index facet) const {
    return std::to_string(input_facet(facet) + domain_.first_index);
  }
  std::string vertex_number(Index vertex) const {
    return std::to_string(domain_.input_vertex[vertex] + domain_.first_index);
  }
  std::string vertex_name(Index vertex) const {
    return "vertex " + vertex_number(vertex) + " " + point(domain_.vertices[vertex]);
  }
  std::string segment_name(const std::array<Index, 2>& s) const {
    return "the segment between vertices " + vertex_number(s[0]) + " and " + vertex_number(s[1]);
  }
  template <class Point>
  std::string point(const Point& p) const {
    const Vec_3 v = unit_of(domain_) * to_vec(p);
    char text[96];
    std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g)", v.x, v.y, v.z);
    return text;
  }

 private:
  const Domain_3<K>& domain_;
};

template <class K>
void report_intersections(const Domain_3<K>& domain, std::size_t max_pairs,
                          std::vector<Input_problem>& problems) {
  const Triangle_soup soup(domain);
  const Intersection_finder finder(soup);
  const Problem_writer<K> write(domain);
  const auto kind = Input_problem::Kind::self_intersection;
  std::vector<Input_problem> found;

  constexpr std::size_t most_places = 100;  // an exact intersection takes milliseconds, and scans have 50,000
  std::map<std::array<Index, 2>, Id_pair> triangles_of_facets;  // the first two that meet
  for (const Id_pair& p : finder.triangles()) {
    const Index f = write.input_facet(soup.facet[p[0]]), g = write.input_facet(soup.facet[p[1]]);
    triangles_of_facets.insert({{std::min(f, g), std::max(f, g)}, p});
  }
  for (const auto& [facets, triangles] : triangles_of_facets) {
    std::string message = "facets " + std::to_string(facets[0] + domain.first_index) + " and " +
                          std::to_string(facets[1] + domain.first_index);
    const auto& one = domain.facets[soup.facet[triangles[0]]];
    const auto& other = domain.facets[soup.facet[triangles[1]]];
    const bool are_identical = one.vertices == other.vertices && one.segments == other.segments;
    message += are_identical ? " are identical" : " intersect";
    if (!are_identical && found.size() < std::min(max_pairs, most_places)) message += " at " + write.point(finder.common_point(triangles[0], triangles[1]));
    found.push_back({kind, message, {facets[0], facets[1]}, {}});
  }

  // Segments of facets are edges of their triangles; only the others need a look of their own.
  std::vector<std::array<Index, 2>> loose;
  std::vector<char> used(domain.vertices.size(), 0);
  for (const auto& s : domain.segments) {
    if (s.facets.empty()) loose.push_back(s.vertices);
    for (Index v : s.vertices) used[v] = 1;
  }
  for (const auto& f : domain.facets)
    for (Index v : f.vertices) used[v] = 1;
  const auto inputs = [&](const std::array<Index, 2>& s) {
    return std::vector<Index>{domain.input_vertex[s[0]], domain.input_vertex[s[1]]};
  };
  if (!loose.empty()) {
    for (const Id_pair& p : finder.segments_and_triangles(loose))
      found.push_back({kind,
                       write.segment_name(loose[p[0]]) + " intersects " + write.facet_name(soup.facet[p[1]]),
                       {write.input_facet(soup.facet[p[1]])},
                       inputs(loose[p[0]])});
    for (const Id_pair& p : finder.segments(loose))
      found.push_back({kind,
                       write.segment_name(loose[p[0]]) + " intersects " + write.segment_name(loose[p[1]]),
                       {},
                       inputs(loose[p[0]])});
  }
  std::vector<Index> isolated;
  for (Index v = 0; v < used.size(); ++v)
    if (!used[v]) isolated.push_back(v);
  if (!isolated.empty())
    for (const Id_pair& p : finder.vertices_and_triangles(isolated)) {
      const Index v = static_cast<Index>(p[0]);
      found.push_back({kind,
                       write.vertex_name(v) + " lies on " + write.facet_name(soup.facet[p[1]]) +
                           ", which does not name it",
                       {write.input_facet(soup.facet[p[1]])},
                       {domain.input_vertex[v]}});
    }
  found.erase(std::unique(found.begin(), found.end(),
                          [](const auto& a, const auto& b) { return a.message == b.message; }),
              found.end());

  const std::size_t total = found.size();
  if (total > max_pairs) found.resize(max_pairs);
  if (total > max_pairs && !found.empty())
    found.back().message += " (the last one shown; " + std::to_string(total) + " pairs in all)";
  else if (total > 1)
    found.back().message += " (" + std::to_string(total) + " pairs in all)";
  problems.insert(problems.end(), found.begin(), found.end());
}

/// Every edge with a facet on one side only, `most` of them at most, where the facets enclose nothing.
template <class K>
void report_open_edges(const Domain_3<K>& domain, std::size_t most, std::vector<Input_problem>& problems) {
  const Problem_writer<K> write(domain);
  const Facet_edges edges(domain);
  std::size_t found = 0;
  for (std::size_t s = 0; s < domain.segments.size(); ++s) {
    if (edges.sheets(s).size() != 1 || ++found > most) continue;
    const auto [a, b] = domain.segments[s].vertices;
    const Index facet = edges.sheets(s)[0].facet;
    problems.push_back({Input_problem::Kind::open_surface,
                        std::string(found == 1 ? "the facets enclose no volume: " : "") + "the edge from " +
                            write.vertex_name(a) + " to " + write.vertex_name(b) + " belongs to one facet only, " +
                            write.facet_name(facet),
                        {write.input_facet(facet)},
                        {domain.input_vertex[a], domain.input_vertex[b]}});
  }
  if (found == 0) problems.push_back({Input_problem::Kind::open_surface, "the facets enclose no volume"});
  if (found > 1) problems.back().message += " (" + std::to_string(found) + " such edges in all)";
}

/// Names what a point on a facet lies on: a vertex, a segment, or just the facet.
template <class K>
std::string feature_at(const Domain_3<K>& domain, Index facet, const typename K::Point_3& p) {
  const Problem_writer<K> write(domain);
  const auto& f = domain.facets[facet];
  for (const Index v : f.vertices)
    if (domain.vertices[v] == p) return write.vertex_name(v);
  for (const Index s : f.segments) {
    const auto& ends = domain.segments[s].vertices;
    if (typename K::Segment_3(domain.vertices[ends[0]], domain.vertices[ends[1]]).has_on(p)) return write.segment_name(ends);
  }
  return write.facet_name(facet);
}

/// What the volumes have wrong; only meaningful where nothing intersects.
template <class K>
void report_volumes(const Domain_3<K>& domain, const Volumes_3<K>& volumes, std::size_t most,
                    std::vector<Input_problem>& problems) {
  using Kind = Input_problem::Kind;
  if (!volumes.closed()) {
    report_open_edges(domain, most, problems);
    return;
  }
  const Problem_writer<K> write(domain);
  const auto lost = [&](const char* what, const auto& seed, const auto& point) {
    const std::string name = what + std::to_string(seed.seed + 1) + " at " + write.point(point);
    if (seed.facet == Volumes_3<K>::none) {
      problems.push_back({Kind::bad_seed, name + " lies in no enclosed volume and is left out"});
      return;
    }
    const auto facet = static_cast<Index>(seed.facet);
    problems.push_back({Kind::ambiguous_seed,
                        name + " lies on " + feature_at(domain, facet, point) + ", so that it names no volume",
                        {write.input_facet(facet)},
                        {}});
  };
  for (const auto& seed : volumes.lost_holes()) lost("hole seed ", seed, domain.holes[seed.seed]);
  for (const auto& seed : volumes.lost_regions()) lost("region seed ", seed, domain.regions[seed.seed].point);
  for (const auto& seed : volumes.overruled_regions())
    problems.push_back({Kind::bad_seed, "region seed " + std::to_string(seed.seed + 1) + " at " + write.point(domain.regions[seed.seed].point) + " lies in the volume of " +
                                            (seed.by_hole ? "hole" : "region") + " seed " + std::to_string(seed.by + 1) + " and is left out"});
  if (std::none_of(volumes.volumes().begin(), volumes.volumes().end(),
                   [](const Volume& v) { return v.material; }))
    problems.push_back({Kind::empty, "every enclosed volume is a hole, so that nothing is left to mesh"});
}

}  // namespace domain_detail

/// Looks for what makes a domain impossible to mesh.
///
/// `self_intersection`: facets, segments or vertices that meet other than in common vertices and segments;
/// `open_surface`: no volume is enclosed; `empty`: no facets, or no material; `ambiguous_seed`: a hole or region seed on a
/// facet; `bad_seed`: one outside of every enclosed volume, which is only a warning: it is left out. Volumes are judged only where nothing intersects. Facets go by the
/// number of the first input facet that they were fused from.
/// \param max_pairs number of intersecting pairs, or of open edges, to name; the last one's message gives the total. Of the first hundred pairs
/// the message says where.
template <class K>
std::vector<Input_problem> validate_domain_3(const Domain_3<K>& domain, std::size_t max_pairs = 10) {
  using namespace domain_detail;
  std::vector<Input_problem> problems;
  if (domain.facets.empty()) {
    problems.push_back({Input_problem::Kind::empty, "the input has no facets"});
    return problems;
  }
  report_intersections(domain, max_pairs, problems);
  if (problems.empty()) report_volumes(domain, Volumes_3<K>(domain), max_pairs, problems);
  return problems;
}

// Compiled in the library.
extern template std::vector<Input_problem> validate_domain_3(const Domain_3<Default_kernel>&, std::size_t);
}  // namespace pgdr

#endif
