// SPDX-License-Identifier: GPL-3.0-or-later
// Where tetrahedra were given up next to small angles, vertices may be moved as long as that leaves no more of these (docs/theory.md, section 12).
#include <pgdr/slivers/vertex_mover_3.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "inputs.h"
#include "refinement/refined.h"

using namespace pgdr_test;

namespace {

using Tr = Mesh::Triangulation;
using Criteria = pgdr::Quality_criteria_3<pgdr::Default_kernel, pgdr::Uniform_sizing_field>;
using Judge = pgdr::Tetrahedron_judge<Criteria>;
using Mover = pgdr::Vertex_mover_3<Tr, Criteria>;

/// Those above the bound of the ratio, and the largest ratio, squared.
struct Exempt {
  std::size_t count = 0;
  double squared_ratio = 0;

  Exempt(const Tr& tr, const Criteria& criteria) {
    for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) {
      if (c->subdomain() == 0) continue;
      const pgdr::Tetrahedron_ball ball = pgdr::tetrahedron_ball(pgdr::tetrahedron_points(Tr::Cell_handle(c)));
      squared_ratio = std::max(squared_ratio, ball.squared_ratio());
      if (!criteria.is_over_ratio(ball)) continue;
      ++count;
      CHECK(c->state() == pgdr::Cell_state::exempt);
    }
  }
};

/// Moves all vertices once; returns how many were moved.
std::size_t moves(Mesh& mesh, const Criteria& criteria, const Judge& judge) {
  Tr& tr = mesh.triangulation();
  std::vector<Tr::Vertex_handle> inside;
  for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v)
    if (v->in_dimension() == 3 && v->cell()->subdomain() != 0) inside.push_back(v);
  std::ranges::sort(inside, {}, [](Tr::Vertex_handle v) { return std::tuple(v->point().x(), v->point().y(), v->point().z()); });
  Mover mover(tr, mesh.complex(), judge, {});
  Exempt before(tr, criteria);
  CHECK(before.count > 0);
  std::size_t moved = 0;
  for (const Tr::Vertex_handle v : inside) {
    if (mover.improve(v, pgdr::cosine_of_degrees(20)) != Mover::Outcome::moved) continue;
    ++moved;
    const Exempt after(tr, criteria);
    CHECK(after.count <= before.count);
    CHECK(after.squared_ratio <= before.squared_ratio * (1 + 1e-9));
    before = after;
  }
  return moved;
}

}  // namespace

TEST_CASE("Moves next to small angles leave no more exempt tetrahedra than there were, and none with a larger ratio", "[slivers]") {
  for (const char* file : {"fan_141.poly", "fan_155.poly", "fan_36.poly"}) {
    CAPTURE(file);
    const pgdr::Plc plc = pgdr::read_plc(data_file(std::string("../test/corpus/") + file));
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    pgdr::Parameters parameters;
    parameters.min_dihedral = 0;
    Mesh mesh = refined(plc, unbounded, parameters);
    const pgdr::Acute_neighborhood_3 acute(mesh.domain());
    const Criteria criteria(2, pgdr::Uniform_sizing_field(unbounded), mesh.subdomains(), pgdr::unit_of(mesh.domain()));
    CHECK(moves(mesh, criteria, Judge(criteria, 0, &acute)) > 10);
    REQUIRE(mesh.triangulation().is_valid());
    CHECK(failures(pgdr::check_mesh(pgdr::indexed_mesh_3(mesh), &mesh.domain())) == "");
  }
}
