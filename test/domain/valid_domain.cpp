// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/valid_domain.h>

#include <algorithm>
#include <optional>
#include <vector>

#include <pgdr/domain/plc.h>

#include "catch.h"
#include "domain/shapes.h"

using namespace pgdr;
using namespace pgdr_test;

namespace {

std::vector<Index> facets_alone(const Plc& plc) {
  std::vector<Index> alone;
  for (Index f = 0; f < plc.facets.size(); ++f)
    if (plc.facets[f].group == fused_with_none) alone.push_back(f);
  return alone;
}

}  // namespace

TEST_CASE("Facets stay alone that would intersect others once they are fused", "[domain]") {
  const Plc plc = box_above_valley(1e-7);
  REQUIRE(!understand(plc, 1e-6).is_valid());
  const std::optional<Plc> fused = fused_where_valid(plc, 1e-6);
  REQUIRE(fused);
  CHECK(facets_alone(*fused) == std::vector<Index>{2, 3});  // not the valley without a box
  CHECK(understand(*fused, 1e-6).is_valid());

  const std::optional<Plc> as_it_is = fused_where_valid(box_above_valley(1e-4), 1e-6);
  REQUIRE(as_it_is);
  CHECK(facets_alone(*as_it_is).empty());

  Plc dirty = plc;
  add_box(dirty, {-0.01, -0.01, 1.4}, {0.01, 0.01, 1.6});
  CHECK(!fused_where_valid(dirty, 1e-6));
  dirty.facets[0].polygons[0][0] = 1000;  // no vertex
  CHECK(!fused_where_valid(dirty, 1e-6));
}
