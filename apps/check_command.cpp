// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/io/atomic_file.h>
#include <pgdr/io/medit.h>
#include <pgdr/io/write_quality.h>
#include <pgdr/mesh/scale_mesh.h>
#include <pgdr/parallel/thread_arena.h>
#include <pgdr/quality/check_mesh.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/report/format.h>
#include <pgdr/report/print_quality.h>

#include "arguments.h"
#include "command.h"
#include "exit_code.h"
#include "messages.h"
#include "read_domain.h"

namespace pgdr::app {

namespace {

struct Check_arguments {
  std::string mesh;
  std::vector<std::string> inputs;
  std::string radius_edge_ratio;
  std::string min_dihedral;
  std::string quality;
  std::string threads;
  Domain_options domain;
};

int run_check(const Check_arguments& arguments) {
  Check_options options;
  if (!arguments.radius_edge_ratio.empty())
    options.radius_edge_ratio = parse_positive("--radius-edge-ratio", arguments.radius_edge_ratio);
  if (!arguments.min_dihedral.empty()) options.min_dihedral_deg = parse_dihedral_angle("--min-dihedral", arguments.min_dihedral);
  arguments.domain.check();  // nonsense is refused even where it is not needed
  if (arguments.inputs.empty() && arguments.domain.is_any_given()) throw Usage_error("options for the input go with --plc");
  require_extension("MESH", arguments.mesh, {".mesh"});
  if (!arguments.quality.empty()) {
    require_extension("--quality", arguments.quality, {".csv"});
    std::vector<std::filesystem::path> inputs = files_of(arguments.inputs);
    inputs.emplace_back(arguments.mesh);
    require_distinct_files(inputs, {arguments.quality});
    check_writable(arguments.quality);
  }

  std::optional<Domain> domain;
  std::vector<Check_line> lines;
  if (!arguments.inputs.empty()) {
    Input input = read_input(arguments.inputs, arguments.domain);
    Understood understood = understand(input, arguments.domain);
    print_or_throw(sort_problems(understood.problems));
    domain = std::move(understood.domain);
    if (input.simplified.limit > 0)
      lines.push_back({"tolerance", input.simplified.distance.is_within,
                       "what is meshed is within " + significant(input.simplified.limit, 3) + " of the input and the input within that of it; the largest distance met is " +
                           significant(input.simplified.distance.seen, 3)});
  }
  Indexed_mesh_3 mesh = read_medit(arguments.mesh);
  const std::vector<Check_line> checked = check_mesh(mesh, domain ? &*domain : nullptr, options);
  lines.insert(lines.end(), checked.begin(), checked.end());
  for (const Check_line& line : lines) {
    std::cout << (line.passed ? "ok    " : "FAIL  ") << std::left << std::setw(15) << line.property << "  "
              << line.detail << '\n';
  }
  if (checked.front().passed && !mesh.tetrahedra.empty()) {  // all indices in range, all coordinates numbers
    const int exponent = mesh.exponent + exponent_for(mesh);
    mesh = scaled_to(std::move(mesh), exponent);
    print_quality(std::cout, mesh_quality(mesh));
    if (!arguments.quality.empty()) write_quality(mesh, arguments.quality, false);  // a .mesh does not say what was exempt
  } else if (!arguments.quality.empty()) {
    print_message("there are no tetrahedra that could be measured, and '" + arguments.quality + "' was not written");
  }
  const auto failed =
      std::count_if(lines.begin(), lines.end(), [](const Check_line& line) { return !line.passed; });
  if (failed == 0) {
    std::cout << "all " << lines.size() << " properties hold\n";
  } else {
    std::cout << failed << " of " << lines.size() << " properties fail\n";
  }
  return failed == 0 ? exit_done : exit_failed;
}

}  // namespace

Command add_check_command(CLI::App& program) {
  const auto arguments = std::make_shared<Check_arguments>();
  CLI::App* parser = program.add_subcommand("check", "Verify a written mesh, property by property");
  parser->add_option("MESH", arguments->mesh, "A .mesh file")->required()->type_name("");
  parser
      ->add_option("--plc", arguments->inputs,
                   "The input that it was made from: verify that the mesh conforms to it; repeatable for an assembly")
      ->type_name("INPUT")
      ->allow_extra_args(false);
  parser
      ->add_option("--radius-edge-ratio", arguments->radius_edge_ratio,
                   "Bound of circumradius over shortest edge to verify (default 2)")
      ->type_name("B");
  parser
      ->add_option("--min-dihedral", arguments->min_dihedral,
                   "Verify that no dihedral angle is smaller, in degrees, but next to small angles of the input")
      ->type_name("A");
  parser
      ->add_option("--threads", arguments->threads,
                   "Number of threads (default and 0: one per core); the result is the same for all")
      ->type_name("N");
  add_quality_option(*parser, arguments->quality);
  arguments->domain.add_to(*parser);
  return {parser, [arguments] {
            const unsigned threads = arguments->threads.empty() ? 0 : parse_threads("--threads", arguments->threads);
            return with_threads(threads, [&] { return run_check(*arguments); });
          }};
}

}  // namespace pgdr::app
