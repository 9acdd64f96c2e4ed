// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/acute/split_guard_3.h>

#include <array>
#include <optional>
#include <vector>

#include <pgdr/domain/make_domain_3.h>

#include "catch.h"
#include "domain/shapes.h"
#include "refinement/refined.h"

using namespace pgdr_test;

TEST_CASE("A chain of tetrahedra that each halve what the one before kept has an end at a twentieth of its relaxed radius") {
  using Tr = Mesh::Triangulation;
  const auto domain = pgdr::make_domain_3(box());
  const pgdr::Acute_neighborhood_3 acute(domain);
  Tr tr;
  const double edge = 0.125;
  std::vector<Tr::Vertex_handle> v;
  for (const auto& p : std::vector<Tr::Point>{{0, 0, 0}, {edge, 0, 0}, {0, 1, 0}, {0, 0, 1}}) v.push_back(tr.insert(p));
  const Tr::Cell_handle c = tr.finite_cells_begin();
  pgdr::Tetrahedron_points corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = pgdr::position(c->vertex(static_cast<int>(i)));
  const auto ball = pgdr::tetrahedron_ball(corners);
  const auto guard = [&](double a, double b, std::optional<double> size = {}) {
    const std::array relaxed{a, b};
    for (const std::size_t k : {0u, 1u}) {
      v[k]->set_insertion_radius(relaxed[k] > 0 ? edge : 0);
      v[k]->relax_radius(relaxed[k]);
    }
    return pgdr::split_guard(c, ball, corners, size, acute);
  };
  CHECK(guard(edge, edge).floor == Approx(edge / 2));
  CHECK(guard(edge, edge).relaxed == Approx(edge));
  CHECK(guard(2, 1).floor == Approx(edge / 2));
  CHECK(guard(2, 1).relaxed == Approx(1));
  CHECK(guard(2, 2).floor == Approx(0.1));
  CHECK(guard(2, 2).relaxed == Approx(2));
  // Vertices of the input limit nothing, and inherit nothing.
  CHECK(guard(0, 2).floor == Approx(0.1));
  CHECK(guard(0, 0).floor == Approx(edge / 2));
  CHECK(guard(0, 0).relaxed == Approx(edge));
  CHECK(guard(2, 2, 0.04).floor == Approx(0.01));
}
