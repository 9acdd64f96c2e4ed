// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/quality/mesh_quality.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pgdr/quality/compensated_sum.h>
#include <pgdr/quality/measures.h>

namespace pgdr {

namespace {

template <std::size_t N>
void count(std::array<std::uint64_t, N>& histogram, double value, double width) {
  const double bin = std::min(std::floor(value / width), double(N - 1));
  ++histogram[bin > 0 ? std::size_t(bin) : 0];
}

}  // namespace

Mesh_quality mesh_quality(const Indexed_mesh_3& mesh) {
  Mesh_quality q;
  q.vertices = mesh.points.size();
  q.edges = mesh.edges.size();
  q.triangles = mesh.triangles.size();
  q.tetrahedra = mesh.tetrahedra.size();
  if (mesh.tetrahedra.empty()) return q;

  double max_squared_radius = 0, max_squared_ratio = 0;
  double min_squared_edge = std::numeric_limits<double>::infinity();
  q.min_dihedral_deg = 180;
  Compensated_sum volume, ratios;
  std::map<std::int32_t, Compensated_sum> region_volumes;
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    const auto& t = mesh.tetrahedra[i];
    const auto &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]], &d = mesh.points[t[3]];
    const double rr = squared_circumradius(a, b, c, d), ll = squared_shortest_edge(a, b, c, d);
    max_squared_radius = std::max(max_squared_radius, rr);
    max_squared_ratio = std::max(max_squared_ratio, rr / ll);
    min_squared_edge = std::min(min_squared_edge, ll);
    const double ratio = std::sqrt(rr / ll);
    ratios += ratio;
    count(q.ratio_histogram, ratio, q.ratio_bin);
    for (const double angle : dihedral_angles_deg(a, b, c, d)) {
      q.min_dihedral_deg = std::min(q.min_dihedral_deg, angle);
      q.max_dihedral_deg = std::max(q.max_dihedral_deg, angle);
      count(q.dihedral_histogram, angle, q.dihedral_bin_deg);
    }
    const double v = signed_volume(a, b, c, d);
    volume += v;
    const std::int32_t region = i < mesh.tetrahedron_references.size() ? mesh.tetrahedron_references[i] : 0;
    region_volumes[region] += v;
    ++q.region_tetrahedra[region];
  }
  q.max_circumradius = std::sqrt(max_squared_radius);
  q.max_radius_edge_ratio = std::sqrt(max_squared_ratio);
  q.mean_radius_edge_ratio = ratios.value() / double(q.tetrahedra);
  q.shortest_edge = std::sqrt(min_squared_edge);
  q.volume = volume.value();
  for (const auto& [region, sum] : region_volumes) q.region_volumes[region] = sum.value();
  return q;
}

}  // namespace pgdr
