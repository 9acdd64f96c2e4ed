// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_COMMAND_H
#define PGDR_APPS_COMMAND_H

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace pgdr::app {

/// A subcommand: how its arguments are read, and what it does once they are. Returns the exit code.
struct Command {
  CLI::App* parser = nullptr;
  std::function<int()> run;
};

Command add_mesh_command(CLI::App& program);
Command add_check_command(CLI::App& program);
Command add_info_command(CLI::App& program);
Command add_view_command(CLI::App& program);

/// `--quality FILE`, of those that have a mesh.
inline void add_quality_option(CLI::App& parser, std::string& path) {
  parser.add_option("--quality", path, "Write the quality of every tetrahedron, as comma-separated values")->type_name("FILE");
}

/// The whole program: parses, runs one subcommand, and turns every error into one sentence and an exit code.
int run_program(int argc, char** argv);

}  // namespace pgdr::app

#endif
