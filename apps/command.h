// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_COMMAND_H
#define PGDR_APPS_COMMAND_H

#include <functional>

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

/// The whole program: parses, runs one subcommand, and turns every error into one sentence and an exit code.
int run_program(int argc, char** argv);

}  // namespace pgdr::app

#endif
