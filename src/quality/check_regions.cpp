// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the mesh fills the material of the domain, with the right region ids.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <pgdr/domain/vec_3.h>
#include <pgdr/quality/compensated_sum.h>
#include <pgdr/quality/measures.h>

#include "check_parts.h"

namespace pgdr::quality_detail {

Expected expected_of(const Epick_domain& domain, const Volumes_3<Epick>& volumes) {
  const auto material = [&](std::size_t v) { return v == volumes.none || volumes.volumes()[v].material; };
  std::map<std::array<Index, 2>, std::size_t> segment_at;
  for (std::size_t s = 0; s < domain.segments.size(); ++s) segment_at[domain.segments[s].vertices] = s;

  Expected expected;
  expected.vertices.assign(domain.vertices.size(), 0);
  expected.segments.assign(domain.segments.size(), 0);
  std::vector<char> in_facet(domain.vertices.size(), 0);
  for (Index f = 0; f < domain.facets.size(); ++f) {
    const auto& triangles = domain.facets[f].triangles;
    expected.facet_triangles.emplace_back(triangles.size(), 0);
    for (const Index v : domain.facets[f].vertices) in_facet[v] = 1;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      if (!material(volumes.beside(f, k, true)) && !material(volumes.beside(f, k, false))) continue;
      expected.facet_triangles[f][k] = 1;
      for (std::size_t i = 0; i < 3; ++i) {
        expected.vertices[triangles[k][i]] = 1;
        const auto [a, b] = std::minmax(triangles[k][i], triangles[k][(i + 1) % 3]);
        if (const auto it = segment_at.find({a, b}); it != segment_at.end())
          expected.segments[it->second] = 1;
      }
    }
  }
  for (std::size_t s = 0; s < domain.segments.size(); ++s) {
    const auto& [a, b] = domain.segments[s].vertices;
    in_facet[a] = in_facet[b] = 1;
    if (domain.segments[s].facets.empty())
      expected.segments[s] = material(volumes.locate(CGAL::midpoint(domain.vertices[a], domain.vertices[b])));
    if (expected.segments[s]) expected.vertices[a] = expected.vertices[b] = 1;
  }
  for (std::size_t v = 0; v < domain.vertices.size(); ++v)
    if (!in_facet[v]) expected.vertices[v] = material(volumes.locate(domain.vertices[v]));
  return expected;
}

namespace {

/// For each tetrahedron the smallest one that can be reached without crossing a listed triangle.
std::vector<std::uint32_t> components(const Indexed_mesh_3& mesh, const Face_table& faces) {
  std::vector<std::uint32_t> parent(mesh.tetrahedra.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&parent](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  faces.for_each([&](const Face_table::Triangle&, std::size_t first, std::size_t n) {
    if (faces.listed(first)) return;
    for (std::size_t i = first + 1; i < first + n; ++i) {
      const auto [a, b] = std::minmax({root(faces[first].tetrahedron()), root(faces[i].tetrahedron())});
      parent[b] = a;
    }
  });
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
  return parent;
}

/// By how much the volume on one side of the facets may differ: a facet that is not exactly planar bounds a
/// little more or less when it is cut into other triangles, and points on it are rounded.
double volume_slack(const Epick_domain& domain) {
  double slack = 0;
  for (const auto& facet : domain.facets) {
    const Vec_3 n = to_vec(facet.normal), o = to_vec(facet.origin);
    double thickness = 0, area = 0;
    for (const auto& t : facet.triangles) {
      const Vec_3 a = to_vec(domain.vertices[t[0]]), b = to_vec(domain.vertices[t[1]]),
                  c = to_vec(domain.vertices[t[2]]);
      area += length(cross(b - a, c - a)) / 2;
      for (const Vec_3& p : {a, b, c}) thickness = std::max(thickness, std::abs(dot(n, p - o)));
    }
    slack += (2 * thickness + rounding_distance(domain)) * area;
  }
  return slack;
}

}  // namespace

std::vector<Check_line> check_regions(const Indexed_mesh_3& mesh, const Face_table& faces,
                                      const Epick_domain& domain, const Volumes_3<Epick>& volumes) {
  Failures regions, total;
  const std::vector<std::uint32_t> component = components(mesh, faces);
  struct Part {
    std::uint32_t largest = none;
    double largest_volume = 0;
    Compensated_sum volume;
  };
  std::map<std::uint32_t, Part> parts;
  std::map<int, Compensated_sum> by_id;
  Compensated_sum volume;
  for (std::uint32_t i = 0; i < component.size(); ++i) {
    const auto& t = mesh.tetrahedra[i];
    const double v =
        std::abs(signed_volume(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]));
    Part& part = parts[component[i]];
    part.volume += v;
    if (part.largest == none || v > part.largest_volume) part.largest = i, part.largest_volume = v;
    by_id[mesh.tetrahedron_references[i]] += v;
    volume += v;
    if (mesh.tetrahedron_references[i] != mesh.tetrahedron_references[component[i]])
      regions.add("tetrahedra ", component[i], " and ", i, " with references ",
                  mesh.tetrahedron_references[component[i]], " and ", mesh.tetrahedron_references[i],
                  " are not separated by triangles");
  }

  const double slack = volume_slack(domain);
  const auto differ = [slack](double a, double b) {
    return !(std::abs(a - b) <= 1e-9 * std::abs(b) + slack);
  };
  std::vector<Compensated_sum> filled(volumes.volumes().size());
  for (const auto& [first, part] : parts) {
    const auto& t = mesh.tetrahedra[part.largest];
    const auto center =
        CGAL::centroid(point(mesh, t[0]), point(mesh, t[1]), point(mesh, t[2]), point(mesh, t[3]));
    const std::size_t v = volumes.locate(center);
    const int reference = mesh.tetrahedron_references[part.largest];
    if (v == volumes.none || !volumes.volumes()[v].material) {
      regions.add("tetrahedron ", part.largest, " is not in the material");
      continue;
    }
    filled[v] += part.volume.value();
    if (volumes.volumes()[v].region_id != reference)
      regions.add("tetrahedron ", part.largest, " has reference ", reference, ", its region has id ",
                  volumes.volumes()[v].region_id);
  }
  std::map<int, double> wanted_by_id;
  std::size_t n_material = 0;
  for (std::size_t v = 0; v < filled.size(); ++v) {
    const Volume& wanted = volumes.volumes()[v];
    if (!wanted.material) continue;
    ++n_material;
    wanted_by_id[wanted.region_id] += wanted.volume;
    if (differ(filled[v].value(), wanted.volume))
      regions.add("a subdomain with region id ", wanted.region_id, " has volume ", wanted.volume,
                  ", its tetrahedra have ", filled[v].value());
  }
  std::string figures = text(parts.size(), " parts, ", n_material, " subdomains; volume by region id");
  std::size_t printed = 0;
  for (const auto& [id, sum] : by_id) {
    if (++printed <= 8) figures += text(printed > 1 ? ", " : " ", id, ": ", sum.value());
    const auto it = wanted_by_id.find(id);
    const double wanted = it == wanted_by_id.end() ? 0 : it->second;
    if (differ(sum.value(), wanted))
      regions.add("region ", id, " has volume ", wanted, ", its tetrahedra have ", sum.value());
  }
  if (printed > 8) figures += ", ...";

  const double wanted = volumes.total_material_volume();
  if (differ(volume.value(), wanted)) total.add("the tetrahedra fill another volume than the material has");
  return {regions.line("regions", figures),
          total.line("volume", text("of the tetrahedra ", volume.value(), ", of the material ", wanted,
                                    ", relative difference ", std::abs(volume.value() - wanted) / wanted))};
}

}  // namespace pgdr::quality_detail
