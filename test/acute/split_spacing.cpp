// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/acute/split_spacing_3.h>

#include <array>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/mesh/mesh_triangulation_3.h>

#include "catch.h"
#include "domain/shapes.h"

using namespace pgdr_test;
using pgdr::Spacing;
using pgdr::Split_reason;

TEST_CASE("On a bent facet nothing is as near as it is bent, but what is missing or for size") {
  using Tr = pgdr::Mesh_triangulation_3<pgdr::Default_kernel>;
  const pgdr::Plc plc = box();
  const auto domain = pgdr::make_domain_3(plc);
  const pgdr::Acute_neighborhood_3 acute(domain);
  const pgdr::Split_spacing_3<Tr> spacing(acute, 0);
  Tr tr;
  std::vector<Tr::Vertex_handle> v;
  for (const auto& p : plc.vertices) v.push_back(tr.insert(p));
  // On the facet below, 0.25 from its nearest vertex.
  const pgdr::Vec_3 m{0.25, 0, 0};
  pgdr::Cavity_3<Tr> cavity(tr);
  REQUIRE(cavity.find({m.x, m.y, m.z}, tr.finite_cells_begin()));
  const std::array corners{v[0], v[1], v[2]};
  const auto of = [&](Split_reason reason, double size, double bend) {
    pgdr::Split_guard guard;
    guard.size = size;
    return spacing.spacing(cavity, m, {2, 0}, corners, reason, guard, 0.7, bend);
  };
  CHECK(of(Split_reason::encroached, 0, 0) == Spacing::wide_enough);
  CHECK(of(Split_reason::encroached, 0, 0.24) == Spacing::wide_enough);
  CHECK(of(Split_reason::encroached, 0, 0.26) == Spacing::too_close);
  CHECK(of(Split_reason::encroached, 0.1, 0.26) == Spacing::wide_enough);
  CHECK(of(Split_reason::missing, 0, 0.26) == Spacing::wide_enough);
  cavity.abandon();
}
