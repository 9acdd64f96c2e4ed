// SPDX-License-Identifier: GPL-3.0-or-later
#include "catch.h"

#include <cstddef>
#include <string>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/plc_from_domain_3.h>
#include <pgdr/domain/summarize_domain_3.h>
#include <pgdr/io/read_plc.h>

#include "domain/shapes.h"
#include "inputs.h"

using namespace pgdr_test;
using pgdr::make_domain_3;
using Kind = pgdr::Input_problem::Kind;

namespace {

/// What is known about a model.
struct Expected {
  const char* name;
  std::size_t vertices, segments, facets, volumes;
  double dihedral, plane_angle;
};

const Expected models[] = {
    {"a01_tetgen_example.poly", 28, 44, 23, 5, 63.4349, 63.4349},
    {"a02_P_polygons.off", 26, 39, 15, 2, 90, 90},
    {"a03_joint.off", 221, 326, 109, 2, 90, 90},
    {"a05_fandisk.off", 6475, 11979, 7429, 2, 87.62, 16.75},
    {"a09_elephant.off", 2775, 8332, 5553, 2, 61.05, 30.01},
    {"a11_knot2.off", 5760, 17273, 11513, 3, 105.4, 12.66},
    {"a14_bunny00.off", 37706, 112765, 75061, 2, 144.2, 25.00},
    {"a15_skull_100k.off", 49999, 149629, 99628, 2, 14.51, 0.1019},
    {"a16_wedge-10.smesh", 6, 9, 5, 2, 9.851, 9.851},
    {"a17_slit-10.smesh", 14, 21, 10, 2, 38.30, 38.30},
    {"a18_spike-10-10.smesh", 11, 20, 11, 2, 80.62, 6.061},
    {"a19_airplane_in_box.poly", 8738, 24452, 15767, 3, 47.88, 19.12},
    {"a21_cgal_patches_3regions.poly", 1599, 4858, 3263, 4, 74.61, 22.09},
};

}  // namespace

TEST_CASE("real models are understood") {
  std::size_t found = 0;
  for (const Expected& e : models) {
    const auto path = input_model(e.name);
    if (!path) continue;
    ++found;
    INFO(e.name);
    const auto d = make_domain_3(pgdr::read_plc(*path));
    const auto s = pgdr::summarize_domain_3(d);
    for (const auto& p : s.problems) UNSCOPED_INFO(p.message);
    CHECK(s.problems.empty());
    CHECK(s.vertices == e.vertices);
    CHECK(s.segments == e.segments);
    CHECK(s.facets == e.facets);
    CHECK(s.volumes.size() == e.volumes);
    CHECK(s.closed);
    CHECK(s.open_edges == 0);
    CHECK(s.smallest_dihedral_deg == Approx(e.dihedral).epsilon(1e-3));
    CHECK(s.smallest_plane_angle_deg == Approx(e.plane_angle).epsilon(1e-3));
  }
  if (found == 0) PGDR_SKIP("the real models are not here");
}

TEST_CASE("real models survive being written and read") {
  std::size_t found = 0;
  for (const Expected& e : models) {
    const auto path = input_model(e.name);
    if (!path || e.vertices > 10000) continue;
    ++found;
    INFO(e.name);
    const auto d = make_domain_3(pgdr::read_plc(*path));
    const auto again = make_domain_3(pgdr::plc_from_domain_3(d));
    CHECK(again.vertices == d.vertices);
    REQUIRE(again.segments.size() == d.segments.size());
    REQUIRE(again.facets.size() == d.facets.size());
    bool same = true;
    for (std::size_t i = 0; i < d.segments.size(); ++i)
      same = same && again.segments[i].vertices == d.segments[i].vertices;
    for (std::size_t i = 0; i < d.facets.size(); ++i)
      same = same && again.facets[i].segments == d.facets[i].segments;
    CHECK(same);
  }
  if (found == 0) PGDR_SKIP("the real models are not here");
}

TEST_CASE("bad models are told what is wrong") {
  const auto camel = input_model("a22_bad_camel_selfint.off"), head = input_model("a23_bad_head_open.off"),
             sliding = input_model("a24_bad_degtri_sliding.off");
  if (!camel || !head || !sliding) PGDR_SKIP("the real models are not here");
  const auto crossing = pgdr::validate_domain_3(make_domain_3(pgdr::read_plc(*camel)), 100);
  CHECK(crossing.size() == 20);
  CHECK(count(crossing, Kind::self_intersection) == 20);
  const auto open = pgdr::summarize_domain_3(make_domain_3(pgdr::read_plc(*head)));
  CHECK(count(open.problems, Kind::open_surface) == 10);  // as many as are named
  CHECK(open.open_edges == 58);
  try {
    make_domain_3(pgdr::read_plc(*sliding));
    FAIL("degenerate facets were accepted");
  } catch (const pgdr::Input_error& e) {
    CHECK(count(e.problems(), Kind::degenerate_facet) == 4);
  }
}
