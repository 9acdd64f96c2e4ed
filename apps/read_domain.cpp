// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_domain.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <pgdr/domain/patches.h>
#include <pgdr/domain/scale.h>
#include <pgdr/domain/valid_domain.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/parameters.h>
#include <pgdr/repair/degenerate_facets.h>
#include <pgdr/report/format.h>

#include "arguments.h"
#include "messages.h"

namespace pgdr::app {

void Domain_options::add_to(CLI::App& parser) {
  parser
      .add_option("--tolerance", tolerance,
                  "Take away edges, needles and caps smaller than this, and make one plane facet of triangles that are within it of a plane, "
                  "changing the boundary by no more: a length, or a part of the bounding box's diagonal as in 1e-4d; 0: mesh exactly "
                  "what is in the file (default: 1e-6d for surfaces, 0 for .poly and .smesh)")
      ->type_name("T");
  parser
      .add_option(
          "--coplanar-tolerance", coplanar_tolerance,
          "Fuse facets whose vertices are this close to one plane, relative to the bounding box's diagonal "
          "(default 1e-6)")
      ->type_name("T");
  parser.add_flag("--triangulate", triangulate, "Accept polygons that are not planar, as triangles");
  parser.add_flag("--repair", repair,
                  "Make dirty surfaces valid: duplicates, cracks up to the tolerance, holes, wrong orientations, self-intersections");
  parser
      .add_option("--fill-holes", largest_hole,
                  "With --repair: the width of the largest hole to be filled, as --tolerance is given (default: 0.5d)")
      ->type_name("SIZE");
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
  parser
      .add_option("--markers-from", markers_from,
                  "What in a surface file becomes markers of facets: 'names' (default) of solids (.stl), or groups and materials (.obj); 'colors' of faces (.off, .ply); "
                  "or 'nothing'")
      ->type_name("WHAT")
      ->check(CLI::IsMember({"names", "colors", "nothing"}));
  parser.add_option("--patch-angle", patch_angle, "Give facets without a marker one for each patch, divided at edges where the surface turns by more than A degrees")
      ->type_name("A");
  parser.add_option("--name-marker", marker_names, "Call a marker by a name in what is written, as 3=inlet; repeatable")->type_name("M=NAME")->allow_extra_args(false);
  parser.add_option("--name-region", region_names, "The same for a region, as 1=water; repeatable")->type_name("ID=NAME")->allow_extra_args(false);
}

void Domain_options::check() const {
  fusing_tolerance();
  if (!tolerance.empty()) parse_length("--tolerance", tolerance);
  if (!largest_hole.empty()) parse_length("--fill-holes", largest_hole);
  if (!largest_hole.empty() && !repair) throw Usage_error("--fill-holes goes with --repair");
  for (const std::string& text : holes) parse_point("--hole", text);
  for (const std::string& text : regions) parse_region(text);
  if (!patch_angle.empty()) parse_patch_angle(patch_angle);
  parse_names("--name-marker", marker_names);
  parse_names("--name-region", region_names);
}

bool Domain_options::is_any_given() const {
  return !tolerance.empty() || !coplanar_tolerance.empty() || triangulate || repair || !largest_hole.empty() || !nesting.empty() || !holes.empty() || !regions.empty() ||
         markers_from != "names" || changes_references();
}

double Domain_options::fusing_tolerance() const {
  if (coplanar_tolerance.empty()) return Parameters().coplanar_tolerance;
  return parse_tolerance("--coplanar-tolerance", coplanar_tolerance);
}

namespace {

constexpr Length default_tolerance{1e-6, true};

/// STL is single precision, and what is closer than that has no meaning; what is written by hand has.
Length simplification(const std::vector<std::string>& files, const Domain_options& options) {
  if (!options.tolerance.empty()) return parse_length("--tolerance", options.tolerance);
  return std::ranges::all_of(files, is_surface_file) ? default_tolerance : Length{};
}

Markers_from source_of_markers(const Domain_options& options) {
  return options.markers_from == "names" ? Markers_from::names : options.markers_from == "colors" ? Markers_from::colors : Markers_from::nothing;
}

/// Patches, and names that the options give.
void mark_and_name(Plc& plc, const Domain_options& options) {
  if (!options.patch_angle.empty()) mark_patches(plc, parse_patch_angle(options.patch_angle));
  for (const auto& [marker, name] : parse_names("--name-marker", options.marker_names))
    if (std::ranges::none_of(plc.facets, [m = marker](const auto& facet) { return facet.marker == m; }))
      print_message("warning: --name-marker: no facet has the marker " + std::to_string(marker));
    else
      plc.names.markers[marker] = name;
  for (const auto& [id, name] : parse_names("--name-region", options.region_names)) plc.names.regions[id] = name;
}

/// Of the bounding box of all parts.
double bounding_diagonal(const std::vector<Plc>& parts) {
  Plc all;
  for (const Plc& part : parts) all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
  all.exponent = parts[0].exponent;
  return pgdr::bounding_diagonal(all);
}

/// What is in the files, repaired if it shall be, or if there are several. Of a surface, facets without area are taken away in any case.
Plc repaired_input(const std::vector<std::string>& files, const Domain_options& options, Repair_report& report) {
  if (options.markers_from == "colors") require_one_of_format("--markers-from colors", files, {".off", ".ply"});
  std::vector<Plc> parts;
  for (const std::string& file : files) parts.push_back(normalized(read_plc(file, source_of_markers(options))));
  if (!options.repair && parts.size() == 1) {
    if (is_surface_file(files[0])) report.degenerate_triangles = take_degenerate_facets_away(parts[0]);
    return std::move(parts[0]);
  }
  const double diagonal = bounding_diagonal(parts);
  const Length gap = options.tolerance.empty() ? default_tolerance : parse_length("--tolerance", options.tolerance);
  const Length hole = options.largest_hole.empty() ? Length{options.repair ? 0.5 : 0.0, true} : parse_length("--fill-holes", options.largest_hole);
  const Repair_options how{gap.in_units(diagonal), hole.in_units(diagonal)};
  return parts.size() == 1 ? repair(parts[0], how, &report) : assemble(parts, how, &report);
}

}  // namespace

std::vector<std::filesystem::path> files_of(const std::vector<std::string>& inputs) {
  std::vector<std::filesystem::path> files;
  for (const std::string& input : inputs)
    for (auto& file : plc_files(input)) files.push_back(std::move(file));
  return files;
}

Input read_input(const std::vector<std::string>& files, const Domain_options& options) {
  Input input;
  Plc plc = repaired_input(files, options, input.repair);
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

  const double diagonal = bounding_diagonal(plc), tolerance = simplification(files, options).in_units(diagonal);
  if (tolerance > 0 && tolerance >= diagonal) throw Usage_error("--tolerance has to be less than the bounding box's diagonal, which is " + significant(diagonal, 4));
  input.plc = simplify_as_far_as_valid(plc, tolerance, options.fusing_tolerance(), options.accepts_bent_polygons(), &input.simplified);
  if (!options.tolerance.empty() && input.simplified.used < tolerance && !input.simplified.is_none())
    print_message("warning: --tolerance: with " + significant(tolerance, 3) + " elements would be no larger, or angles smaller, so that " + significant(input.simplified.used, 3) + " is used");
  mark_and_name(input.plc, options);
  if (options.changes_references()) input.simplified.understood.reset();
  return input;
}

Understood understand(Input& input, const Domain_options& options, std::size_t max_pairs) {
  if (std::optional known = std::exchange(input.simplified.understood, std::nullopt)) return std::move(*known);
  return pgdr::understand(input.plc, options.fusing_tolerance(), options.accepts_bent_polygons(), max_pairs);
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

void print_or_throw(const Problems& problems) {
  for (const Input_problem& warning : problems.warnings) print_message("warning: " + warning.message);
  if (!problems.errors.empty()) throw Input_error(problems.errors);
}

}  // namespace pgdr::app
