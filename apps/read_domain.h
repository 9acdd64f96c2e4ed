// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_READ_DOMAIN_H
#define PGDR_APPS_READ_DOMAIN_H

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/input_error.h>
#include <pgdr/io/write_problems.h>
#include <pgdr/repair/repair.h>
#include <pgdr/simplify/simplify_within.h>

namespace pgdr::app {

using Domain = Domain_3<Default_kernel>;

/// How an input file is understood, as typed; shared by all commands so that they mean the same domain.
struct Domain_options {
  std::string tolerance;           ///< empty: 1e-6 of the diagonal for surface files, 0 for PLCs
  std::string coplanar_tolerance;  ///< empty: the library's default
  bool triangulate = false;
  bool repair = false;
  std::string largest_hole;  ///< empty: half of the diagonal
  std::string nesting;  ///< empty: the file format's own
  std::vector<std::string> holes;    ///< seeds besides those of the file
  std::vector<std::string> regions;  ///< seeds that count before those of the file
  std::string markers_from = "names";
  std::string patch_angle;  ///< empty: no patches
  std::vector<std::string> marker_names, region_names;

  /// Adds the options; the object must outlive the parsing.
  void add_to(CLI::App& parser);

  /// Refuses nonsense before anything is read. Throws `Usage_error`.
  void check() const;

  /// Polygons that are not plane become triangles.
  bool accepts_bent_polygons() const { return triangulate || repair; }

  /// Whether one of them is not as by default.
  bool is_any_given() const;

  /// Whether markers or names become others than those of the file.
  bool changes_references() const { return !patch_angle.empty() || !marker_names.empty() || !region_names.empty(); }

  /// The number behind `coplanar_tolerance`. Throws `Usage_error`.
  double fusing_tolerance() const;
};

/// An input as it is meshed.
struct Input {
  Plc plc;  ///< with the seeds of the options
  Repair_report repair;
  Simplification_within simplified;
};

/// Reads a file, or several as the parts of an assembly, repairs it if the options say so, simplifies it as far as they say, and makes its
/// fused facets plane; the latter not at all if the result could not be meshed, so that what is wrong is said of what is in the file.
/// Throws `Input_error`.
Input read_input(const std::vector<std::string>& files, const Domain_options& options);

/// All files that are read for these.
std::vector<std::filesystem::path> files_of(const std::vector<std::string>& inputs);

/// How many intersecting pairs to list: those that fit on a screen, or all for a file.
inline std::size_t pairs_to_list(const std::string& problem_file = {}) {
  return problem_file.empty() ? 10 : std::numeric_limits<std::size_t>::max();
}

/// Understands what was read, and finds what is wrong with it; what was understood while it was simplified is taken from `input`.
/// \param max_pairs see `validate_domain_3`
/// Throws `Input_error` for what cannot be understood at all.
Understood understand(Input& input, const Domain_options& options, std::size_t max_pairs = pairs_to_list());

/// Adds `--problems`.
void add_problems_option(CLI::App& parser, std::string& path);

/// Adds the file of `--problems`, if there is one, to the outputs. Throws `Usage_error` unless it ends in .vtu.
void add_problem_file(const std::string& path, std::vector<std::filesystem::path>& outputs);

/// Does `work`, and writes the problems of the `Input_error` that it throws, if it does, to a file for ParaView; without
/// one, a file without cells. Nothing is written where `path` is empty.
template <class Work>
void with_problem_file(const std::string& path, const Plc& plc, const Work& work) {
  try {
    work();
  } catch (const Input_error& error) {
    if (!path.empty()) write_problems(plc, error.problems(), path);
    throw;
  }
  if (!path.empty()) write_problems(plc, {}, path);
}

/// What is wrong with a domain, apart by whether it can be meshed nevertheless.
struct Problems {
  std::vector<Input_problem> errors;
  std::vector<Input_problem> warnings;  ///< seeds that name nothing
};
Problems sort_problems(const std::vector<Input_problem>& problems);

/// Prints the warnings on stderr and throws the errors as `Input_error`.
void print_or_throw(const Problems& problems);

}  // namespace pgdr::app

#endif
