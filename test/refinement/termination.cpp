// SPDX-License-Identifier: GPL-3.0-or-later
// The conditions of theorems 4 and 5 (docs/theory.md, section 10): without each there is no end.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/io/read_plc.h>
#include <pgdr/refine_mesh_3.h>

#include "catch.h"
#include "domain/shapes.h"
#include "inputs.h"
#include "refinement/refined.h"

using namespace pgdr_test;

namespace {

using Kernel = pgdr::Default_kernel;

/// A tenth of the distance from the middle of the box, but no less than `least`.
Sizing_function size_near_middle(double least) {
  return [least](const Kernel::Point_3& p) { return std::max(least, 0.1 * std::hypot(p.x() - 0.5, p.y() - 0.5, p.z() - 0.5)); };
}

pgdr::Parameters up_to(std::size_t vertices) {
  pgdr::Parameters parameters;
  parameters.max_vertices = vertices;
  return parameters;
}

}  // namespace

TEST_CASE("A sizing field that goes to zero has no end, and one that does not has", "[refinement]") {
  for (const std::size_t limit : {20000u, 80000u})
    CHECK(pgdr::refine_mesh_3(box(), size_near_middle(0), up_to(limit)).statistics().stop == pgdr::Stop_reason::vertex_budget);
  const auto mesh = pgdr::refine_mesh_3(box(), size_near_middle(0.01), up_to(80000));
  CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
}

TEST_CASE("A size that is negative or no number is an error that names the point", "[refinement]") {
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()})
    for (const unsigned threads : {1u, 3u}) {
      pgdr::Parameters parameters;
      parameters.threads = threads;
      const Sizing_function sizing = [bad](const Kernel::Point_3& p) { return p.x() > 0.75 && p.y() > 0.75 ? bad : 0.1; };
      try {
        pgdr::refine_mesh_3(box(), sizing, parameters);
        FAIL("a mesh was made");
      } catch (const pgdr::Sizing_error& e) {
        double x = 0, y = 0;
        CHECK(std::sscanf(e.what(), "the size at %lf,%lf,", &x, &y) == 2);
        CHECK((x > 0.75 && y > 0.75));
        CHECK(std::string(e.what()).find(std::isnan(bad) ? "nan" : "-1") != std::string::npos);
      }
    }
}

TEST_CASE("Sizes by distance hold where a circumradius is just the size far away", "[refinement]") {
  // All circumradii of a 2 by 3 by 6 box are 3.5, and its middle is 1 from its largest facets.
  const pgdr::Plc plc = box({0, 0, 0}, {2, 3, 6});
  std::vector<pgdr::Distance_sizing_field::Triangle> triangles;
  for (const double x : {0.0, 2.0}) triangles.insert(triangles.end(), {{{{x, 0, 0}, {x, 3, 0}, {x, 3, 6}}}, {{{x, 0, 0}, {x, 3, 6}, {x, 0, 6}}}});
  for (const auto& [everywhere, far] : {std::pair{std::numeric_limits<double>::infinity(), 3.5}, {3.5, 8.0}}) {
    const pgdr::Combined_sizing_field sizing(pgdr::Combined_sizing_field::Local(pgdr::Uniform_sizing_field(everywhere)),
                                           {pgdr::Distance_sizing_field(triangles, 0.3, far, 10)});
    const pgdr::Indexed_mesh_3 mesh = pgdr::indexed_mesh_3(pgdr::refine_mesh_3(plc, sizing));
    CHECK(mesh.tetrahedra.size() > 100);
    CHECK(oversized(mesh, sizing) == 0);
  }
}

TEST_CASE("A ratio bound below 1 has no end, and one below 2 is refused", "[refinement]") {
  const Sizing_function anything = same_size(std::numeric_limits<double>::infinity());
  const pgdr::Standard_placement at_circumcenters{pgdr::Point_placement::circumcenter, {1}};
  const auto stop = [&](double bound, std::size_t limit) {
    pgdr::Parameters parameters = up_to(limit);
    parameters.radius_edge_ratio = bound;
    using Mesher = pgdr::internal::Mesher_3<Kernel, Sizing_function, pgdr::Standard_placement>;
    return Mesher(pgdr::make_domain_3(tilted(box({0, 0, 0}, {3, 2, 1}))), anything, parameters, at_circumcenters).run().statistics().stop;
  };
  for (const std::size_t limit : {2000u, 8000u}) CHECK(stop(0.7, limit) == pgdr::Stop_reason::vertex_budget);
  CHECK(stop(2, 2000) == pgdr::Stop_reason::finished);
  pgdr::Parameters refused;
  refused.radius_edge_ratio = 1.9;
  CHECK_THROWS(refined(box(), 1, refused));
}

TEST_CASE("The rule of admission ends what small angles begin", "[refinement]") {
  // Fans of facets around an edge. Without the rule they have no end: a seeded fault of test/mutation.
  for (const char* name : {"fan_15.poly", "fan_197.poly", "fan_22.poly"}) {
    CAPTURE(name);
    const auto plc = pgdr::read_plc(data_file(std::string("../test/corpus/") + name));
    CHECK(refined(plc, std::numeric_limits<double>::infinity(), up_to(5000)).statistics().stop == pgdr::Stop_reason::finished);
  }
}
