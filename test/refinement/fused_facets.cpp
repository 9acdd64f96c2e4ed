// SPDX-License-Identifier: GPL-3.0-or-later
// Facets that are not quite flat, fused up to the tolerance.
#include <limits>

#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "inputs.h"
#include "refinement/refined.h"

using namespace pgdr_test;

TEST_CASE("The mesh of a bent facet has no step at its border", "[refinement]") {
  // A step as high as the facet is bent, a thousandth of what is beside it, would be refined for ever.
  const Mesh mesh = refined(pgdr::read_plc(data_file("../test/corpus/bent_needle.poly")), std::numeric_limits<double>::infinity());
  REQUIRE(mesh.domain().facets.size() == 7);  // the four triangles are one
  const auto indexed = pgdr::indexed_mesh_3(mesh);
  CHECK(failures(pgdr::check_mesh(indexed, &mesh.domain())) == "");
  CHECK(indexed.tetrahedra.size() < 4000);
}
