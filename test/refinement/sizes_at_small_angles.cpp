// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <pgdr/domain/vec_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>
#include <pgdr/sizing/combined_sizing_field.h>

#include "catch.h"
#include "domain/shapes.h"
#include "refinement/refined.h"

using namespace pgdr_test;
using pgdr::Plc;

namespace {

/// A box with a segment across one of its facets, at 45 degrees with its edges.
Plc box_with_diagonal() {
  Plc plc = box();
  plc.segments.push_back({0, 3, 0});
  return plc;
}

struct Over_size {
  std::size_t circumradii = 0;  ///< above the size at the circumcenter
  double longest = 0;           ///< edge, over twice the size at its middle
};

Over_size over_size(const Mesh& mesh, const auto& sizing) {
  Over_size over;
  for (const auto c : mesh.triangulation().finite_cell_handles()) {
    if (c->subdomain() == 0) continue;
    const auto p = pgdr::tetrahedron_points(c);
    const auto ball = pgdr::tetrahedron_ball(p);
    const auto size = [&](const pgdr::Vec_3& q) { return sizing(pgdr::Default_kernel::Point_3(q.x, q.y, q.z)); };
    over.circumradii += std::sqrt(ball.squared_radius) > (1 + 1e-6) * size(ball.center);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) over.longest = std::max(over.longest, pgdr::length(p[i] - p[j]) / (2 * size(0.5 * (p[i] + p[j]))));
  }
  return over;
}

/// A field, and how long an edge can be at most where all circumradii keep to it, over twice the size at its middle: the circumcenter, where the size
/// is asked for, is no farther from there than the radius.
struct Sizes {
  pgdr::Combined_sizing_field field;
  double gradation = 0;
  double longest() const { return 1 / (1 - gradation); }
};

std::vector<Sizes> different_sizes() {
  const auto uniform = [](double size) { return Sizes{pgdr::Combined_sizing_field(pgdr::Uniform_sizing_field(size))}; };
  const pgdr::Combined_sizing_field::Local ball(pgdr::Uniform_sizing_field(0.3), {}, {{{0, 0, 0}, 0.1, 0.01}}, 0.4);
  return {uniform(0.1), uniform(0.03), {pgdr::Combined_sizing_field(ball), 0.4}};
}

}  // namespace

TEST_CASE("Sizes hold next to small angles of segments", "[refinement]") {
  for (const Plc& plc : {box_with_diagonal(), triangular_prism(45)})
    for (const Sizes& sizes : different_sizes()) {
      const Over_size over = over_size(pgdr::refine_mesh_3(plc, sizes.field), sizes.field);
      CHECK(over.circumradii == 0);
      CHECK(over.longest <= sizes.longest());
    }
}

TEST_CASE("Next to small dihedral angles no edge is longer than sizes allow", "[refinement]") {
  for (const double degrees : {30.0, 10.0, 3.0})
    for (const Sizes& sizes : different_sizes()) {
      CAPTURE(degrees);
      const Mesh mesh = pgdr::refine_mesh_3(triangular_prism(degrees), sizes.field);
      CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
      CHECK(over_size(mesh, sizes.field).longest <= sizes.longest());
    }
}

TEST_CASE("Bounds of regions hold next to small angles, too", "[refinement]") {
  for (const double volume : {1e-4, 1e-5}) {
    Plc plc = triangular_prism(45);
    plc.regions.push_back({{0.5, 0.1, 0.5}, 7, volume, 0});
    const Mesh mesh = refined(plc, std::numeric_limits<double>::infinity());
    double largest = 0;
    for (const auto c : mesh.triangulation().finite_cell_handles())
      if (c->subdomain() != 0) largest = std::max(largest, pgdr::tetrahedron_ball(pgdr::tetrahedron_points(c)).volume);
    CHECK(largest <= (1 + 1e-9) * volume);
  }
}
