// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <pgdr/domain/plc_from_domain_3.h>
#include <pgdr/domain/summarize_domain_3.h>
#include <pgdr/io/atomic_file.h>
#include <pgdr/io/write_poly.h>
#include <pgdr/report/format.h>
#include <pgdr/report/run_summary.h>

#include "arguments.h"
#include "command.h"
#include "exit_code.h"
#include "read_domain.h"

namespace pgdr::app {

namespace {

struct Info_arguments {
  std::vector<std::string> inputs;
  std::string write_plc;
  std::string problems;
  Domain_options domain;
};

std::string coordinates(const std::array<double, 3>& p) {
  return significant(p[0], 10) + " " + significant(p[1], 10) + " " + significant(p[2], 10);
}

void print_line(const std::string& name, const std::string& value) {
  std::cout << std::left << std::setw(25) << name << value << '\n';
}

void print_angle(const std::string& name, double degrees) {
  print_line(name, significant(degrees, 6) + " degrees");
}

std::string closedness(const Domain_summary& summary) {
  const auto is_intersection = [](const Input_problem& p) { return p.kind == Input_problem::Kind::self_intersection; };
  if (std::ranges::any_of(summary.problems, is_intersection)) return "not known, since facets intersect";
  if (!summary.closed) return "no";
  std::string text = "yes";
  if (summary.open_edges > 0)
    text += ", with " + counted(summary.open_edges, "open edge", "open edges") + " inside";
  return text;
}

void print_volumes(const Domain_summary& summary) {
  std::size_t regions = 0, cavities = 0;
  for (const Volume& volume : summary.volumes) (volume.material ? regions : cavities) += !volume.outside;
  print_line("regions", with_separators(regions) + ", volume " + significant(summary.material_volume, 10));
  for (const Volume& volume : summary.volumes) {
    if (!volume.material) continue;
    std::string text = "volume " + significant(volume.volume, 10);
    if (volume.max_volume > 0) text += ", tetrahedra of at most " + significant(volume.max_volume, 10);
    print_line("  region " + std::to_string(volume.region_id), text);
  }
  print_line("cavities", with_separators(cavities));
}

void print_summary(const Domain_summary& summary) {
  const auto remark = [](std::size_t count, const std::string& text) {
    return count == 0 ? std::string() : ", " + with_separators(count) + " " + text;
  };
  print_line("vertices",
             with_separators(summary.vertices) + remark(summary.duplicate_vertices, "duplicates merged"));
  print_line("facets", with_separators(summary.facets) + " of " + with_separators(summary.input_facets) +
                           " in the file" + remark(summary.fused_facets, "of them fused"));
  print_line("segments", with_separators(summary.segments) +
                             remark(summary.non_manifold_edges, "where more than two facets meet"));
  print_line("bounding box", coordinates(summary.lower) + " to " + coordinates(summary.upper));
  print_line("closed", closedness(summary));
  print_angle("smallest dihedral angle", summary.smallest_dihedral_deg);
  print_angle("smallest plane angle", summary.smallest_plane_angle_deg);
  if (summary.plane_corners_below_14_48 > 0)
    print_line("plane angles < 14.48", with_separators(summary.plane_corners_below_14_48) +
                                           ", where no bound on the radius-edge ratio can hold");
  if (!summary.volumes.empty()) print_volumes(summary);
  print_line("problems", summary.problems.empty() ? "none" : with_separators(summary.problems.size()));
}

/// Everything that can be found out before anything is read.
void check_outputs(const Info_arguments& arguments) {
  arguments.domain.check();
  std::vector<std::filesystem::path> files;
  if (!arguments.write_plc.empty()) {
    require_extension("--write-plc", arguments.write_plc, {".poly"});
    files.emplace_back(arguments.write_plc);
  }
  add_problem_file(arguments.problems, files);
  require_distinct_files(files_of(arguments.inputs), files);
  for (const auto& file : files) check_writable(file);
}

int run_info(const Info_arguments& arguments) {
  check_outputs(arguments);
  Input input = read_input(arguments.inputs, arguments.domain);
  if (!input.repair.is_none()) print_line("repaired", repair_text(input.repair));
  if (!input.simplified.simplification.is_none())
    print_line("simplified", simplification_text(input.simplified.simplification) + "; --tolerance 0 keeps them");
  if (!input.simplified.planarization.is_none())
    print_line("made plane", counted(input.simplified.planarization.flattened_facets, "facet", "facets") + ": " +
                                 planarization_text(input.simplified.planarization) + "; --tolerance 0 keeps them");
  with_problem_file(arguments.problems, input.plc, [&] {
    const std::size_t pairs = pairs_to_list(arguments.problems);
    const auto [domain, problems] = understand(input, arguments.domain, pairs);
    const Domain_summary summary = summarize_domain_3(domain, pairs, &problems);
    print_summary(summary);
    std::cout.flush();
    print_or_throw(sort_problems(summary.problems));
    if (!arguments.write_plc.empty()) write_poly(plc_from_domain_3(domain), arguments.write_plc);
  });
  return exit_done;
}

}  // namespace

Command add_info_command(CLI::App& program) {
  const auto arguments = std::make_shared<Info_arguments>();
  CLI::App* parser = program.add_subcommand("info", "Describe an input and what is wrong with it");
  parser->add_option("INPUT", arguments->inputs, "A PLC or a closed surface, as for mesh")
      ->required()
      ->type_name("");
  parser->add_option("--write-plc", arguments->write_plc, "Write the PLC as understood and fused, as .poly")
      ->type_name("FILE");
  add_problems_option(*parser, arguments->problems);
  arguments->domain.add_to(*parser);
  return {parser, [arguments] { return run_info(*arguments); }};
}

}  // namespace pgdr::app
