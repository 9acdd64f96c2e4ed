// SPDX-License-Identifier: GPL-3.0-or-later
// The bounds of ratio and dihedral angle, but for what small angles of the input excuse.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_reduce.h>
#include <pgdr/quality/measures.h>

#include "check_parts.h"
#include "small_angle_rule.h"

namespace pgdr::quality_detail {

namespace {

std::array<P, 4> corners_of(const Indexed_mesh_3& mesh, std::size_t i) {
  const auto& t = mesh.tetrahedra[i];
  return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]};
}

/// The worst value of all tetrahedra, and which ones are beyond the limit.
struct Beyond {
  double worst = 0;
  std::vector<std::size_t> tetrahedra;
};

/// `badness`: of a tetrahedron, a number that is the greater the worse it is; `least`: less than all of them.
Beyond beyond(const Indexed_mesh_3& mesh, double limit, double least, const auto& badness) {
  return parallel_reduce(
      mesh.tetrahedra.size(), default_grain, Beyond{least, {}},
      [&](std::size_t first, std::size_t last) {
        Beyond part{least, {}};
        for (std::size_t i = first; i < last; ++i) {
          const double value = badness(corners_of(mesh, i));
          part.worst = std::max(part.worst, value);
          if (!(value <= limit)) part.tetrahedra.push_back(i);
        }
        return part;
      },
      [](Beyond& all, const Beyond& part) {
        all.worst = std::max(all.worst, part.worst);
        all.tetrahedra.insert(all.tetrahedra.end(), part.tetrahedra.begin(), part.tetrahedra.end());
      });
}

/// A line that passes if the rule, where there is one, excuses all that are beyond the limit. A failure tells the `value` of one, between two texts.
Check_line judged(const std::string& property, const std::string& figures, const Indexed_mesh_3& mesh, const Small_angle_rule* rule,
                  const std::vector<std::size_t>& tetrahedra, const char* what, const auto& value, const char* unit) {
  Failures failures;
  Excused excused;
  for (const std::size_t i : tetrahedra) {
    const auto c = corners_of(mesh, i);
    if (!rule || !excused.add((*rule)(c, std::sqrt(squared_circumradius(c[0], c[1], c[2], c[3])))))
      failures.add("tetrahedron ", i, " has ", what, value(c), unit, " and no small angle nearby");
  }
  return failures.line(property, rule ? figures + excused.figures() : figures);
}

}  // namespace

std::vector<Check_line> check_shapes(const Indexed_mesh_3& mesh, const Epick_domain* domain, const Check_options& options) {
  // Squared, which spares a root for each.
  const auto squared_ratio = [](const std::array<P, 4>& c) {
    return squared_circumradius(c[0], c[1], c[2], c[3]) / squared_shortest_edge(c[0], c[1], c[2], c[3]);
  };
  const auto smallest_angle = [](const std::array<P, 4>& c) { return smallest_dihedral_angle_deg(c[0], c[1], c[2], c[3]); };
  const double bound = options.radius_edge_ratio, angle = options.min_dihedral_deg;
  const Beyond poor = beyond(mesh, bound * bound * (1 + 2e-9), 0, squared_ratio);
  Beyond flat;
  if (angle > 0) flat = beyond(mesh, -angle * (1 - 1e-9), -180, [&](const auto& c) { return -smallest_angle(c); });

  std::optional<Small_angle_rule> rule;
  if (domain != nullptr && !(poor.tetrahedra.empty() && flat.tetrahedra.empty())) rule.emplace(*domain);
  const Small_angle_rule* const used = rule ? &*rule : nullptr;
  std::vector<Check_line> lines;
  lines.push_back(judged("ratio", text("worst ", std::sqrt(poor.worst), ", bound ", bound, ", ", poor.tetrahedra.size(), " tetrahedra over it"),
                         mesh, used, poor.tetrahedra, "ratio ", [](const auto& c) { return radius_edge_ratio(c[0], c[1], c[2], c[3]); }, ""));
  if (angle > 0)
    lines.push_back(judged("dihedral angle",
                           text("smallest ", -flat.worst, " degrees, bound ", angle, ", ", flat.tetrahedra.size(), " tetrahedra below it"), mesh,
                           used, flat.tetrahedra, "a dihedral angle of ", smallest_angle, " degrees"));
  return lines;
}

}  // namespace pgdr::quality_detail
