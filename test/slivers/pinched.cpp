// SPDX-License-Identifier: GPL-3.0-or-later
// What a short edge between features makes flat is not worth a try (docs/theory.md, section 12).
#include <pgdr/slivers/sliver_3.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <pgdr/domain/reproducible_functions.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/quality/shape_measures.h>

#include "catch.h"
#include "inputs.h"
#include "refinement/refined.h"

using namespace pgdr_test;

namespace {

using Tr = Mesh::Triangulation;
using Sliver = pgdr::Sliver_3<Tr>;

constexpr double wanted_degrees = 5;

/// f(sliver) for all that are below the wanted angle.
void for_slivers(const Mesh& mesh, const auto& f) {
  const double wanted = pgdr::cosine_of_degrees(wanted_degrees);
  for (const auto c : mesh.triangulation().finite_cell_handles()) {
    std::vector<Sliver> found;
    if (c->subdomain() != 0) Sliver::add_if_below(c, wanted, found);
    for (const Sliver& s : found) f(s);
  }
}

}  // namespace

TEST_CASE("A pinched tetrahedron has half of the wanted angle at most, and a short edge between features", "[slivers]") {
  const double half = std::sqrt(1 - std::pow(0.5 * std::sin(wanted_degrees * std::numbers::pi / 180), 2));
  std::size_t pinched = 0, others = 0;
  for (const char* file : {"fan_1097", "fan_120", "fan_134", "fan_141", "fan_15", "fan_155"}) {
    CAPTURE(file);
    pgdr::Parameters parameters;
    parameters.min_dihedral = 0;
    const Mesh mesh = refined(pgdr::read_plc(data_file(std::string("../test/corpus/") + file + ".poly")), std::numeric_limits<double>::infinity(), parameters);
    for_slivers(mesh, [&](const Sliver& s) {
      ++(s.is_pinched ? pinched : others);
      if (!s.is_pinched) return;
      CHECK(s.cosine > half);
      for (const std::size_t i : pgdr::shortest_edge(pgdr::tetrahedron_points(s.cell))) CHECK(s.cell->vertex(static_cast<int>(i))->in_dimension() < 3);
      CHECK_FALSE(s.is_flat());
    });
  }
  CHECK(pinched > 10);
  CHECK(others > 10);
}

TEST_CASE("A tetrahedron is pinched by a short edge whose ends do not move, and by no other", "[slivers]") {
  // An edge seen from the opposite one under atan(edge), unless that is turned towards it.
  const auto is_pinched = [](double edge, int one_end, int other_end, const Tr::Point& last = {0, 1, 1}) {
    Tr tr;
    std::vector<Tr::Vertex_handle> v;
    for (const Tr::Point& p : {Tr::Point(0, 0, 0), Tr::Point(edge, 0, 0), Tr::Point(0, 1, 0), last}) v.push_back(tr.insert(p));
    v[0]->set_feature(one_end, 0);
    v[1]->set_feature(other_end, 0);
    std::vector<Sliver> found;
    Sliver::add_if_below(Tr::Cell_handle(tr.finite_cells_begin()), pgdr::cosine_of_degrees(wanted_degrees), found);
    return found.at(0).is_pinched;
  };
  const double half = 0.5 * std::sin(wanted_degrees * std::numbers::pi / 180);
  CHECK(is_pinched(0.99 * half, 1, 2));
  CHECK_FALSE(is_pinched(1.01 * half, 1, 2));
  CHECK_FALSE(is_pinched(0.5 * half, 3, 2));
  CHECK_FALSE(is_pinched(0.5 * half, 1, 3));
  CHECK_FALSE(is_pinched(1e-7, 1, 2));  // flat as no input is
  CHECK(is_pinched(0.5 * half, 1, 2, {1, 1, 1}));
  CHECK_FALSE(is_pinched(0.5 * half, 1, 2, {1, 1, 0.01}));  // flat for another reason
}
