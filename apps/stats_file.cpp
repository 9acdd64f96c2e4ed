// SPDX-License-Identifier: GPL-3.0-or-later
#include "stats_file.h"

#include <cinttypes>
#include <cstdio>

#include <nlohmann/json.hpp>

#include <pgdr/io/atomic_file.h>

namespace pgdr::app {

namespace {

using Json = nlohmann::ordered_json;

Json schedule_json(const Schedule_statistics& schedule) {
  Json epochs = Json::array();
  for (const Epoch_statistics& e : schedule.epochs)
    epochs.push_back({{"leaves", e.leaves},
                      {"waves", e.waves},
                      {"tasks", e.tasks},
                      {"most_ready", e.most_ready},
                      {"active", e.active},
                      {"deferred", e.deferred},
                      {"inserted", e.inserted},
                      {"inserted_alone", e.inserted_alone},
                      {"seconds", e.seconds},
                      {"serial_share", e.seconds > 0 ? e.serial_seconds / e.seconds : 0}});
  return {{"seconds", schedule.seconds},
          {"serial_share", schedule.seconds > 0 ? schedule.serial_seconds / schedule.seconds : 0},
          {"far_parcels", schedule.far_parcels},
          {"settled", schedule.settled},
          {"epochs", epochs}};
}

Json small_angles_json(const Mesh_quality& quality) {
  Json below = Json::object();
  for (std::size_t i = 0; i < quality.tetrahedra_below.size(); ++i)
    below[std::to_string(static_cast<int>(Mesh_quality::small_angles_deg[i]))] = quality.tetrahedra_below[i];
  return below;
}

}  // namespace

std::string stats_json(const Run_summary& run) {
  const Mesh_quality& quality = run.quality;
  const auto measure = [](const Mesh_quality::Measure& m) { return Json{{"worst", m.worst}, {"mean", m.mean}}; };
  // In hexadecimal: a JSON number may lose bits of it.
  char checksum[17];
  std::snprintf(checksum, sizeof checksum, "%016" PRIx64, run.checksum);

  Json seconds = Json::object();
  for (const auto& [phase, value] : run.seconds) seconds[phase] = value;
  seconds["total"] = run.total_seconds;

  Json regions = Json::array();
  for (const auto& [id, count] : quality.region_tetrahedra) {
    const auto volume = quality.region_volumes.find(id);
    regions.push_back({{"id", id},
                       {"tetrahedra", count},
                       {"volume", volume == quality.region_volumes.end() ? 0.0 : volume->second}});
  }

  constexpr std::size_t most_angles = 100;
  Json exempt_angles = Json::array();
  for (const Exempt_angle& a : run.exempt_angles)
    if (exempt_angles.size() < most_angles)
      exempt_angles.push_back({{"degrees", a.degrees}, {"between", a.between}, {"tetrahedra", a.tetrahedra}});

  const Repair_report& repair = run.repair;
  const Simplification& simplification = run.simplification;
  const Planarization& planarization = run.planarization;
  const Json json = {{"planarization",
                      {{"flattened_facets", planarization.flattened_facets},
                       {"bent_facets", planarization.bent_facets},
                       {"moved_vertices", planarization.moved_vertices},
                       {"largest_change", planarization.largest_change}}},
                     {"repair",
                      {{"merged_vertices", repair.merged_vertices},
                       {"degenerate_triangles", repair.degenerate_triangles},
                       {"duplicate_triangles", repair.duplicate_triangles},
                       {"closed_cracks", repair.closed_cracks},
                       {"filled_holes", repair.filled_holes},
                       {"filling_triangles", repair.filling_triangles},
                       {"turned_triangles", repair.turned_triangles},
                       {"intersecting_pairs", repair.intersecting_pairs},
                       {"inner_triangles", repair.inner_triangles},
                       {"overlaps", repair.overlaps},
                       {"largest_move", repair.largest_move}}},
                     {"simplification",
                      {{"collapsed_edges", simplification.collapsed_edges},
                       {"removed_needles", simplification.removed_needles},
                       {"largest_change", simplification.largest_change}}},
                     {"vertices", quality.vertices},
                     {"tetrahedra", quality.tetrahedra},
                     {"triangles", quality.triangles},
                     {"edges", quality.edges},
                     {"steiner_points", run.steiner_points},
                     {"steiner_vertices", run.steiner_vertices},
                     {"max_radius_edge_ratio", quality.max_radius_edge_ratio},
                     {"mean_radius_edge_ratio", quality.mean_radius_edge_ratio},
                     {"max_circumradius", quality.max_circumradius},
                     {"min_dihedral_deg", quality.min_dihedral_deg},
                     {"max_dihedral_deg", quality.max_dihedral_deg},
                     {"dihedral_histogram", {{"bin_deg", Mesh_quality::dihedral_bin_deg}, {"counts", quality.dihedral_histogram}}},
                     {"tetrahedra_below_deg", small_angles_json(quality)},
                     {"edge_ratio", measure(quality.edge_ratio)},
                     {"aspect_ratio", measure(quality.aspect_ratio)},
                     {"mean_ratio", measure(quality.mean_ratio)},
                     {"scaled_jacobian", measure(quality.scaled_jacobian)},
                     {"slivers",
                      {{"found", run.slivers.found}, {"left", run.slivers.left}, {"moved", run.slivers.moved}, {"added", run.slivers.added},
                       {"parallel_seconds", run.slivers.parallel_seconds}}},
                     {"optimization", {{"rounds", run.optimization.rounds}, {"moved", run.optimization.moved}}},
                     {"exempt_tetrahedra", run.exempt_tetrahedra},
                     {"exempt_angles", exempt_angles},
                     {"unrefined_tetrahedra", run.unrefined_tetrahedra},
                     {"unrecovered", run.unrecovered},
                     {"volumes_left_out", run.volumes_left_out},
                     {"threads", run.threads},
                     {"seconds", seconds},
                     {"serial_share", run.serial_share},
                     {"peak_memory_bytes", run.peak_memory_bytes},
                     {"mesh_checksum", checksum},
                     {"stop", stop_reason_name(run.stop)},
                     {"stop_message", run.stop_message},
                     {"regions", regions},
                     {"schedule", schedule_json(run.schedule)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_stats(const Run_summary& run, const std::filesystem::path& path) {
  if (path == "-") {
    std::cout << stats_json(run);
    return;
  }
  Atomic_file file(path);
  file.write(stats_json(run));
  file.commit();
}

}  // namespace pgdr::app
