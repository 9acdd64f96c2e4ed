// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REPORT_RUN_SUMMARY_H
#define PGDR_REPORT_RUN_SUMMARY_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/quality/exempt_angles.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/report/format.h>
#include <pgdr/report/print_quality.h>
#include <pgdr/report/run_statistics.h>
#include <pgdr/repair/repair.h>
#include <pgdr/simplify/planarize.h>
#include <pgdr/simplify/simplify.h>

namespace pgdr {

/// Everything that is said about a run when it is over.
struct Run_summary {
  Repair_report repair;
  Simplification simplification;
  Planarization planarization;
  Mesh_quality quality;
  std::size_t exempt_tetrahedra = 0;
  std::vector<Exempt_angle> exempt_angles;
  std::size_t unrefined_tetrahedra = 0;
  std::uint64_t checksum = 0;  ///< `mesh_checksum`
  Stop_reason stop = Stop_reason::finished;
  std::string stop_message;
  std::size_t steiner_points = 0;    ///< inserted, those outside of the domain included
  std::size_t steiner_vertices = 0;  ///< of the mesh
  std::size_t unrecovered = 0;
  std::size_t volumes_left_out = 0;
  unsigned threads = 1;
  Sliver_statistics slivers;
  Optimization_statistics optimization;
  Schedule_statistics schedule;
  double serial_share = 0;  ///< `serial_share(Run_statistics)`
  std::vector<std::pair<std::string, double>> seconds;  ///< per phase, in order of execution
  double total_seconds = 0;
  std::size_t peak_memory_bytes = 0;
};

/// The name of `reason` in statistics files; never changes.
inline const char* stop_reason_name(Stop_reason reason) {
  switch (reason) {
    case Stop_reason::finished:
      return "finished";
    case Stop_reason::vertex_budget:
      return "vertex_budget";
    case Stop_reason::min_edge_length:
      return "min_edge_length";
    case Stop_reason::memory_limit:
      return "memory_limit";
    case Stop_reason::time_limit:
      return "time_limit";
    case Stop_reason::cancelled:
      return "cancelled";
  }
  return "unknown";
}

/// Writes the angles with the most exempt tetrahedra, one a line.
inline void print_exempt_angles(std::ostream& out, const std::vector<Exempt_angle>& angles) {
  constexpr std::size_t most = 5;
  const auto line = [&out](std::size_t count, const std::string& where) {
    out << std::setw(31) << with_separators(count) << "  at " << where << '\n';
  };
  for (std::size_t i = 0; i < std::min(most, angles.size()); ++i)
    line(angles[i].tetrahedra, "the " + significant(angles[i].degrees, 3) + " degree angle between " + angles[i].between);
  if (angles.size() <= most) return;
  std::size_t rest = 0;
  for (std::size_t i = most; i < angles.size(); ++i) rest += angles[i].tetrahedra;
  line(rest, counted(angles.size() - most, "other angle", "others"));
}

/// What was done about input that was not valid.
inline std::string repair_text(const Repair_report& r) {
  std::string text;
  const auto add = [&text](std::size_t count, const char* one, const char* many, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many) + " " + what;
  };
  add(r.merged_vertices, "vertex", "vertices", "merged");
  add(r.degenerate_triangles, "triangle", "triangles", "without area taken away");
  add(r.duplicate_triangles, "duplicate", "duplicates", "taken away");
  add(r.closed_cracks, "edge", "edges", "divided along cracks");
  add(r.filled_holes, "hole", "holes", "filled");
  add(r.turned_triangles, "triangle", "triangles", "turned round");
  add(r.intersecting_pairs, "pair", "pairs", "of triangles that met divided");
  add(r.inner_triangles, "triangle", "triangles", "inside taken away");
  add(r.overlaps, "overlap", "overlaps", "given to the later part");
  if (r.largest_move > 0) text += "; vertices moved by at most " + significant(r.largest_move, 3);
  return text;
}

/// What was taken away of the input.
inline std::string simplification_text(const Simplification& s) {
  return counted(s.collapsed_edges, "short edge", "short edges") + " and " + counted(s.removed_needles, "needle", "needles") +
         " taken away, a change of at most " + significant(s.largest_change, 3);
}

/// What was moved.
inline std::string planarization_text(const Planarization& p) {
  std::string text = counted(p.moved_vertices, "vertex", "vertices") + " moved by at most " + significant(p.largest_change, 3);
  if (p.bent_facets > 0) text += "; " + counted(p.bent_facets, "facet stays bent", "facets stay bent");
  return text;
}

/// Writes the summary for people: one property a line.
inline void print_summary(std::ostream& out, const Run_summary& run) {
  const Mesh_quality& quality = run.quality;
  const auto line = [&out](const char* name, const std::string& value, const std::string& remark = {}) { print_figure(out, name, value, remark); };
  if (!run.repair.is_none()) out << std::left << std::setw(18) << "repaired" << std::right << repair_text(run.repair) << '\n';
  if (!run.simplification.is_none())
    line("simplified", with_separators(run.simplification.facets), "facets: " + simplification_text(run.simplification));
  if (!run.planarization.is_none())
    line("made plane", with_separators(run.planarization.flattened_facets), "facets: " + planarization_text(run.planarization));
  line("vertices", with_separators(quality.vertices),
       with_separators(run.steiner_vertices) + " of them Steiner points");
  line("tetrahedra", with_separators(quality.tetrahedra),
       "in " + counted(quality.region_tetrahedra.size(), "region", "regions"));
  line("triangles", with_separators(quality.triangles), "on facets");
  line("edges", with_separators(quality.edges), "on segments");
  print_quality(out, quality);
  if (run.slivers.found > 0)
    line("slivers", with_separators(run.slivers.left),
         "left of " + with_separators(run.slivers.found) + "; " + counted(run.slivers.moved, "vertex was", "vertices were") + " moved, " +
             with_separators(run.slivers.added) + " added");
  if (run.optimization.rounds > 0)
    line("optimized", with_separators(run.optimization.moved), "moves of vertices in " + counted(run.optimization.rounds, "round", "rounds"));
  if (run.exempt_tetrahedra > 0)
    line("exempt", with_separators(run.exempt_tetrahedra),
         "tetrahedra over the bound, at small angles of the input");
  print_exempt_angles(out, run.exempt_angles);
  if (run.unrefined_tetrahedra > 0)
    line("unrefined", with_separators(run.unrefined_tetrahedra), "tetrahedra over a bound of ratio or size when it stopped");
  if (run.unrecovered > 0)
    line("missing", with_separators(run.unrecovered), "pieces of segments and facets when it stopped");
  if (run.volumes_left_out > 0)
    line("left out", with_separators(run.volumes_left_out), "volumes with gaps in their boundary when it stopped");
  std::string phases;
  for (const auto& [name, seconds] : run.seconds) {
    if (seconds >= 0.005) phases += (phases.empty() ? "" : ", ") + name + " " + fixed(seconds);
  }
  line("seconds", fixed(run.total_seconds), phases);
  line("peak memory", memory_size(run.peak_memory_bytes));
}

}  // namespace pgdr

#endif
