// SPDX-License-Identifier: GPL-3.0-or-later
#include "arguments.h"

#include "catch.h"

namespace app = pgdr::app;

TEST_CASE("a refined box is read as typed", "[apps]") {
  const pgdr::Sizing_box box = app::parse_sizing_box("-19.89,-5.65,-5.61,6.5,8.05,5.61:0.25");
  CHECK(box.lower == std::array<double, 3>{-19.89, -5.65, -5.61});
  CHECK(box.upper == std::array<double, 3>{6.5, 8.05, 5.61});
  CHECK(box.radius == 0.25);
}

TEST_CASE("refined boxes that make no sense are refused", "[apps]") {
  for (const char* text : {"", ":", "0,0,0,1,1,1", "0,0,0,1,1,1:", "0,0,0,1,1:1", "0,0,0,1,1,1,1:1",
                           "0,0,0,1,1,1:0", "0,0,0,1,1,1:-1", "0,0,0,1,1,1:nan", "0,0,0,1,1,1:inf",
                           "0,0,0,1,1,inf:1", "nan,0,0,1,1,1:1", "1,0,0,1,1,1:1", "2,0,0,1,1,1:1",
                           "0,0,0,1,1,1:1x", "0, 0,0,1,1,1:1", "a,0,0,1,1,1:1", "0,0,0,1,1,:1", ",,,,,:1"}) {
    INFO(text);
    CHECK_THROWS_AS(app::parse_sizing_box(text), app::Usage_error);
  }
}

TEST_CASE("balls and sizes near surfaces are read as typed", "[apps]") {
  const pgdr::Sizing_ball ball = app::parse_sizing_ball("-1,2.5,1e3,0:0.25");
  CHECK(ball.center == std::array<double, 3>{-1, 2.5, 1000});
  CHECK((ball.extent == 0 && ball.radius == 0.25));
  for (const char* text : {"", ":", "0,0,0,1", "0,0,0:1", "0,0,0,1,1:1", "0,0,0,-1:1", "0,0,0,1:0", "0,0,0,1:-1", "0,0,0,1:nan", "0,0,0,1:inf", "0,0,inf,1:1", "0,0,0,1:1x"}) {
    INFO(text);
    CHECK_THROWS_AS(app::parse_sizing_ball(text), app::Usage_error);
  }
  const app::Sizes_near_surface sizes = app::parse_sizes_near_surface("0.1:0.5:2");
  CHECK((sizes.near == 0.1 && sizes.far == 0.5 && sizes.reach == 2));
  for (const char* text : {"", "::", "0.1:0.5", "0.1,0.5,2", "0.1:0.5,2", "0.1:0.5:2:3", "0:0.5:2", "0.6:0.5:2", "0.1:inf:2", "0.1:0.5:0", "0.1:0.5:0.4", "0.1:0.5:-1", "nan:1:1", "a:1:1"}) {
    INFO(text);
    CHECK_THROWS_AS(app::parse_sizes_near_surface(text), app::Usage_error);
  }
}

TEST_CASE("seeds are read as typed", "[apps]") {
  CHECK(app::parse_point("--hole", "-1,2.5,1e3") == std::array<double, 3>{-1, 2.5, 1000});
  const auto plain = app::parse_region("1,2,3:-4"), sized = app::parse_region("1,2,3:7:0.25");
  CHECK(plain.point.y() == 2);
  CHECK(plain.id == -4);
  CHECK(plain.max_circumradius == 0);
  CHECK(sized.id == 7);
  CHECK(sized.max_circumradius == 0.25);
  CHECK(sized.max_volume == 0);
  for (const char* text : {"", "1,2", "1,2,3,4", "1,2,nan", "1,2,inf", "1,2,3x", "1;2;3", "1,2,", ",,"}) {
    INFO(text);
    CHECK_THROWS_AS(app::parse_point("--hole", text), app::Usage_error);
  }
  for (const char* text : {"", "1,2,3", "1,2,3:", "1,2,3:x", "1,2,3:1.5", "1,2:3", "1,2,3:4:", "1,2,3:4:0", "1,2,3:4:-1",
                           "1,2,3:4:nan", "1,2,3:4:inf", "1,2,3:4:5:6", "1,2,3::5", "1,2,3:99999999999"}) {
    INFO(text);
    CHECK_THROWS_AS(app::parse_region(text), app::Usage_error);
  }
}

TEST_CASE("placements on the command line", "[apps]") {
  CHECK(app::parse_placement("circumcenter") == pgdr::Point_placement::circumcenter);
  CHECK(app::parse_placement("type1") == pgdr::Point_placement::type1);
  CHECK(app::parse_placement("type2") == pgdr::Point_placement::type2);
  CHECK(app::parse_placement("lazy") == pgdr::Point_placement::lazy);
  for (const char* text : {"", "Type1", "best-dihedral", "center"})
    CHECK_THROWS_AS(app::parse_placement(text), app::Usage_error);
}

TEST_CASE("numbers on the command line", "[apps]") {
  CHECK(app::parse_positive("--size", "0.1") == 0.1);
  CHECK(app::parse_positive("--size", "1e-3") == 1e-3);
  CHECK(app::parse_tolerance("--coplanar-tolerance", "0") == 0);
  CHECK(app::parse_ratio_bound("--radius-edge-ratio", "2") == 2);
  CHECK(app::parse_count("--threads", "16") == 16);
  for (const char* text : {"", "0", "-1", "nan", "inf", "1e999", "1,5", "abc", "0.1x"}) {
    INFO(text);
    CHECK_THROWS_AS(app::parse_positive("--size", text), app::Usage_error);
  }
  for (const char* text : {"-1e-9", "1", "nan", "x"}) {
    INFO(text);
    CHECK_THROWS_AS(app::parse_tolerance("--coplanar-tolerance", text), app::Usage_error);
  }
  for (const char* text : {"1.99", "0", "-2", "inf", "nan"}) {
    INFO(text);
    CHECK_THROWS_AS(app::parse_ratio_bound("--radius-edge-ratio", text), app::Usage_error);
  }
  for (const char* text : {"0", "-1", "1.5", "", "many", "99999999999999999999999"}) {
    INFO(text);
    CHECK_THROWS_AS(app::parse_count("--threads", text), app::Usage_error);
  }
}

TEST_CASE("an output is neither the input nor another output", "[apps]") {
  CHECK_NOTHROW(app::require_distinct_files({"a.poly"}, {"a.vtu", "a.mesh"}));
  CHECK_THROWS_AS(app::require_distinct_files({"a.poly"}, {"./a.poly"}), app::Usage_error);
  CHECK_THROWS_AS(app::require_distinct_files({"a.poly"}, {"b.vtu", "c/../b.vtu"}), app::Usage_error);
}
