// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the triangles of the mesh cover the facets of the domain, each once.
#include <algorithm>
#include <cmath>

#include <pgdr/domain/vec_3.h>
#include <pgdr/quality/compensated_sum.h>

#include "check_parts.h"
#include "facet_patches.h"

namespace pgdr::quality_detail {

namespace {

/// Twice the signed area of the projection on the plane with unit normal `n`.
double twice_projected_area(const Vec_3& a, const Vec_3& b, const Vec_3& c, const Vec_3& n) {
  return dot(n, cross(b - a, c - a));
}

struct Coverage {
  Compensated_sum wanted, covered, unclear;  ///< areas; `unclear`: of triangles too thin to tell which side is seen
  double perimeter = 0;
  double thickness =
      0;  ///< greatest distance of a vertex of the facet or of its mesh triangles from the plane
};

/// A triangle of the mesh as seen from the tip of its facet's normal.
struct Projected {
  bool counterclockwise = true;
  bool clear = false;  ///< larger than the facet is thick, so that `counterclockwise` means something
};

bool runs_forward(const std::array<std::uint32_t, 3>& t, std::uint32_t from, std::uint32_t to) {
  for (std::size_t i = 0; i < 3; ++i)
    if (t[i] == from && t[(i + 1) % 3] == to) return true;
  return false;
}

/// In a facet an edge inside is shared by two triangles on its two sides, and one on the rim is listed.
void check_sheet(const Indexed_mesh_3& mesh, const std::vector<Triangle_edge>& edges,
                 const std::vector<std::uint32_t>& facet, const std::vector<Projected>& projected,
                 Failures& failures) {
  std::vector<Triangle_edge> group;
  for (std::size_t i = 0; i < edges.size();) {
    group.clear();
    std::size_t j = i;
    for (; j < edges.size() && edges[j].same_edge(edges[i]); ++j)
      if (facet[edges[j].triangle] != none) group.push_back(edges[j]);
    std::stable_sort(group.begin(), group.end(), [&](const Triangle_edge& a, const Triangle_edge& b) {
      return facet[a.triangle] < facet[b.triangle];
    });
    for (std::size_t k = 0; k < group.size();) {
      std::size_t n = 1;
      while (k + n < group.size() && facet[group[k + n].triangle] == facet[group[k].triangle]) ++n;
      const auto& e = group[k];
      if (n > 2) {
        failures.add(n, " triangles of facet ", facet[e.triangle], " meet at the edge (", e.first, ", ",
                     e.second, ")");
      } else if (n == 1) {
        if (!e.listed)
          failures.add("facet ", facet[e.triangle], " ends at (", e.first, ", ", e.second,
                       "), which is on no segment");
      } else {
        const std::uint32_t s = e.triangle, t = group[k + 1].triangle;
        const bool s_forward =
            runs_forward(mesh.triangles[s], e.first, e.second) == projected[s].counterclockwise;
        const bool t_forward =
            runs_forward(mesh.triangles[t], e.first, e.second) == projected[t].counterclockwise;
        if (projected[s].clear && projected[t].clear && s_forward == t_forward)
          failures.add("triangles ", s, " and ", t, " of facet ", facet[s], " overlap");
      }
      k += n;
    }
    i = j;
  }
}

}  // namespace

std::vector<Check_line> check_facets(const Indexed_mesh_3& mesh, const Epick_domain& domain,
                                     const Expected& expected) {
  Failures failures, far;
  const std::vector<Triangle_edge> edges = triangle_edges(mesh);
  const std::vector<std::uint32_t> facet = facets_of_triangles(mesh, domain, expected, edges);
  const double rounded = rounding_distance(domain);
  const auto corner = [&](std::uint32_t v) { return to_vec(mesh.points[v]); };

  std::vector<Coverage> coverage(domain.facets.size());
  std::size_t wanted = 0;
  for (std::size_t f = 0; f < domain.facets.size(); ++f) {
    const auto& g = domain.facets[f];
    const Vec_3 n = to_vec(g.normal), o = to_vec(g.origin);
    bool any = false;
    for (std::size_t k = 0; k < g.triangles.size(); ++k) {
      const auto& t = g.triangles[k];
      const Vec_3 a = to_vec(domain.vertices[t[0]]), b = to_vec(domain.vertices[t[1]]),
                  c = to_vec(domain.vertices[t[2]]);
      for (const Vec_3& p : {a, b, c})
        coverage[f].thickness = std::max(coverage[f].thickness, std::abs(dot(n, p - o)));
      if (!expected.facet_triangles[f][k]) continue;
      any = true;
      coverage[f].wanted += std::abs(twice_projected_area(a, b, c, n)) / 2;
    }
    wanted += any;
    for (const Index s : g.segments)
      coverage[f].perimeter += length(to_vec(domain.vertices[domain.segments[s].vertices[1]]) -
                                      to_vec(domain.vertices[domain.segments[s].vertices[0]]));
  }

  double farthest = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (facet[i] == none) {
      failures.add("triangle ", i, " lies in no facet");
      far.add("triangle ", i, " is farther than the tolerance from all facets");
      continue;
    }
    const auto& g = domain.facets[facet[i]];
    if (mesh.triangle_references[i] != g.marker)
      failures.add("triangle ", i, " has reference ", mesh.triangle_references[i], ", its facet ", facet[i],
                   " has marker ", g.marker);
    double distance = 0;
    for (const std::uint32_t v : mesh.triangles[i])
      distance = std::max(distance, std::abs(dot(to_vec(g.normal), corner(v) - to_vec(g.origin))));
    if (distance > domain.tolerance * (1 + 1e-6) + rounded)
      far.add("triangle ", i, " reaches ", distance, " away from facet ", facet[i]);
    farthest = std::max(farthest, distance);
    coverage[facet[i]].thickness = std::max(coverage[facet[i]].thickness, distance);
  }

  std::vector<Projected> projected(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (facet[i] == none) continue;
    const auto& t = mesh.triangles[i];
    const Vec_3 a = corner(t[0]), b = corner(t[1]), c = corner(t[2]);
    const double area = twice_projected_area(a, b, c, to_vec(domain.facets[facet[i]].normal));
    const double longest =
        std::sqrt(std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)}));
    projected[i] = {area > 0, std::abs(area) > 4 * longest * (coverage[facet[i]].thickness + rounded)};
    coverage[facet[i]].covered += std::abs(area) / 2;
    if (!projected[i].clear) coverage[facet[i]].unclear += std::abs(area) / 2;
  }
  check_sheet(mesh, edges, facet, projected, failures);

  double worst = 0;
  for (std::size_t f = 0; f < coverage.size(); ++f) {
    const double area = coverage[f].wanted.value(), difference = std::abs(coverage[f].covered.value() - area);
    // A triangle of a bent facet that stands up within its thickness may be seen from behind: then it counts twice too often.
    const double folded = coverage[f].covered.value() > area ? 2 * coverage[f].unclear.value() : 0;
    if (difference > 1e-9 * area + rounded * coverage[f].perimeter + folded)
      failures.add(
          "facet ", f, " (input facet ",
          domain.facets[f].input_facets.empty() ? 0 : domain.facets[f].input_facets[0] + domain.first_index,
          ") has area ", area, ", its triangles ", coverage[f].covered.value());
    if (area > 0) worst = std::max(worst, difference / area);
  }
  return {failures.line("facets", text(wanted, " facets, ", mesh.triangles.size(),
                                       " triangles, greatest relative difference of areas ", worst)),
          far.line("distance", text("farthest triangle at ", farthest, ", tolerance ", domain.tolerance))};
}

}  // namespace pgdr::quality_detail
