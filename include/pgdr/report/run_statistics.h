// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPORT_RUN_STATISTICS_H
#define PGDR_REPORT_RUN_STATISTICS_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/input_error.h>
#include <pgdr/report/schedule_statistics.h>

namespace pgdr {

/// Why the refinement ended.
enum class Stop_reason {
  finished,         ///< nothing poor is left but exempt tetrahedra
  vertex_budget,    ///< `Parameters::max_vertices`
  min_edge_length,  ///< a piece of the input could not be recovered, or a tetrahedron not be refined, without shorter edges
  memory_limit,     ///< `Parameters::max_memory`
  time_limit,       ///< `Parameters::time_limit`
  cancelled         ///< `Parameters::cancel`
};

/// What became of tetrahedra with a small dihedral angle, `Parameters::min_dihedral`.
struct Sliver_statistics {
  std::size_t found = 0;  ///< tetrahedra below the wanted angle
  std::size_t moved = 0;  ///< vertices, as often as they were
  std::size_t added = 0;  ///< vertices
  std::size_t left = 0;   ///< tetrahedra below the wanted angle
  double parallel_seconds = 0;  ///< in which there was work for several threads
};

struct Optimization_statistics {
  std::size_t rounds = 0;
  std::size_t moved = 0;        ///< vertices, as often as they were
};

/// What one run of `refine_mesh_3` did.
struct Run_statistics {
  Stop_reason stop = Stop_reason::finished;
  std::string stop_message;            ///< one sentence when `stop` is not `finished`
  std::vector<Input_problem> warnings;  ///< of the PLC: what was left out
  std::size_t steiner_points = 0;      ///< inserted, those outside of the domain included
  std::size_t unrecovered = 0;         ///< subsegments and subfacets that the mesh lacks (0 unless stopped)
  std::size_t volumes_left_out = 0;    ///< with gaps in their boundary when conforming was stopped; they have no tetrahedra
  Sliver_statistics slivers;
  Optimization_statistics optimization;
  std::vector<std::pair<std::string, double>> seconds;  ///< per phase, in order of execution
  Schedule_statistics schedule;
};

/// The share of the time from the domain to the refined mesh in which there was work for one thread only, 0 to 1: all of it
/// but what refinement does in leaf tasks beside others and in parallel loops, and the removal of slivers in territories.
inline double serial_share(const Run_statistics& run) {
  double total = 0;
  for (const auto& [phase, seconds] : run.seconds) total += seconds;
  return total > 0 ? 1 - (run.schedule.seconds - run.schedule.serial_seconds + run.slivers.parallel_seconds) / total : 0;
}

}  // namespace pgdr

#endif
