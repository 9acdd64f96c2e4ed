// SPDX-License-Identifier: GPL-3.0-or-later
// Theorem 6 (docs/theory.md, section 12): moves of tasks with territories do not disturb each other, so that their order is of no matter.
#include <pgdr/slivers/vertex_mover_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/refinement/divide_worklist_3.h>

#include "catch.h"
#include "inputs.h"
#include "refinement/refined.h"

using namespace pgdr_test;

namespace {

using Tr = Mesh::Triangulation;
using Criteria = pgdr::Quality_criteria_3<pgdr::Default_kernel, pgdr::Uniform_sizing_field>;
using Mover = pgdr::Vertex_mover_3<Tr, Criteria>;

struct Moved {
  pgdr::Indexed_mesh_3 mesh;
  std::size_t moves = 0, foreign = 0;
};

/// A mesh of which every task moves what it may of its territory, one task after the other, in one of many orders.
Moved moved(const pgdr::Plc& plc, double size, std::size_t territories, double share, unsigned order) {
  pgdr::Parameters parameters;
  parameters.min_dihedral = 0;
  Mesh mesh = refined(plc, size, parameters);
  Tr& tr = mesh.triangulation();
  const Criteria criteria(2, pgdr::Uniform_sizing_field(size), mesh.subdomains(), pgdr::unit_of(mesh.domain()));
  const pgdr::Territories_3<Tr> division(tr, {pgdr::sample_vertices(tr, tr.number_of_vertices()), territories, share});

  std::vector<std::vector<Tr::Vertex_handle>> parts(territories);
  for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v)
    if (v->in_dimension() == 3 && v->cell()->subdomain() != 0) parts[division.of(pgdr::position(Tr::Vertex_handle(v)))].push_back(v);
  const auto place = [](Tr::Vertex_handle v) { return std::tuple(v->point().x(), v->point().y(), v->point().z()); };
  for (auto& part : parts) std::ranges::sort(part, {}, place);

  std::vector<std::size_t> turns(territories);
  std::iota(turns.begin(), turns.end(), std::size_t{0});
  std::mt19937 random(order);
  if (order > 0) std::ranges::shuffle(turns, random);
  Moved result;
  const double wanted = pgdr::cosine_of_degrees(14);
  for (const std::size_t k : turns) {
    Mover mover(tr, mesh.complex(), {criteria, 0}, division[k]);
    for (const Tr::Vertex_handle v : parts[k])
      for (const Mover::Outcome outcome : {mover.improve(v, wanted), mover.smooth(v, wanted)}) {
        result.moves += outcome == Mover::Outcome::moved;
        result.foreign += outcome == Mover::Outcome::foreign;
      }
  }
  REQUIRE(tr.is_valid());
  result.mesh = pgdr::indexed_mesh_3(std::move(mesh));
  return result;
}

}  // namespace

TEST_CASE("Theorem 6: in whatever order tasks with territories move vertices, the mesh is the same", "[slivers]") {
  for (const auto& [file, size] : {Sized_shape{"cube.poly", 0.05}, {"two_regions.poly", 0.08}, {"winged_body_in_box.poly", 2.5}})
    for (const auto& [territories, share] : {std::pair{std::size_t{8}, 0.5}, {std::size_t{16}, 0.4}}) {
      CAPTURE(file, territories);
      const pgdr::Plc plc = pgdr::read_plc(data_file(file));
      const Moved first = moved(plc, size, territories, share, 0);
      CHECK(first.moves > 100);
      CHECK(first.foreign > 100);  // there are borders to be seen
      for (unsigned order = 1; order <= 2; ++order) {
        const Moved other = moved(plc, size, territories, share, order);
        CHECK(other.moves == first.moves);
        CHECK(equal(other.mesh, first.mesh));
      }
    }
}

TEST_CASE("Moves leave no tetrahedron above the bounds of ratio and size", "[slivers]") {
  constexpr double size = 0.05;
  const Moved cube = moved(pgdr::read_plc(data_file("cube.poly")), size, 8, 0.5, 0);
  CHECK(cube.moves > 100);
  const pgdr::Mesh_quality quality = pgdr::mesh_quality(cube.mesh);
  CHECK(quality.max_radius_edge_ratio <= 2);
  CHECK(quality.max_circumradius <= size * (1 + 1e-6));
}
