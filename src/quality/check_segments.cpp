// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the mesh keeps the vertices and segments of the domain.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <pgdr/domain/vec_3.h>

#include "check_parts.h"

namespace pgdr::quality_detail {

double rounding_distance(const Epick_domain& domain) {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    largest = std::max({largest, std::abs(domain.lower[i]), std::abs(domain.upper[i])});
  return 16 * std::numeric_limits<double>::epsilon() * largest + 1e-12 * domain.diagonal;
}

std::vector<std::uint32_t> match_vertices(const Indexed_mesh_3& mesh, const Epick_domain& domain) {
  std::vector<std::uint32_t> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return mesh.points[a] != mesh.points[b] ? mesh.points[a] < mesh.points[b] : a < b;
  });
  std::vector<std::uint32_t> matched(domain.vertices.size(), none);
  for (std::size_t v = 0; v < matched.size(); ++v) {
    const auto& p = domain.vertices[v];
    const Indexed_mesh_3::Point key{p.x(), p.y(), p.z()};
    const auto it = std::lower_bound(order.begin(), order.end(), key,
                                     [&](std::uint32_t a, const auto& k) { return mesh.points[a] < k; });
    if (it != order.end() && mesh.points[*it] == key) matched[v] = *it;
  }
  return matched;
}

Check_line check_input_vertices(const Indexed_mesh_3& mesh, const Epick_domain& domain,
                                const Expected& expected, const std::vector<std::uint32_t>& matched) {
  Failures failures;
  std::size_t kept = 0;
  std::vector<char> is_input(mesh.points.size(), 0);
  for (std::size_t v = 0; v < matched.size(); ++v) {
    if (matched[v] == none) {
      if (expected.vertices[v])
        failures.add("vertex ", domain.input_vertex[v] + domain.first_index, " of the input, at (",
                     domain.vertices[v], "), is missing");
      continue;
    }
    ++kept;
    is_input[matched[v]] = 1;
    const int marker = v < domain.vertex_markers.size() ? domain.vertex_markers[v] : 0;
    if (mesh.point_references[matched[v]] != marker)
      failures.add("mesh vertex ", matched[v], " has reference ", mesh.point_references[matched[v]],
                   ", its marker is ", marker);
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (!is_input[v] && mesh.point_references[v] != 0)
      failures.add("mesh vertex ", v, " is not of the input, but has reference ", mesh.point_references[v]);
  return failures.line("input vertices", text(kept, " of ", matched.size(), " kept"));
}

namespace {

/// The listed edges at each vertex.
class Edge_graph {
 public:
  explicit Edge_graph(const Indexed_mesh_3& mesh)
      : begin_(mesh.points.size() + 1, 0), edges_(2 * mesh.edges.size()) {
    for (const auto& e : mesh.edges)
      for (const std::uint32_t v : e) ++begin_[v + 1];
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t i = 0; i < mesh.edges.size(); ++i)
      for (const std::uint32_t v : mesh.edges[i]) edges_[next[v]++] = i;
  }
  const std::uint32_t* begin(std::uint32_t v) const { return edges_.data() + begin_[v]; }
  const std::uint32_t* end(std::uint32_t v) const { return edges_.data() + begin_[v + 1]; }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> edges_;
};

}  // namespace

Check_line check_segments(const Indexed_mesh_3& mesh, const Epick_domain& domain, const Expected& expected,
                          const std::vector<std::uint32_t>& matched) {
  Failures failures;
  const Edge_graph graph(mesh);
  const double tolerance = rounding_distance(domain);
  std::vector<char> used(mesh.edges.size(), 0);
  std::size_t covered = 0, wanted = 0;
  double worst = 0;
  for (std::size_t s = 0; s < domain.segments.size(); ++s) {
    if (!expected.segments[s]) continue;
    ++wanted;
    const auto& segment = domain.segments[s];
    std::uint32_t v = matched[segment.vertices[0]];
    const std::uint32_t target = matched[segment.vertices[1]];
    const auto missing = [&](const char* why) {
      failures.add("the segment between input vertices ",
                   domain.input_vertex[segment.vertices[0]] + domain.first_index, " and ",
                   domain.input_vertex[segment.vertices[1]] + domain.first_index, " ", why);
    };
    if (v == none || target == none) {
      missing("lacks an end");
      continue;
    }
    const Vec_3 source = to_vec(mesh.points[v]);
    const double size = length(to_vec(mesh.points[target]) - source);
    const Vec_3 direction = (1 / size) * (to_vec(mesh.points[target]) - source);
    // From the source, always along the unused edge that stays closest to the line and makes progress.
    double position = 0;
    bool whole = true;
    while (v != target && whole) {
      std::uint32_t best = none, next = none;
      double best_distance = tolerance, best_position = 0;
      for (const std::uint32_t* e = graph.begin(v); e != graph.end(v); ++e) {
        if (used[*e]) continue;
        const std::uint32_t w = mesh.edges[*e][mesh.edges[*e][0] == v ? 1 : 0];
        const Vec_3 to = to_vec(mesh.points[w]) - source;
        const double along = dot(to, direction), away = length(to - along * direction);
        if (along <= position || (w != target && along >= size)) continue;
        if (away > best_distance || (away == best_distance && best != none)) continue;
        best = *e, next = w, best_distance = away, best_position = along;
      }
      if (best == none) {
        whole = false;
        break;
      }
      used[best] = 1;
      worst = std::max(worst, best_distance);
      if (mesh.edge_references[best] != segment.marker)
        failures.add("edge ", best, " has reference ", mesh.edge_references[best],
                     ", its segment has marker ", segment.marker);
      v = next;
      position = best_position;
    }
    if (whole)
      ++covered;
    else
      missing(text("is not covered beyond ", position, " of its length ", size).c_str());
  }
  const auto stray = std::count(used.begin(), used.end(), 0);
  if (stray > 0)
    failures.add(stray, " edges belong to no segment, the first is edge ",
                 std::find(used.begin(), used.end(), 0) - used.begin());
  return failures.line("segments", text(covered, " of ", wanted, " covered by ", mesh.edges.size(),
                                        " edges, farthest vertex at ", worst));
}

}  // namespace pgdr::quality_detail
