// SPDX-License-Identifier: GPL-3.0-or-later
// The checks of how tetrahedra fit together: faces, boundary, overlap.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/quality/compensated_sum.h>
#include <pgdr/quality/measures.h>

#include "check_parts.h"

namespace pgdr::quality_detail {

namespace {

constexpr double pi = 3.14159265358979323846;

std::string name(const Face_table::Triangle& t) { return text("(", t[0], ", ", t[1], ", ", t[2], ")"); }

/// Solid angle at `a` of a tetrahedron with the given determinant (Van Oosterom and Strackee 1983).
double solid_angle(const P& a, const P& b, const P& c, const P& d, double det) {
  const auto u = difference<double>(b, a), v = difference<double>(c, a), w = difference<double>(d, a);
  const double lu = std::sqrt(dot(u, u)), lv = std::sqrt(dot(v, v)), lw = std::sqrt(dot(w, w));
  return 2 * std::atan2(std::max(det, 0.0), lu * lv * lw + dot(u, v) * lw + dot(v, w) * lu + dot(w, u) * lv);
}

}  // namespace

Check_line check_faces(const Indexed_mesh_3&, const Face_table& faces) {
  Failures failures;
  std::size_t inner = 0, outer = 0;
  faces.for_each([&](const Face_table::Triangle& t, std::size_t first, std::size_t n) {
    ++(n == 1 ? outer : inner);
    if (n > 2)
      failures.add("face ", name(t), " belongs to ", n, " tetrahedra");
    else if (n == 2 && faces.ascending_is_outward(first) == faces.ascending_is_outward(first + 1))
      failures.add("face ", name(t), " has tetrahedra ", faces[first].tetrahedron(), " and ",
                   faces[first + 1].tetrahedron(), " on the same side");
  });
  return failures.line("faces", text(inner, " inner, ", outer, " on the outer boundary"));
}

Check_line check_boundary(const Indexed_mesh_3& mesh, const Face_table& faces) {
  Failures failures;
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::size_t interfaces = 0, outer = 0;
  faces.for_each([&](const Face_table::Triangle& t, std::size_t first, std::size_t n) {
    bool needed = n == 1;
    for (std::size_t i = first + 1; i < first + n; ++i)
      needed = needed || mesh.tetrahedron_references[faces[i].tetrahedron()] !=
                             mesh.tetrahedron_references[faces[first].tetrahedron()];
    if (!needed) return;
    if (!faces.listed(first))
      failures.add("face ", name(t), n == 1 ? " of the outer boundary" : " between two regions",
                   " is not a triangle");
    ++(n == 1 ? outer : interfaces);
    if (n > 1) return;
    edges.push_back({t[0], t[1]});
    edges.push_back({t[0], t[2]});
    edges.push_back({t[1], t[2]});
  });
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    const std::size_t n =
        std::size_t(std::upper_bound(edges.begin() + std::ptrdiff_t(i), edges.end(), edges[i]) -
                    edges.begin()) -
        i;
    if (n % 2 == 1) failures.add("the boundary is open at the edge (", edges[i][0], ", ", edges[i][1], ")");
    i += n;
  }
  for (const auto& t : mesh.triangles)
    if (faces.find(t)[1] == 0) failures.add("triangle ", name(t), " is a face of no tetrahedron");
  return failures.line("boundary", text(outer, " outer faces, ", interfaces, " between regions, ",
                                        mesh.triangles.size(), " triangles"));
}

Check_line check_overlap(const Indexed_mesh_3& mesh, const Face_table& faces) {
  Failures failures;
  // The tetrahedra at a vertex map onto the ball of directions; around an inner vertex a sum above 4 pi
  // means that they cover it several times. Together with `faces` this makes the mesh locally one sheet.
  std::vector<double> angles(mesh.points.size(), 0.0);
  Compensated_sum volume, magnitude;
  // Measured at once, some at a time, and added in the order of the mesh.
  struct Measured {
    double determinant;
    std::array<double, 4> angles;
  };
  const std::size_t count = mesh.tetrahedra.size();
  std::vector<Measured> measured(std::min(count, std::size_t(1) << 18));
  for (std::size_t begin = 0; begin < count; begin += measured.size()) {
    const std::size_t n = std::min(measured.size(), count - begin);
    parallel_for_chunks(n, default_grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const auto& t = mesh.tetrahedra[begin + i];
        const P &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]], &d = mesh.points[t[3]];
        const double det = orientation_determinant(a, b, c, d);
        measured[i] = {det, {solid_angle(a, b, c, d, det), solid_angle(b, a, d, c, det), solid_angle(c, d, a, b, det),
                             solid_angle(d, c, b, a, det)}};
      }
    });
    for (std::size_t i = 0; i < n; ++i) {
      volume += measured[i].determinant / 6;
      magnitude += std::abs(measured[i].determinant / 6);
      for (std::size_t k = 0; k < 4; ++k) angles[mesh.tetrahedra[begin + i][k]] += measured[i].angles[k];
    }
  }
  const auto fullest = std::max_element(angles.begin(), angles.end());
  if (*fullest > 4 * pi * (1 + 1e-6))
    failures.add("the tetrahedra at vertex ", fullest - angles.begin(), " overlap");

  // The divergence theorem over the faces that no second tetrahedron cancels.
  Compensated_sum enclosed;
  double size = 0;
  const P& o = mesh.points[0];
  faces.for_each([&](const Face_table::Triangle&, std::size_t first, std::size_t n) {
    if (n != 1) return;
    const auto t = faces.outward(first);
    const double term =
        orientation_determinant(o, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]) / 6;
    enclosed += term;
    size += std::abs(term);
  });
  if (std::abs(magnitude.value() - enclosed.value()) > 1e-10 * std::max(size, magnitude.value()))
    failures.add("the tetrahedra have volume ", magnitude.value(), ", their boundary encloses ",
                 enclosed.value());
  return failures.line("overlap",
                       text("volume ", volume.value(), ", enclosed by the boundary ", enclosed.value(),
                            ", fullest vertex ", *fullest / (4 * pi), " of a ball"));
}

}  // namespace pgdr::quality_detail
