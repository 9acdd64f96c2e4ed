// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPORT_RUN_STATISTICS_H
#define PGDR_REPORT_RUN_STATISTICS_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/report/schedule_statistics.h>

namespace pgdr {

/// Why the refinement ended.
enum class Stop_reason {
  finished,         ///< nothing poor is left but exempt tetrahedra
  vertex_budget,    ///< `Parameters::max_vertices`
  min_edge_length,  ///< a missing piece of the input could only be recovered with shorter edges
  cancelled         ///< `Parameters::cancel`
};

/// What one run of `refine_mesh_3` did.
struct Run_statistics {
  Stop_reason stop = Stop_reason::finished;
  std::string stop_message;            ///< one sentence when `stop` is not `finished`
  std::size_t steiner_points = 0;
  std::size_t unrecovered = 0;         ///< subsegments and subfacets that the mesh lacks (0 unless stopped)
  std::vector<std::pair<std::string, double>> seconds;  ///< per phase, in order of execution
  Schedule_statistics schedule;
};

}  // namespace pgdr

#endif
