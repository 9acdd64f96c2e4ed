// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_domain.h"

#include <utility>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/scale.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/parameters.h>

#include "arguments.h"
#include "messages.h"

namespace pgdr::app {

void Domain_options::add_to(CLI::App& parser) {
  parser
      .add_option("--tolerance", tolerance,
                  "Take away edges, needles and caps smaller than this, changing the boundary by no more: a length, or a part of the "
                  "bounding box's diagonal as in 1e-4d; 0: mesh exactly what is in the file (default: 1e-6d for surfaces, 0 for .poly "
                  "and .smesh)")
      ->type_name("T");
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
  parser.add_option("--hole", holes, "Leave the enclosed volume around this point empty, as x,y,z; repeatable")
      ->type_name("POINT")
      ->allow_extra_args(false);
  parser
      .add_option("--region", regions,
                  "Mesh the enclosed volume around this point as region id, with circumradii up to R, as x,y,z:id or "
                  "x,y,z:id:R; repeatable")
      ->type_name("POINT:ID[:R]")
      ->allow_extra_args(false);
}

void Domain_options::check() const {
  fusing_tolerance();
  if (!tolerance.empty()) parse_length("--tolerance", tolerance);
  for (const std::string& text : holes) parse_point("--hole", text);
  for (const std::string& text : regions) parse_region(text);
}

double Domain_options::fusing_tolerance() const {
  if (coplanar_tolerance.empty()) return Parameters().coplanar_tolerance;
  return parse_tolerance("--coplanar-tolerance", coplanar_tolerance);
}

namespace {

/// STL is single precision, and what is closer than that has no meaning; what is written by hand has.
Length simplification(const std::filesystem::path& path, const Domain_options& options) {
  if (!options.tolerance.empty()) return parse_length("--tolerance", options.tolerance);
  return is_surface_file(path) ? Length{1e-6, true} : Length{};
}

bool can_be_meshed(const Plc& plc, const Domain_options& options) {
  try {
    return find_problems(understand(plc, options), 1).errors.empty();
  } catch (const Input_error&) {
    return false;
  }
}

}  // namespace

Input read_input(const std::filesystem::path& path, const Domain_options& options) {
  Input input{normalized(read_plc(path)), {}, {}};
  Plc& plc = input.plc;
  const double unit = unit_of(plc);
  if (!options.nesting.empty()) plc.nesting = options.nesting == "fill" ? Nesting::fill : Nesting::alternate;
  for (const std::string& text : options.holes) {
    const auto p = parse_point("--hole", text);
    plc.holes.emplace_back(p[0] / unit, p[1] / unit, p[2] / unit);
  }
  std::vector<Plc_region<Default_kernel>> regions;
  for (const std::string& text : options.regions) {
    Plc_region<Default_kernel>& r = regions.emplace_back(parse_region(text));
    r.point = {r.point.x() / unit, r.point.y() / unit, r.point.z() / unit};
    r.max_circumradius /= unit;
  }
  plc.regions.insert(plc.regions.begin(), regions.begin(), regions.end());  // the first seed of a volume counts

  const double tolerance = simplification(path, options).in_units(bounding_diagonal(plc));
  if (tolerance <= 0) return input;
  Simplification done;
  Plc simplified = simplify(plc, tolerance, &done);
  if (!done.is_none() && can_be_meshed(simplified, options)) input = {std::move(simplified), done, {}};
  try {
    input.plc = planarize(input.plc, options.fusing_tolerance(), options.triangulate, &input.planarization);
  } catch (const Input_error&) {
    // Said again, and with the file of problems, when the input is understood.
  }
  return input;
}

Domain understand(const Plc& plc, const Domain_options& options) {
  return make_domain_3(plc, options.fusing_tolerance(), options.triangulate);
}

void add_problems_option(CLI::App& parser, std::string& path) {
  parser
      .add_option("--problems", path,
                  "Write the facets, edges and vertices that make the input invalid, as .vtu for ParaView")
      ->type_name("FILE");
}

void add_problem_file(const std::string& path, std::vector<std::filesystem::path>& outputs) {
  if (path.empty()) return;
  require_extension("--problems", path, {".vtu"});
  outputs.emplace_back(path);
}

Problems sort_problems(const std::vector<Input_problem>& problems) {
  Problems sorted;
  for (const Input_problem& problem : problems) (problem.is_warning() ? sorted.warnings : sorted.errors).push_back(problem);
  return sorted;
}

Problems find_problems(const Domain& domain, std::size_t max_pairs) {
  return sort_problems(validate_domain_3(domain, max_pairs));
}

void print_or_throw(const Problems& problems) {
  for (const Input_problem& warning : problems.warnings) print_message("warning: " + warning.message);
  if (!problems.errors.empty()) throw Input_error(problems.errors);
}

}  // namespace pgdr::app
