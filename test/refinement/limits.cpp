// SPDX-License-Identifier: GPL-3.0-or-later
// Limits hold, and what they leave is not called exempt.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <pgdr/mesh/scale_mesh.h>
#include <pgdr/mesh/tetrahedron_ball.h>

#include "catch.h"
#include "domain/shapes.h"
#include "refined.h"

using namespace pgdr_test;
using pgdr::Stop_reason;

namespace {

/// Smaller and smaller boxes around a point, down to 2^-40: a field that goes to zero.
pgdr::Combined_sizing_field vanishing() {
  std::vector<pgdr::Sizing_box> boxes;
  for (int k = 1; k <= 40; ++k) {
    const double r = std::ldexp(1.0, -k);
    boxes.push_back({{0.4 - r, 0.45 - r, 0.55 - r}, {0.4 + r, 0.45 + r, 0.55 + r}, r});
  }
  return pgdr::Combined_sizing_field(pgdr::Uniform_sizing_field(1), boxes);
}

}  // namespace

TEST_CASE("No edge is shorter than the minimum, whatever the size asks for", "[refinement]") {
  for (const auto placement : {pgdr::Point_placement::lazy, pgdr::Point_placement::circumcenter, pgdr::Point_placement::type1})
    for (const double minimum : {0.3, 0.1}) {
      pgdr::Parameters parameters;
      parameters.min_edge_length = minimum;
      parameters.placement = placement;
      parameters.verify = true;
      const auto refined_mesh = refined(box(), minimum / 8, parameters);
      const auto mesh = pgdr::indexed_mesh_3(refined_mesh);
      CAPTURE(minimum, static_cast<int>(placement));
      CHECK(shortest_edge(mesh) >= minimum);
      CHECK(mesh.points.size() > 20);
      CHECK(refined_mesh.statistics().stop == Stop_reason::min_edge_length);
      CHECK(refined_mesh.statistics().unrecovered == 0);
      CHECK(mesh.unrefined.size() == mesh.tetrahedra.size());
      CHECK(mesh.exempt.empty());
      CHECK(failures(pgdr::check_mesh(mesh, &refined_mesh.domain())) == "");
    }
}

TEST_CASE("A minimum edge length that the size does not reach changes nothing", "[refinement]") {
  pgdr::Parameters parameters;
  const auto without = pgdr::indexed_mesh_3(refined(box(), 0.1, parameters));
  parameters.min_edge_length = shortest_edge(without);
  const auto with = refined(box(), 0.1, parameters);
  CHECK(with.statistics().stop == Stop_reason::finished);
  CHECK(pgdr::indexed_mesh_3(with).tetrahedra == without.tetrahedra);
}

TEST_CASE("The minimum edge length does not keep like points from corners of a millionth of a radian", "[refinement]") {
  for (const double angle : {1e-5, 1e-6}) {
    // A needle, and a triangle at the needle's corner that is a ten-thousandth as long.
    Plc plc = box();
    const pgdr::Vec_3 corner{0.3, 0.3, 0.3};
    const auto add_triangle = [&](const pgdr::Vec_3& a, const pgdr::Vec_3& b) {
      const auto first = static_cast<pgdr::Index>(plc.vertices.size());
      for (const pgdr::Vec_3& p : {corner + a, corner + b}) plc.vertices.emplace_back(p.x, p.y, p.z);
      plc.facets.push_back({{{8, first, first + 1}}, {}, 0});
    };
    REQUIRE(plc.vertices.size() == 8);
    plc.vertices.emplace_back(corner.x, corner.y, corner.z);
    add_triangle({0.4, 0, 0}, {0.4, 0.4 * angle, 0});
    add_triangle({7e-5, 1e-5, 5e-5}, {2e-5, -6e-5, 4e-5});
    CAPTURE(angle);
    const Mesh mesh = refined(plc);
    CHECK(mesh.statistics().stop == Stop_reason::finished);
    CHECK(mesh.statistics().unrecovered == 0);
    const auto indexed = pgdr::indexed_mesh_3(mesh);
    CHECK(shortest_edge(indexed) < 1e-9);
    CHECK(failures(pgdr::check_mesh(indexed, &mesh.domain())) == "");
  }
}

TEST_CASE("A sizing field that goes to zero ends at the minimum edge length", "[refinement]") {
  pgdr::Parameters parameters;
  parameters.min_edge_length = 1e-4;
  parameters.min_dihedral = 0;  // or a choice of points leaves no circumcenter where the field is below the minimum
  const auto mesh = pgdr::refine_mesh_3(box(), vanishing(), parameters);
  const auto indexed = pgdr::indexed_mesh_3(mesh);
  CHECK(mesh.statistics().stop == Stop_reason::min_edge_length);
  CHECK(shortest_edge(indexed) >= 1e-4);
  CHECK_FALSE(indexed.unrefined.empty());
  CHECK(indexed.unrefined.size() < indexed.tetrahedra.size());
  CHECK(indexed.exempt.empty());
  CHECK(failures(pgdr::check_mesh(indexed, &mesh.domain())) == "");
}

TEST_CASE("What a stop leaves is listed as unrefined, all of it and nothing else", "[refinement]") {
  pgdr::Parameters parameters;
  parameters.max_vertices = 3000;
  for (const unsigned threads : {1u, 2u}) {
    parameters.threads = threads;
    const double size = 0.03;
    const auto refined_mesh = refined(box(), size, parameters);
    const auto mesh = pgdr::indexed_mesh_3(refined_mesh);
    CHECK(refined_mesh.statistics().stop == Stop_reason::vertex_budget);
    CHECK(mesh.exempt.empty());  // there is no small angle
    CHECK_FALSE(mesh.unrefined.empty());
    CHECK(std::ranges::is_sorted(mesh.unrefined));
    std::size_t poor = 0, found = 0;
    for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
      const auto& t = mesh.tetrahedra[i];
      const auto ball = pgdr::tetrahedron_ball(pgdr::Tetrahedron_points{pgdr::to_vec(mesh.points[t[0]]), pgdr::to_vec(mesh.points[t[1]]),
                                                pgdr::to_vec(mesh.points[t[2]]), pgdr::to_vec(mesh.points[t[3]])});
      const bool is_poor = ball.squared_radius > size * size || ball.squared_radius > 4 * ball.squared_shortest;
      poor += is_poor;
      found += is_poor && std::ranges::binary_search(mesh.unrefined, i);
    }
    CHECK(poor == found);
    CHECK(mesh.unrefined.size() == found);
  }
}

TEST_CASE("Limits of time and of memory stop with a valid mesh", "[refinement]") {
  for (const bool by_time : {true, false}) {
    pgdr::Parameters parameters;
    (by_time ? parameters.time_limit : parameters.min_edge_length) = by_time ? 0.2 : 0;
    if (!by_time) parameters.max_memory = pgdr::resident_memory_bytes() / 3 * 4 + (std::size_t{200} << 20);
    const auto refined_mesh = refined(box(), 0.002, parameters);
    CHECK(refined_mesh.statistics().stop == (by_time ? Stop_reason::time_limit : Stop_reason::memory_limit));
    CHECK(refined_mesh.statistics().stop_message.starts_with(by_time ? "stopped at the time limit" : "stopped at the limit of "));
    const auto mesh = pgdr::indexed_mesh_3(refined_mesh);
    CHECK_FALSE(mesh.unrefined.empty());
    CHECK(mesh.exempt.empty());
    CHECK(refined_mesh.statistics().unrecovered == 0);
  }
}

TEST_CASE("Where a stop leaves gaps in the boundary of a volume, only closed volumes are meshed", "[refinement]") {
  // Two bars cross in a box; the longer one's edges are not in the triangulation of the vertices, so that it is one with the box. Beside it a cube.
  auto plc = box();
  for (const auto& [lower, upper] : {std::pair<std::array<double, 3>, std::array<double, 3>>{{0.1, 0.49, 0.45}, {0.9, 0.51, 0.47}},
                                     {{0.49, 0.2, 0.5}, {0.51, 0.8, 0.52}},
                                     {{2, 0, 0}, {3, 1, 1}}})
    add_box(plc, lower, upper);
  const auto whole = refined(plc);
  CHECK(whole.statistics().volumes_left_out == 0);
  CHECK(pgdr::mesh_quality(pgdr::indexed_mesh_3(whole)).volume == Approx(2));
  CHECK(distinct(pgdr::indexed_mesh_3(whole).tetrahedron_references) == std::set<std::int32_t>{1, 2, 3, 4});

  pgdr::Parameters parameters;
  parameters.max_vertices = 1;
  const auto stopped = refined(plc, 10, parameters);
  CHECK(stopped.statistics().stop == Stop_reason::vertex_budget);
  CHECK(stopped.statistics().unrecovered > 0);
  CHECK(stopped.statistics().volumes_left_out == 2);
  CHECK(stopped.statistics().stop_message.ends_with("2 volumes are not closed yet, and left out"));
  const auto mesh = pgdr::indexed_mesh_3(stopped);
  CHECK(pgdr::mesh_quality(mesh).volume == Approx(1 + 0.6 * 0.02 * 0.02));
  CHECK(distinct(mesh.tetrahedron_references) == std::set<std::int32_t>{3, 4});
}

TEST_CASE("A caller's flag is seen beside other limits", "[refinement]") {
  const std::atomic<bool> cancel = true;
  pgdr::Parameters parameters;
  parameters.cancel = &cancel;
  parameters.time_limit = 1000;
  CHECK(refined(box(), 0.002, parameters).statistics().stop == Stop_reason::cancelled);
}

TEST_CASE("An octree too deep is refused", "[refinement]") {
  pgdr::Parameters parameters;
  for (const int depth : {-1, pgdr::Parameters::largest_octree_depth + 1, 50}) {
    parameters.octree_depth = depth;
    CHECK_THROWS_AS(refined(box(), 1, parameters), std::invalid_argument);
  }
}

TEST_CASE("The library leaves stray seeds out with a warning, and refuses ambiguous ones", "[refinement]") {
  auto plc = box();
  const auto whole = pgdr::mesh_checksum(pgdr::indexed_mesh_3(refined(plc, 0.3)));
  plc.holes.emplace_back(5, 5, 5);
  plc.regions.push_back({{-1, 0.5, 0.5}, 7, 0});
  const auto mesh = refined(plc, 0.3);
  CHECK(mesh.statistics().warnings.size() == 2);
  CHECK(pgdr::mesh_checksum(pgdr::indexed_mesh_3(mesh)) == whole);
  plc.holes.emplace_back(0.5, 0.5, 0);
  CHECK_THROWS_AS(refined(plc, 0.3), pgdr::Input_error);
}

TEST_CASE("A PLC scaled by a power of two gives the same mesh, scaled, however large or small", "[refinement]") {
  const auto whole = pgdr::indexed_mesh_3(refined(box(), 0.2));
  for (const int power : {3, -59, 64, 300, 665, -300, -890}) {
    const double unit = std::ldexp(1.0, power);
    pgdr::Parameters parameters;
    parameters.verify = true;
    const auto mesh = refined(box({0, 0, 0}, {unit, unit, unit}), 0.2 * unit, parameters);
    const auto indexed = pgdr::indexed_mesh_3(mesh);
    CAPTURE(power);
    CHECK(indexed.tetrahedra == whole.tetrahedra);
    CHECK(pgdr::scaled_to(indexed, power).points == whole.points);
    CHECK(failures(pgdr::check_mesh(indexed, &mesh.domain())) == "");
    const auto quality = pgdr::mesh_quality(indexed);
    CHECK(quality.max_circumradius <= 0.2 * unit);
    CHECK(quality.max_circumradius > 0.1 * unit);
    CHECK(quality.max_radius_edge_ratio == pgdr::mesh_quality(whole).max_radius_edge_ratio);
  }
}

TEST_CASE("Meshes too large to be numbered or checked are refused", "[refinement]") {
  const auto mesh = refined(box(), 0.2);
  const std::size_t cells = mesh.triangulation().tds().number_of_cells();
  CHECK_NOTHROW(pgdr::internal::Indexed_mesh_builder_3<pgdr::Default_kernel>(cells).gather(mesh));
  CHECK_THROWS_AS(pgdr::internal::Indexed_mesh_builder_3<pgdr::Default_kernel>(cells - 1).gather(mesh), std::length_error);
  const auto indexed = pgdr::indexed_mesh_3(mesh);
  pgdr::Check_options options;
  options.most_tetrahedra = indexed.tetrahedra.size();
  CHECK(pgdr::all_passed(pgdr::check_mesh(indexed, nullptr, options)));
  --options.most_tetrahedra;
  const auto lines = pgdr::check_mesh(indexed, nullptr, options);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].detail.find("cannot be checked") != std::string::npos);
}
