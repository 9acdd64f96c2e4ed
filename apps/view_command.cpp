// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>

#include <pgdr/domain/input_error.h>
#include <pgdr/io/atomic_file.h>
#include <pgdr/io/read_mesh.h>
#include <pgdr/mesh/scale_mesh.h>

#include "arguments.h"
#include "command.h"
#include "exit_code.h"
#include "messages.h"
#include "report_page.h"

namespace pgdr::app {

namespace {

struct View_arguments {
  std::string mesh;
  std::string output;
};

/// Hands a file to the desktop's browser; false where there is none.
bool open_in_browser(const std::filesystem::path& path) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::execlp("xdg-open", "xdg-open", path.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  int status = 0;
  return child > 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int run_view(const View_arguments& arguments) {
  require_page("view");
  require_extension("MESH", arguments.mesh, readable_mesh_extensions());
  const bool is_shown = arguments.output.empty();
  std::filesystem::path page = arguments.output;
  if (is_shown) page = std::filesystem::temp_directory_path() / ("pgdr-view-" + std::to_string(::getuid()) + ".html");
  require_extension("-o", page, {".html"});
  require_distinct_files({arguments.mesh}, {page});
  check_writable(page);

  Indexed_mesh_3 mesh = read_mesh(arguments.mesh);
  if (mesh.tetrahedra.empty()) {
    print_message("'" + arguments.mesh + "' has no tetrahedra: there is nothing to look at");
    return exit_bad_input;
  }
  for (const auto& t : mesh.tetrahedra)
    for (const std::uint32_t v : t)
      if (v >= mesh.points.size()) throw Input_error(Input_problem::Kind::bad_index, "'" + arguments.mesh + "' names points that are not there: see pgdr check");
  const int exponent = mesh.exponent + exponent_for(mesh);
  mesh = scaled_to(std::move(mesh), exponent);
  Report report;
  report.title = std::filesystem::path(arguments.mesh).filename().string();
  report.subtitle = "as pgdr view shows it";
  write_report(mesh, report, page);
  if (is_shown && !open_in_browser(page)) print_message("no browser could be opened: the page is " + page.string());
  return exit_done;
}

}  // namespace

Command add_view_command(CLI::App& program) {
  const auto arguments = std::make_shared<View_arguments>();
  CLI::App* parser = program.add_subcommand("view", "Look at a mesh: a page with a picture to cut open, histograms and the worst tetrahedra");
  parser->add_option("MESH", arguments->mesh, "A .mesh, .vtu or .msh file")->required()->type_name("");
  parser->add_option("-o,--output", arguments->output, "Write the page here (.html), in place of showing it")->type_name("FILE");
  return {parser, [arguments] { return run_view(*arguments); }};
}

}  // namespace pgdr::app
