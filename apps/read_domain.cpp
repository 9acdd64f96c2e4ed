// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_domain.h"

#include <utility>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/parameters.h>

#include "arguments.h"
#include "messages.h"

namespace pgdr::app {

void Domain_options::add_to(CLI::App& parser) {
  parser
      .add_option(
          "--coplanar-tolerance", coplanar_tolerance,
          "Fuse facets whose vertices are this close to one plane, relative to the bounding box's diagonal "
          "(default 1e-6)")
      ->type_name("T");
  parser.add_flag("--triangulate", triangulate, "Accept polygons that are not planar, as triangles");
  parser
      .add_option(
          "--nested", nesting,
          "What enclosed volumes without a hole seed are: 'fill' means material, 'alternate' means material "
          "and "
          "void in turn from the outside (default: fill for .poly and .smesh, alternate for surfaces)")
      ->type_name("MODE")
      ->check(CLI::IsMember({"alternate", "fill"}));
}

double Domain_options::tolerance() const {
  if (coplanar_tolerance.empty()) return Parameters().coplanar_tolerance;
  return parse_tolerance("--coplanar-tolerance", coplanar_tolerance);
}

Plc read_input(const std::filesystem::path& path, const Domain_options& options) {
  Plc plc = read_plc(path);
  if (!options.nesting.empty()) plc.nesting = options.nesting == "fill" ? Nesting::fill : Nesting::alternate;
  return plc;
}

Domain understand(const Plc& plc, const Domain_options& options) {
  return make_domain_3(plc, options.tolerance(), options.triangulate);
}

Problems sort_problems(const std::vector<Input_problem>& problems) {
  Problems sorted;
  for (const Input_problem& problem : problems) {
    const bool harmless = problem.kind == Input_problem::Kind::bad_seed;
    (harmless ? sorted.warnings : sorted.errors).push_back(problem);
  }
  return sorted;
}

Problems find_problems(const Domain& domain) { return sort_problems(validate_domain_3(domain)); }

void print_or_throw(const Problems& problems) {
  for (const Input_problem& warning : problems.warnings) print_message("warning: " + warning.message);
  if (!problems.errors.empty()) throw Input_error(problems.errors);
}

}  // namespace pgdr::app
