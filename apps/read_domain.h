// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_READ_DOMAIN_H
#define PGDR_APPS_READ_DOMAIN_H

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/input_error.h>

namespace pgdr::app {

using Domain = Domain_3<Default_kernel>;

/// How an input file is understood, as typed; shared by all commands so that they mean the same domain.
struct Domain_options {
  std::string coplanar_tolerance;  ///< empty: the library's default
  bool triangulate = false;
  std::string nesting;  ///< empty: the file format's own

  /// Adds `--coplanar-tolerance`, `--triangulate` and `--nested`; the object must outlive the parsing.
  void add_to(CLI::App& parser);

  /// The number behind `coplanar_tolerance`. Throws `Usage_error`.
  double tolerance() const;
};

/// Reads `path`. Throws `Input_error`.
Plc read_input(const std::filesystem::path& path, const Domain_options& options);

/// Understands what was read. Throws `Input_error` for what cannot be understood at all.
Domain understand(const Plc& plc, const Domain_options& options);

/// What is wrong with a domain, apart by whether it can be meshed nevertheless.
struct Problems {
  std::vector<Input_problem> errors;
  std::vector<Input_problem> warnings;  ///< seeds that name nothing
};
Problems sort_problems(const std::vector<Input_problem>& problems);

/// All that `validate_domain_3` finds.
Problems find_problems(const Domain& domain);

/// Prints the warnings on stderr and throws the errors as `Input_error`.
void print_or_throw(const Problems& problems);

}  // namespace pgdr::app

#endif
