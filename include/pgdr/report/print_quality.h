// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPORT_PRINT_QUALITY_H
#define PGDR_REPORT_PRINT_QUALITY_H

#include <cstddef>
#include <iomanip>
#include <ostream>
#include <string>

#include <pgdr/quality/mesh_quality.h>
#include <pgdr/report/format.h>

namespace pgdr {

/// Writes one line of a summary: a name, a figure, and what it is.
inline void print_figure(std::ostream& out, const char* name, const std::string& value, const std::string& remark = {}) {
  out << std::left << std::setw(18) << name << std::right << std::setw(13) << value;
  if (!remark.empty()) out << "  " << remark;
  out << '\n';
}

/// Writes the figures of the tetrahedra's shapes and sizes for people: one a line.
inline void print_quality(std::ostream& out, const Mesh_quality& quality) {
  print_figure(out, "radius-edge ratio", significant(quality.max_radius_edge_ratio),
               "largest, " + significant(quality.mean_radius_edge_ratio) + " on average");
  print_figure(out, "circumradius", significant(quality.max_circumradius), "largest");
  std::string below;
  for (std::size_t i = 0; i < quality.tetrahedra_below.size(); ++i)
    below += (i == 0 ? "" : ", ") + with_separators(quality.tetrahedra_below[i]) + " < " + significant(Mesh_quality::small_angles_deg[i], 2);
  print_figure(out, "dihedral angle", significant(quality.min_dihedral_deg),
               "degrees, smallest, " + significant(quality.max_dihedral_deg) + " largest; tetrahedra with one " + below);
  const auto other = [](const char* name, const Mesh_quality::Measure& m) {
    return std::string("; ") + name + " " + significant(m.worst, 3) + ", " + significant(m.mean, 3);
  };
  print_figure(out, "scaled Jacobian", significant(quality.scaled_jacobian.worst, 3),
               "worst, " + significant(quality.scaled_jacobian.mean, 3) + " on average" + other("mean ratio", quality.mean_ratio) +
                   other("aspect ratio", quality.aspect_ratio) + other("edge ratio", quality.edge_ratio));
}

}  // namespace pgdr

#endif
