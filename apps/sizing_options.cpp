// SPDX-License-Identifier: GPL-3.0-or-later
#include "sizing_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <pgdr/domain/input_error.h>
#include <pgdr/domain/scale.h>
#include <pgdr/io/read_sizes.h>
#include <pgdr/report/format.h>
#include <pgdr/sizing/curvature_sizes.h>
#include <pgdr/sizing/edge_length.h>
#include <pgdr/sizing/facet_sizes.h>
#include <pgdr/sizing/grid_sizing_field.h>
#include <pgdr/sizing/local_feature_sizes.h>
#include <pgdr/sizing/nodal_sizing_field.h>

#include "arguments.h"
#include "messages.h"
#include "size_expression.h"

namespace pgdr::app {

void Sizing_options::add_to(CLI::App& parser) {
  parser.add_option("--size", size, "Upper bound of the circumradius of every tetrahedron")
      ->type_name("R");
  parser
      .add_option("--edge-length", edge_length,
                  "Edges of about this length where nothing asks for shorter ones: short for --size L/1.35, of which no edge is longer than 1.5 L")
      ->type_name("L");
  parser.add_option("--max-volume", max_volume, "Upper bound of the volume of every tetrahedron, as the circumradius of the regular one")->type_name("V");
  parser
      .add_option(
          "--refine-box", refine_boxes,
          "Upper bound R of the circumradius inside a box, as x0,y0,z0,x1,y1,z1:R; repeatable, the smallest "
          "bound wins")
      ->type_name("BOX:R")
      ->allow_extra_args(false);
  parser
      .add_option("--size-ball", size_balls,
                  "Upper bound R of the circumradius inside a ball, as x,y,z,r:R; r may be 0; repeatable")
      ->type_name("BALL:R")
      ->allow_extra_args(false);
  parser
      .add_option("--size-near-surface", near_surface,
                  "Upper bound of the circumradius by the circumcenter's distance from the input's facets: R0 on them, R1 at the distance D and beyond, linear in between")
      ->type_name("R0:R1:D");
  parser
      .add_option("--facet-size", facet_sizes,
                  "Upper bound R of the circumradius of tetrahedra on the facets with a marker, a number or a name, growing by --gradation (0.5) around them; repeatable")
      ->type_name("MARKER:R")
      ->allow_extra_args(false);
  parser
      .add_option("--curvature", curvature,
                  "N edges around a full turn of a curved surface, which facets that meet at less than 40 degrees stand for; away from it sizes grow by --gradation (0.5)")
      ->type_name("N");
  parser
      .add_option("--cells-across", cells_across,
                  "N edges across walls and whatever else is narrow, measured between facets of a region that face each other; away from it sizes grow by --gradation (0.5)")
      ->type_name("N");
  parser
      .add_option("--size-expression", expression,
                  "Upper bound of the circumradius by the circumcenter's x, y and z, as in \"0.1+0.2*abs(x)\" (muParser's syntax; functions like sin are "
                  "the C library's, so meshes may differ between processors)")
      ->type_name("TEXT")
      ->check([](const std::string& text) { return text.empty() ? std::string("it is empty") : std::string(); });
  parser
      .add_option("--size-field", field_file,
                  "Upper bound of the circumradius from an array of a background mesh (.vtu) or image (.vti), linear between its points")
      ->type_name("FILE:ARRAY");
  parser
      .add_option("--gradation", gradation,
                  "Let the bounds of boxes, balls and markers grow by G for each unit of distance around them, instead of ending there (default: no bound around them)")
      ->type_name("G");
}

namespace {

/// How fast sizes grow around facets with a size of their own where --gradation does not say: in halves of the distance.
constexpr double gradation_of_facets = 0.5;

/// The circumradius of the regular tetrahedron, which of all with this circumradius has the largest volume: 8 sqrt(3) / 27 of its cube.
double circumradius_of_volume(double volume) { return std::cbrt(volume * 27 / (8 * std::sqrt(3.0))); }

double radius_everywhere(const Sizing_options& options) {
  double radius = Uniform_sizing_field().radius();
  if (!options.size.empty()) radius = parse_positive("--size", options.size);
  if (!options.edge_length.empty()) radius = std::min(radius, parse_positive("--edge-length", options.edge_length) / mean_edge);
  if (!options.max_volume.empty()) radius = std::min(radius, circumradius_of_volume(parse_positive("--max-volume", options.max_volume)));
  return radius;
}

struct Facet_size {
  std::string marker;  ///< a number or a name
  double radius = 0;
};

/// "3:0.1" or "inlet:0.1"; a name may hold colons.
Facet_size parse_facet_size(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) throw Usage_error("--facet-size: '" + text + "' is not of the form MARKER:R");
  return {text.substr(0, colon), parse_positive("--facet-size", text.substr(colon + 1))};
}

/// "sizes.vtu:h"; the file may have colons in its name.
std::pair<std::string, std::string> parse_field(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon + 1 == text.size()) throw Usage_error("--size-field: '" + text + "' is not of the form FILE:ARRAY");
  std::string file = text.substr(0, colon);
  require_extension("--size-field", file, {".vtu", ".vti"});
  return {std::move(file), text.substr(colon + 1)};
}

Combined_sizing_field::Function field_of(const std::string& text) {
  const auto [file, array] = parse_field(text);
  const Nodal_values nodes = read_nodal_values(file, array);
  try {
    // What is regular needs no triangulation. A slice of an image, or one that runs backwards, is points like any.
    const auto is_solid = [](const Sizing_grid& g) {
      return std::ranges::all_of(g.nodes, [](std::size_t n) { return n > 1; }) && std::ranges::all_of(g.spacing, [](double s) { return s > 0; });
    };
    if (nodes.grid && is_solid(*nodes.grid))
      return [field = Grid_sizing_field(*nodes.grid, nodes.values)](const std::array<double, 3>& p) { return field.size_at(p); };
    return [field = Nodal_sizing_field(nodes.points, nodes.values)](const std::array<double, 3>& p) { return field.size_at(p); };
  } catch (const std::invalid_argument& error) {
    throw Input_error(Input_problem::Kind::unreadable, "'" + file + "', '" + array + "': " + error.what());
  }
}

Distance_sizing_field sizes_on(const Domain& domain, const Facet_size& size, double gradation, double everywhere) {
  const std::vector<int> markers = markers_named(domain, size.marker);
  const bool is_there = std::ranges::any_of(domain.facets, [&](const auto& facet) { return std::ranges::find(markers, facet.marker) != markers.end(); });
  if (is_there) return facet_sizes(domain, markers, size.radius, gradation, everywhere);
  std::string known;
  for (const auto& [marker, name] : domain.names.markers) known += (known.empty() ? "; names are " : ", ") + name;
  throw Usage_error("--facet-size: no facet has the marker '" + size.marker + "'" + known);
}

/// A place that is nowhere near the domain is a slip, more often than not.
void warn_of_places_outside(const Combined_sizing_field::Local& sizes, const Domain& domain) {
  const double unit = unit_of(domain);
  const auto warn = [&](const std::string& what, const auto& lower, const auto& upper) {
    bool is_outside = false;
    for (std::size_t k = 0; k < 3; ++k) is_outside |= lower(k) > unit * domain.upper[k] || upper(k) < unit * domain.lower[k];
    if (is_outside) print_message("warning: the refined " + what + " lies outside of the input");
  };
  const auto text = [](const std::array<double, 3>& p) { return significant(p[0]) + "," + significant(p[1]) + "," + significant(p[2]); };
  for (const Sizing_box& box : sizes.boxes())
    warn("box from " + text(box.lower), [&](std::size_t k) { return box.lower[k]; }, [&](std::size_t k) { return box.upper[k]; });
  for (const Sizing_ball& ball : sizes.balls())
    warn("ball around " + text(ball.center), [&](std::size_t k) { return ball.center[k] - ball.extent; },
         [&](std::size_t k) { return ball.center[k] + ball.extent; });
}

}  // namespace

Combined_sizing_field::Local Sizing_options::local() const {
  const Uniform_sizing_field everywhere(radius_everywhere(*this));
  std::vector<Sizing_box> boxes;
  for (const std::string& box : refine_boxes) boxes.push_back(parse_sizing_box(box));
  std::vector<Sizing_ball> balls;
  for (const std::string& ball : size_balls) balls.push_back(parse_sizing_ball(ball));
  double growth = Combined_sizing_field::Local::no_gradation;
  if (!gradation.empty()) {
    growth = parse_positive("--gradation", gradation);
    if (!(growth < 1)) throw Usage_error("--gradation must be less than 1, because nothing bounds sizes that grow faster than the distance, not " + gradation);
    if (boxes.empty() && balls.empty() && facet_sizes.empty() && curvature.empty() && cells_across.empty())
      throw Usage_error(
          "--gradation is of boxes, balls, markers, curvature and narrow parts: it needs --refine-box, --size-ball, --facet-size, --curvature or --cells-across");
  } else if (std::ranges::any_of(balls, [](const Sizing_ball& ball) { return ball.extent == 0; })) {
    throw Usage_error("--size-ball: a ball with a radius of 0 needs --gradation, because no circumcenter is exactly there");
  }
  return Combined_sizing_field::Local(everywhere, std::move(boxes), std::move(balls), growth);
}

void Sizing_options::check() const {
  local();
  if (!near_surface.empty()) parse_sizes_near_surface(near_surface);
  for (const std::string& text : facet_sizes) parse_facet_size(text);
  if (!curvature.empty()) parse_positive("--curvature", curvature);
  if (!cells_across.empty()) parse_positive("--cells-across", cells_across);
  if (!expression.empty()) parse_size_expression(expression);
  if (!field_file.empty()) parse_field(field_file);
}

Combined_sizing_field Sizing_options::field(const Domain& domain) const {
  const Combined_sizing_field::Local places = local();
  warn_of_places_outside(places, domain);
  std::vector<Distance_sizing_field> by_distance;
  if (!near_surface.empty()) {
    const Sizes_near_surface sizes = parse_sizes_near_surface(near_surface);
    by_distance.emplace_back(facet_triangles_of(domain), sizes.near, sizes.far, sizes.reach);
  }
  const double growth = gradation.empty() ? gradation_of_facets : parse_positive("--gradation", gradation);
  for (const std::string& text : facet_sizes) by_distance.push_back(sizes_on(domain, parse_facet_size(text), growth, places.outer().radius()));
  if (!curvature.empty())
    std::ranges::move(curvature_sizes(domain, parse_positive("--curvature", curvature), growth, places.outer().radius()), std::back_inserter(by_distance));
  if (!cells_across.empty())
    std::ranges::move(local_feature_sizes(domain, parse_positive("--cells-across", cells_across), growth, places.outer().radius()), std::back_inserter(by_distance));
  std::vector<Combined_sizing_field::Function> functions;
  if (!expression.empty()) functions.push_back(parse_size_expression(expression));
  if (!field_file.empty()) functions.push_back(field_of(field_file));
  return Combined_sizing_field(places, std::move(by_distance), std::move(functions));
}

}  // namespace pgdr::app
