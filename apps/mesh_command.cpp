// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/scale.h>
#include <pgdr/domain/summarize_domain_3.h>
#include <pgdr/io/atomic_file.h>
#include <pgdr/io/input_facets.h>
#include <pgdr/io/outer_triangles.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/io/second_order.h>
#include <pgdr/io/write_mesh.h>
#include <pgdr/io/write_quality.h>
#include <pgdr/mesh/indexed_mesh_3.h>
#include <pgdr/mesh_domain.h>
#include <pgdr/parallel/thread_arena.h>
#include <pgdr/parameters.h>
#include <pgdr/quality/exempt_angles.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/report/format.h>
#include <pgdr/report/memory.h>
#include <pgdr/report/phase_timer.h>
#include <pgdr/report/progress_line.h>
#include <pgdr/report/run_summary.h>
#include <pgdr/sizing/combined_sizing_field.h>

#include "arguments.h"
#include "command.h"
#include "exit_code.h"
#include "interrupt.h"
#include "messages.h"
#include "read_domain.h"
#include "report_page.h"
#include "size_estimate.h"
#include "sizing_options.h"
#include "stats_file.h"
#include "trace_file.h"

namespace pgdr::app {

namespace {

/// The command line as typed.
struct Mesh_arguments {
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
  Sizing_options sizing;
  std::string radius_edge_ratio;
  std::string placement;
  std::string order = "1";
  std::string gmsh_format;
  bool vtu_triangles = false;
  bool outer_triangles = false;
  std::string vtu_compression;
  std::string min_dihedral;
  std::string optimize;
  std::string min_edge_length;
  std::string max_vertices;
  std::string max_memory;
  std::string time_limit;
  std::string threads;
  std::string stats;
  std::string quality;
  std::string trace;
  std::string report;
  std::string problems;
  std::string octree_depth;
  bool check_zones = false;
  bool ignore_region_sizes = false;
  bool verify = false;
  bool quiet = false;
  Domain_options domain;
};

void add_options(CLI::App& parser, Mesh_arguments& arguments) {
  parser
      .add_option("INPUT", arguments.inputs,
                  "A PLC (.poly, .smesh) or a closed surface (.off, .stl, .ply, .obj); several are the parts of an assembly, a region each; or a mesh to refine further (.mesh, .vtu, .msh)")
      ->required()
      ->type_name("");
  parser.add_option("-o,--output", arguments.outputs, "File to write, in the format of its extension: .vtu, .vtk, .mesh, .msh (Gmsh), .inp (Abaqus), .su2 or .ele (TetGen); repeatable")
      ->required()
      ->type_name("OUT")
      ->allow_extra_args(false);
  arguments.sizing.add_to(parser);
  parser
      .add_option("--radius-edge-ratio", arguments.radius_edge_ratio,
                  "Upper bound of circumradius over shortest edge, at least 2 (default 2)")
      ->type_name("B");
  parser
      .add_option("--placement", arguments.placement,
                  "Where new points go: lazy (default: the circumcenter, or near it where that leaves an angle below --min-dihedral), "
                  "circumcenter, type1 or type2 (towards short edges)")
      ->type_name("POLICY");
  parser
      .add_option("--min-dihedral", arguments.min_dihedral,
                  "Choose, move and add vertices until no dihedral angle is below this one, in degrees, as far as that gets (default 12; 0: do not)")
      ->type_name("A");
  parser
      .add_option("--optimize", arguments.optimize,
                  "Rounds in which vertices inside move to make tetrahedra better on average, making no angle below --min-dihedral where there is none around (default 0)")
      ->type_name("N");
  parser
      .add_option("--gmsh-format", arguments.gmsh_format, "Version of .msh files: 4.1 (default, binary), 4.1-ascii, or 2.2 for older readers (gmshToFoam, MFEM)")
      ->type_name("VERSION");
  parser.add_option("--order", arguments.order, "2: tetrahedra of second order, with a node in the middle of each (straight) edge, in the formats that have them")->type_name("N");
  parser.add_flag("--vtu-triangles", arguments.vtu_triangles, "Write the triangles on facets to .vtu files as well, with their markers and the input's facets");
  parser.add_flag("--outer-triangles", arguments.outer_triangles,
                  "Write no triangles between regions nor inside them, which deal.II and SU2 refuse (and check wants)");
  parser.add_option("--vtu-compression", arguments.vtu_compression, "How hard to compress .vtu files, 0 (not at all) to 9 (default 1)")->type_name("LEVEL");
  arguments.domain.add_to(parser);
  add_problems_option(parser, arguments.problems);
  parser.add_flag("--ignore-region-sizes", arguments.ignore_region_sizes,
                  "Leave out the volume bounds of the input's regions");
  parser
      .add_option("--min-edge-length", arguments.min_edge_length,
                  "Put no new vertex closer than this to another one, and stop where the bounds ask for it (default: 1e-12 of the bounding box's diagonal)")
      ->type_name("L");
  parser
      .add_option("--max-vertices", arguments.max_vertices, "Stop at this many vertices (default: no limit)")
      ->type_name("N");
  parser
      .add_option("--max-memory", arguments.max_memory,
                  "Stop before more memory than this is needed, as 500M or 4G; 'none': no limit (default: nine tenths of what is free)")
      ->type_name("SIZE");
  parser.add_option("--time-limit", arguments.time_limit, "Stop the refinement after so many seconds (default: no limit)")
      ->type_name("SECONDS");
  parser.add_option("--threads", arguments.threads, "Number of threads (default and 0: one per core); the mesh is the same for all")
      ->type_name("N");
  parser
      .add_option("--octree-depth", arguments.octree_depth,
                  "For comparison: refine on the fixed octree of this depth, 1 (plain sequential refinement) to 7 "
                  "(default: the octree grows with the mesh)")
      ->type_name("D");
  parser.add_flag("--check-zones", arguments.check_zones,
                  "Check that parallel tasks keep their distance, and stop the program if not");
  parser.add_flag("--verify", arguments.verify, "Run CGAL's is_valid() on the triangulation when it is done");
  parser.add_flag("--quiet", arguments.quiet, "No progress line and no summary");
  parser.add_option("--stats", arguments.stats, "Write the summary as JSON; '-': to the standard output, in place of the one for people")
      ->type_name("FILE");
  add_quality_option(parser, arguments.quality);
  parser.add_option("--report", arguments.report, "Write a page to look at in a browser: what went in, what came out, times, and a picture to cut open (.html)")->type_name("FILE");
  parser
      .add_option("--trace", arguments.trace,
                  "Write a timeline of all leaf tasks in the Chrome trace-event format, for chrome://tracing or Perfetto")
      ->type_name("FILE");
}

/// In bytes; 0: none.
std::size_t memory_limit(const std::string& text) {
  if (text == "none") return 0;
  if (!text.empty()) return parse_memory("--max-memory", text);
  return attainable_memory_bytes().value_or(0) / 10 * 9;
}

Parameters parameters(const Mesh_arguments& arguments) {
  Parameters p;
  if (!arguments.radius_edge_ratio.empty())
    p.radius_edge_ratio = parse_ratio_bound("--radius-edge-ratio", arguments.radius_edge_ratio);
  if (!arguments.placement.empty()) p.placement = parse_placement(arguments.placement);
  if (!arguments.min_dihedral.empty()) p.min_dihedral = parse_dihedral_angle("--min-dihedral", arguments.min_dihedral);
  if (!arguments.optimize.empty()) p.optimization_rounds = parse_count_or_none("--optimize", arguments.optimize);
  p.coplanar_tolerance = arguments.domain.fusing_tolerance();
  p.triangulate_facets = arguments.domain.accepts_bent_polygons();
  p.ignore_region_sizes = arguments.ignore_region_sizes;
  if (!arguments.min_edge_length.empty())
    p.min_edge_length = parse_positive("--min-edge-length", arguments.min_edge_length);
  if (!arguments.max_vertices.empty()) p.max_vertices = parse_count("--max-vertices", arguments.max_vertices);
  if (!arguments.octree_depth.empty())
    p.octree_depth = static_cast<int>(parse_count("--octree-depth", arguments.octree_depth, Parameters::largest_octree_depth));
  p.max_memory = memory_limit(arguments.max_memory);
  if (!arguments.time_limit.empty()) p.time_limit = parse_positive("--time-limit", arguments.time_limit);
  p.check_zones = p.check_zones || arguments.check_zones;
  p.record_tasks = !arguments.trace.empty() || !arguments.report.empty();
  p.verify = arguments.verify;
  return p;
}

Write_options write_options(const Mesh_arguments& arguments) {
  Write_options options;
  if (!arguments.gmsh_format.empty()) options.gmsh = parse_gmsh_format(arguments.gmsh_format);
  options.vtu.triangles = arguments.vtu_triangles;
  if (!arguments.vtu_compression.empty()) options.vtu.compression = static_cast<int>(parse_count_or_none("--vtu-compression", arguments.vtu_compression));
  if (options.vtu.compression > 9) throw Usage_error("--vtu-compression must be at most 9, not " + arguments.vtu_compression);
  return options;
}

/// Everything that can be found out before the work starts.
void check_outputs(const Mesh_arguments& arguments) {
  for (const std::string& output : arguments.outputs) require_extension("-o", output, mesh_extensions());
  const int order = parse_order(arguments.order);
  for (const std::string& output : arguments.outputs) require_extension("--order 2", output, mesh_extensions(order));
  write_options(arguments);
  if (!arguments.gmsh_format.empty()) require_one_of_format("--gmsh-format", arguments.outputs, {".msh"});
  if (arguments.vtu_triangles) require_one_of_format("--vtu-triangles", arguments.outputs, {".vtu"});
  if (!arguments.vtu_compression.empty()) require_one_of_format("--vtu-compression", arguments.outputs, {".vtu"});
  std::vector<std::filesystem::path> files;
  for (const std::string& output : arguments.outputs)
    for (auto& file : mesh_files(output)) files.push_back(std::move(file));
  if (!arguments.stats.empty() && arguments.stats != "-") files.emplace_back(arguments.stats);
  if (!arguments.quality.empty()) {
    require_extension("--quality", arguments.quality, {".csv"});
    files.emplace_back(arguments.quality);
  }
  if (!arguments.trace.empty()) files.emplace_back(arguments.trace);
  if (!arguments.report.empty()) {
    require_page("--report");
    require_extension("--report", arguments.report, {".html"});
    files.emplace_back(arguments.report);
  }
  add_problem_file(arguments.problems, files);
  require_distinct_files(files_of(arguments.inputs), files);
  for (const auto& file : files) check_writable(file);
}

/// By the files as they are, whatever was taken away or repaired. Of an assembly: by all files, whose facets are counted on.
void find_facets_of_files(Indexed_mesh_3& mesh, const Mesh_arguments& arguments) {
  try {
    Plc all;
    for (const std::string& file : arguments.inputs) {
      const Plc part = normalized(read_plc(file));
      if (all.facets.empty()) all.first_index = part.first_index, all.exponent = part.exponent;
      const Index first = static_cast<Index>(all.vertices.size());
      all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
      for (Plc_facet<Default_kernel> facet : part.facets) {
        for (auto& polygon : facet.polygons)
          for (Index& v : polygon) v += first;
        all.facets.push_back(std::move(facet));
      }
    }
    find_input_facets(mesh, all);
  } catch (const Input_error& error) {
    print_message(std::string("warning: triangles are written without the input's facets: ") + error.what());
  }
}

/// Names of regions that have no tetrahedra, with a warning: of a part of an assembly that lies in others, or by a mistake.
void drop_empty_regions(Reference_names& names, const std::map<std::int32_t, double>& volumes) {
  const std::string known = joined(volumes, ", ", [](const auto& volume) { return std::to_string(volume.first); });
  std::erase_if(names.regions, [&](const auto& region) {
    if (volumes.contains(region.first)) return false;
    print_message("warning: region " + std::to_string(region.first) + ", '" + region.second + "', has no tetrahedra; regions are " + known);
    return true;
  });
}

/// What went in, for people.
Rows input_rows(const Domain& domain, const std::vector<Input_problem>& problems, const Run_summary& run) {
  const Domain_summary summary = summarize_domain_3(domain, pairs_to_list(), &problems);
  Rows rows{{"vertices", with_separators(summary.vertices)},
            {"facets", with_separators(summary.facets) + " of " + with_separators(summary.input_facets) + " in the file"},
            {"segments", with_separators(summary.segments)},
            {"smallest dihedral angle", significant(summary.smallest_dihedral_deg, 4) + " degrees"},
            {"smallest plane angle", significant(summary.smallest_plane_angle_deg, 4) + " degrees"}};
  if (summary.plane_corners_below_14_48 > 0)
    rows.emplace_back("plane angles below 14.48 degrees", with_separators(summary.plane_corners_below_14_48) + ", where no bound on the radius-edge ratio can hold");
  if (!run.repair.is_none()) rows.emplace_back("repaired", repair_text(run.repair));
  if (!run.simplification.is_none()) rows.emplace_back("simplified", simplification_text(run.simplification));
  if (!run.planarization.is_none()) rows.emplace_back("made plane", planarization_text(run.planarization));
  return rows;
}

int run_mesh(const Mesh_arguments& arguments) {
  Parameters p = parameters(arguments);
  arguments.sizing.check();
  arguments.domain.check();
  check_outputs(arguments);

  Phase_timer timer;
  Progress_line progress(!arguments.quiet, &Interrupt_guard::flag());
  progress.show("reading " + joined(arguments.inputs));
  std::optional<Domain> domain;
  std::vector<Input_problem> problems;  // that it can be meshed in spite of
  Run_summary run;
  {
    Input input = read_input(arguments.inputs, arguments.domain);
    const Plc& plc = input.plc;
    run.repair = input.repair;
    run.simplification = input.simplified.simplification;
    run.planarization = input.simplified.planarization;
    timer.end_phase("reading");
    progress.show("checking the input");
    with_problem_file(arguments.problems, plc, [&] {
      Understood understood = understand(input, arguments.domain, pairs_to_list(arguments.problems));
      progress.erase();
      print_or_throw(sort_problems(understood.problems));
      domain = std::move(understood.domain);
      problems = std::move(understood.problems);
    });
  }
  const Combined_sizing_field sizing = arguments.sizing.field(*domain);
  const double expected = expected_vertices(*domain, sizing, p.ignore_region_sizes);
  if (p.max_vertices == 0) require_memory(expected, p.max_memory);
  progress.expect(p.max_vertices == 0 ? expected : std::min(expected, static_cast<double>(p.max_vertices)));
  timer.end_phase("validation");
  if (p.time_limit > 0) p.time_limit = std::max(p.time_limit - timer.total_seconds(), 1e-3);

  run.threads = thread_count();
  Indexed_mesh_3 mesh;
  const Interrupt_guard interrupt;
  p.cancel = &Interrupt_guard::flag();
  Progress_record record;
  p.progress = [&](const Progress& now) {
    progress.update(now);
    if (!arguments.report.empty()) record.add(now);
  };
  {
    auto [meshed, statistics] = mesh_domain(Domain(*domain), sizing, p, [&](const Run_statistics& refined) {
      timer.end_phases(refined.seconds);
      progress.show("numbering");
    });
    mesh = std::move(meshed);
    run.stop = statistics.stop;
    run.stop_message = statistics.stop_message;
    run.steiner_points = statistics.steiner_points;
    run.unrecovered = statistics.unrecovered;
    run.volumes_left_out = statistics.volumes_left_out;
    run.slivers = statistics.slivers;
    run.optimization = statistics.optimization;
    run.schedule = statistics.schedule;
    run.serial_share = serial_share(statistics);
  }
  timer.end_phase("numbering");
  progress.show("measuring");
  run.quality = mesh_quality(mesh);
  if (run.stop == Stop_reason::finished) drop_empty_regions(mesh.names, run.quality.region_volumes);
  run.checksum = mesh_checksum(mesh);
  run.exempt_tetrahedra = mesh.exempt.size();
  run.exempt_angles = exempt_angles(mesh, *domain);
  run.steiner_vertices = mesh.points.size() - static_cast<std::size_t>(std::ranges::count(mesh.point_dimensions, 0));
  run.unrefined_tetrahedra = mesh.unrefined.size();
  timer.end_phase("measuring");
  // A mesh of nothing is of no use to anybody, and what it would replace may be.
  const bool is_usable = !mesh.tetrahedra.empty();
  if (is_usable) {
    if (arguments.vtu_triangles) find_facets_of_files(mesh, arguments);
    if (arguments.outer_triangles) keep_outer_triangles(mesh);
    if (parse_order(arguments.order) == 2) add_midside_nodes(mesh);
    for (const std::string& output : arguments.outputs) {
      progress.show("writing " + output);
      write_mesh(mesh, output, write_options(arguments));
    }
    if (!arguments.quality.empty()) {
      progress.show("writing " + arguments.quality);
      write_quality(mesh, arguments.quality);
    }
  }
  progress.erase();
  timer.end_phase("writing");

  run.seconds = timer.seconds();
  run.total_seconds = timer.total_seconds();
  run.peak_memory_bytes = peak_memory_bytes();
  if (!arguments.stats.empty()) write_stats(run, arguments.stats);
  if (!arguments.trace.empty()) write_trace(run.schedule, arguments.trace);
  if (!arguments.report.empty() && is_usable) {
    progress.show("writing " + arguments.report);
    const std::string title = joined(arguments.inputs, ", ", [](const std::string& input) { return std::filesystem::path(input).filename().string(); });
    write_report(mesh, {title, "meshed by pgdr " PGDR_VERSION, input_rows(*domain, problems, run), p.radius_edge_ratio, &run, &record}, arguments.report);
    progress.erase();
  }
  if (!arguments.quiet && arguments.stats != "-") print_summary(std::cout, run);
  if (run.stop == Stop_reason::finished && !is_usable) {
    print_message(joined(arguments.inputs) + " encloses nothing that is not a hole: there are no tetrahedra, and nothing was written");
    return exit_bad_input;
  }
  if (run.stop == Stop_reason::finished) return exit_done;
  std::string message = run.stop_message.empty() ? std::string("stopped: ") + stop_reason_name(run.stop) : run.stop_message;
  if (!is_usable && !arguments.outputs.empty()) message += "; there are no tetrahedra, and nothing was written";
  const bool is_to_blame = run.unrecovered > 0 || 1000 * run.exempt_tetrahedra > mesh.tetrahedra.size();
  if (arguments.domain.tolerance.empty() && is_to_blame)
    message += "; --tolerance 1e-5d, or more, takes small angles away that are no part of the shape";
  print_message(message);
  return exit_stopped;
}

}  // namespace

Command add_mesh_command(CLI::App& program) {
  const auto arguments = std::make_shared<Mesh_arguments>();
  CLI::App* parser = program.add_subcommand("mesh", "Mesh a piecewise linear complex");
  add_options(*parser, *arguments);
  return {parser, [arguments] {
            const unsigned threads = arguments->threads.empty() ? 0 : parse_threads("--threads", arguments->threads);
            return with_threads(threads, [&] { return run_mesh(*arguments); });
          }};
}

}  // namespace pgdr::app
