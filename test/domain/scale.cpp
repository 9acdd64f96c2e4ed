// SPDX-License-Identifier: GPL-3.0-or-later
#include "catch.h"

#include <cmath>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/scale.h>
#include <pgdr/domain/summarize_domain_3.h>

#include "domain/shapes.h"

using namespace pgdr_test;

TEST_CASE("coordinates of usual size stay as they are") {
  for (const double size : {1.0, 1e-15, 1e15}) {
    const Plc plc = box({0, 0, 0}, {size, size, size});
    CHECK(pgdr::exponent_for(plc) == 0);
    CHECK(pgdr::normalized(plc).vertices == plc.vertices);
  }
}

TEST_CASE("very large and very small coordinates are scaled by a power of two, all lengths alike") {
  for (const int power : {70, 660, 1000, -70, -660, -900}) {
    const double unit = std::ldexp(1.0, power);
    Plc plc = box({0, 0, 0}, {unit, 1.5 * unit, 1.25 * unit});
    plc.holes.emplace_back(9 * unit, unit, unit);
    plc.regions.push_back({{unit / 2, unit / 2, unit / 2}, 3, 0, unit / 8});
    CAPTURE(power);
    const Plc scaled = pgdr::normalized(plc);
    CHECK(scaled.exponent == power);
    CHECK(scaled.vertices == box({0, 0, 0}, {1, 1.5, 1.25}).vertices);
    CHECK(scaled.holes[0] == Plc::Point_3(9, 1, 1));
    CHECK(scaled.regions[0].point == Plc::Point_3(0.5, 0.5, 0.5));
    CHECK(scaled.regions[0].max_circumradius == 0.125);
    CHECK(pgdr::normalized(scaled).exponent == power);
    const auto domain = pgdr::make_domain_3(plc);
    CHECK(domain.exponent == power);
    const auto summary = pgdr::summarize_domain_3(domain);
    CHECK(summary.upper == std::array<double, 3>{unit, 1.5 * unit, 1.25 * unit});
    // Messages have the user's coordinates.
    REQUIRE(summary.problems.size() == 1);
    char x[40];
    std::snprintf(x, sizeof x, "(%.9g, ", 9 * unit);
    CHECK(summary.problems[0].message.find(x) != std::string::npos);
  }
}

TEST_CASE("coordinates that cannot be scaled are refused in one sentence") {
  const auto refused = [](const Plc& plc, const char* why) {
    try {
      pgdr::make_domain_3(plc);
      return false;
    } catch (const pgdr::Input_error& e) {
      return e.problems().size() == 1 && std::string(e.what()).find(why) != std::string::npos;
    }
  };
  Plc far = box({0, 0, 0}, {1e200, 1e200, 1e200});
  far.vertices[0] = {1e-200, 0, 0};
  CHECK(refused(far, "too far apart"));
  CHECK(refused(box({0, 0, 0}, {1e308, 1e308, 1e308}), "no room"));
  CHECK(refused(box({0, 0, 0}, {1e-310, 1e-310, 1e-310}), "no room"));
}
