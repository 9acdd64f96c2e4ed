// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <string>

#include <pgdr/io/read_plc.h>
#include <pgdr/io/write_poly.h>

#include "../catch.h"
#include "../inputs.h"
#include "temporary_folder.h"

namespace {

struct Model {
  const char* name;
  std::size_t vertices, facets, holes, regions, first_index;
};

constexpr Model models[] = {
    {"a01_tetgen_example.poly", 28, 23, 2, 2, 1},
    {"a02_P_polygons.off", 26, 25, 0, 0, 0},
    {"a03_joint.off", 221, 446, 0, 0, 0},
    {"a14_bunny00.off", 37706, 75408, 0, 0, 0},
    {"a17_slit-10.smesh", 14, 13, 0, 0, 0},
    {"a19_airplane_in_box.poly", 8738, 17462, 1, 1, 0},
    {"a20_bird_in_box_2regions.poly", 2195, 4376, 0, 2, 0},
    {"a21_cgal_patches_3regions.poly", 1599, 3310, 0, 3, 0},
};

}  // namespace

TEST_CASE("real models have the counts that they should, and survive write_poly") {
  std::size_t found = 0;
  const pgdr_test::Temporary_folder folder;
  for (const Model& model : models) {
    const auto path = pgdr_test::input_model(model.name);
    if (!path) continue;
    ++found;
    CAPTURE(model.name);
    const auto plc = pgdr::read_plc(*path);
    CHECK(plc.vertices.size() == model.vertices);
    CHECK(plc.facets.size() == model.facets);
    CHECK(plc.holes.size() == model.holes);
    CHECK(plc.regions.size() == model.regions);
    CHECK(plc.first_index == model.first_index);
    CHECK(plc.segments.empty());
    pgdr::write_poly(plc, folder / "copy.poly");
    const auto copy = pgdr::read_plc(folder / "copy.poly");
    CHECK(copy.vertices == plc.vertices);
    REQUIRE(copy.facets.size() == plc.facets.size());
    CHECK(std::equal(copy.facets.begin(), copy.facets.end(), plc.facets.begin(),
                     [](const auto& a, const auto& b) {
                       return a.polygons == b.polygons && a.marker == b.marker && a.holes == b.holes;
                     }));
  }
  if (found == 0) PGDR_SKIP("there is no folder of real models");
}

TEST_CASE("TetGen's example comes through with markers, holes and regions") {
  const auto path = pgdr_test::input_model("a01_tetgen_example.poly");
  if (!path) PGDR_SKIP("there is no folder of real models");
  const auto plc = pgdr::read_plc(*path);
  REQUIRE(plc.vertex_markers.size() == 28);
  CHECK(plc.vertex_markers[4] == 9);
  REQUIRE(plc.facets.size() == 23);
  CHECK(plc.facets[1].marker == 9);
  CHECK(plc.facets[2].polygons.size() == 2);
  REQUIRE(plc.facets[2].holes.size() == 1);
  CHECK(plc.facets[2].holes[0] == pgdr::Plc::Point_3(1, 0, 2.25));
  REQUIRE(plc.regions.size() == 2);
  CHECK(plc.regions[1].point == pgdr::Plc::Point_3(1, 0.5, 4));
  CHECK(plc.regions[1].id == 20);
  CHECK(plc.regions[1].max_volume == 0.01);
}

TEST_CASE("every real model is readable") {
  std::error_code ignored;
  if (!std::filesystem::is_directory(pgdr_test::inputs_folder(), ignored))
    PGDR_SKIP("there is no folder of real models");
  for (const auto& entry : std::filesystem::directory_iterator(pgdr_test::inputs_folder())) {
    if (!pgdr::is_known_plc_extension(entry.path())) continue;
    CAPTURE(entry.path().string());
    CHECK_NOTHROW(pgdr::read_plc(entry.path()));
  }
}
