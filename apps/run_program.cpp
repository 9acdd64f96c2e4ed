// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <exception>
#include <initializer_list>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include <CGAL/assertions.h>
#include <CGAL/assertions_behaviour.h>
#include <CGAL/exceptions.h>
#include <CGAL/version.h>

#include <pgdr/domain/input_error.h>
#include <pgdr/io/output_error.h>
#include <pgdr/sizing/sizing_field.h>

#include "arguments.h"
#include "command.h"
#include "exit_code.h"
#include "messages.h"
#include "size_estimate.h"
#include "unknown_option.h"

namespace pgdr::app {

namespace {

/// CGAL reports a failed assertion to this before it throws; by default it would print several lines.
void say_nothing(const char*, const char*, const char*, int, const char*) {}

int parse_and_run(int argc, char** argv) {
  CLI::App program(
      "Delaunay refinement: tetrahedral meshes of guaranteed quality from piecewise linear complexes.",
      "pgdr");
  program.set_version_flag("--version", "pgdr " PGDR_VERSION " (CGAL " CGAL_STR(CGAL_VERSION) ", " PGDR_THREADS_BY ")");
  program.require_subcommand(0, 1);  // none is reported below, in our own words
  const std::array<Command, 4> commands{add_mesh_command(program), add_check_command(program), add_info_command(program), add_view_command(program)};
  program.footer(
      "Exit codes: 0 done, 1 failed, 2 usage, 3 bad input, 4 stopped by a limit or Ctrl-C (the mesh is "
      "valid, or the message says that none was written).");
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& request) {
    return program.exit(request);  // --help, --version
  } catch (const CLI::ParseError& error) {
    // A slip comes before what is missing, which may be missing because of it.
    const auto command = std::ranges::find_if(commands, [](const Command& c) { return c.parser->parsed(); });
    if (command == commands.end() && argc > 1 && argv[1][0] != '-')
      throw Usage_error("there is no command " + std::string(argv[1]) + "; there are mesh, check, info and view (--help tells what is possible)");
    const auto unknown = unknown_option_text(command == commands.end() ? program : *command->parser);
    throw Usage_error(unknown.value_or(error.what()) + " (--help tells what is possible)");
  }
  for (const Command& command : commands) {
    if (!command.parser->parsed()) continue;
    if (const auto empty = empty_value_text(*command.parser)) throw Usage_error(*empty);
    return command.run();
  }
  throw Usage_error("no command given: mesh, check, info or view (--help tells what is possible)");
}

/// What the user may do about an input that cannot be meshed.
void print_remedy(const Input_error& error, const std::vector<std::string>& words) {
  using Kind = Input_problem::Kind;
  const auto has = [&](std::initializer_list<Kind> kinds) {
    return std::ranges::any_of(error.problems(), [&](const Input_problem& p) { return std::ranges::find(kinds, p.kind) != kinds.end(); });
  };
  const bool repairs = std::ranges::find(words, "--repair") != words.end();
  if (has({Kind::non_planar_facet})) print_message("--triangulate accepts polygons that are not plane, as triangles");
  if (!repairs && has({Kind::self_intersection, Kind::open_surface, Kind::degenerate_facet, Kind::non_planar_facet}))
    print_message("--repair may make it valid: it closes holes and cracks, and divides what intersects");
  else if (repairs && has({Kind::open_surface}))
    print_message("--fill-holes 1d fills holes of any size; a sheet that encloses nothing cannot be meshed");
}

int report(int exit_code, const std::string& message) {
  print_message(message);
  return exit_code;
}

}  // namespace

int run_program(int argc, char** argv) {
  CGAL::set_error_handler(say_nothing);
  CGAL::set_warning_handler(say_nothing);
  CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
  try {
    const int exit_code = parse_and_run(argc, argv);
    std::cout.flush();
    if (!std::cout) return report(exit_failed, "cannot write to the standard output");
    return exit_code;
  } catch (const Usage_error& error) {
    return report(exit_usage, error.what());
  } catch (const Sizing_error& error) {
    print_message(error.what());
    return exit_usage;
  } catch (const Input_error& error) {
    if (error.problems().empty()) return report(exit_bad_input, error.what());
    print_problems(error.problems());
    print_remedy(error, {argv + 1, argv + argc});
    return exit_bad_input;
  } catch (const Size_error& error) {
    return report(exit_stopped, error.what());
  } catch (const Output_error& error) {
    return report(exit_failed, error.what());
  } catch (const std::bad_alloc&) {
    return report(exit_failed, "the memory is exhausted; a larger --size, or --max-vertices, needs less");
  } catch (const CGAL::Failure_exception& error) {
    return report(exit_failed, "internal error, please report it with the input: '" + error.expression() +
                                   "' fails at " + error.filename() + ":" +
                                   std::to_string(error.line_number()));
  } catch (const std::exception& error) {
    return report(exit_failed, error.what());
  } catch (...) {
    return report(exit_failed, "unknown internal error");
  }
}

}  // namespace pgdr::app
