// SPDX-License-Identifier: GPL-3.0-or-later
// Recovery and labelling, seen through the front door.
#include <algorithm>
#include <map>

#include "catch.h"
#include "conforming/consistency.h"
#include "conforming/gridded_box.h"
#include "refinement/refined.h"

using namespace pgdr_test;

namespace {

/// Meshed cells whose four vertices all lie on one facet with nothing meshed beyond.
std::size_t flat_boundary_cells(const Mesh& mesh) {
  const auto& tr = mesh.triangulation();
  const auto& complex = mesh.complex();
  std::vector<char> outer(mesh.domain().facets.size(), 0);
  for (auto c = tr.all_cells_begin(); c != tr.all_cells_end(); ++c)
    for (int i = 0; i < 4; ++i)
      if (c->subdomain() != 0 && c->subfacet(i) != Mesh::Complex::none && c->neighbor(i)->subdomain() == 0)
        outer[complex.subfacet(c->subfacet(i)).facet] = 1;
  std::size_t flat = 0;
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c)
    for (pgdr::Index f = 0; f < outer.size() && c->subdomain() != 0; ++f) {
      int on = 0;
      for (int i = 0; outer[f] && i < 4; ++i) on += complex.is_on_facet(c->vertex(i), f);
      flat += on == 4;
    }
  return flat;
}

void require_good(const Mesh& mesh) {
  CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
  CHECK(inconsistency(mesh.triangulation(), mesh.complex()) == "");
  const auto indexed = pgdr::indexed_mesh_3(mesh);
  CHECK(failures(pgdr::check_mesh(indexed, &mesh.domain())) == "");
  CHECK(indexed.exempt.empty());
  CHECK(flat_boundary_cells(mesh) == 0);
}

/// Volumes by region id.
std::map<std::int32_t, double> volumes(const Plc& plc) {
  const Mesh mesh = refined(plc);
  const auto indexed = pgdr::indexed_mesh_3(mesh);
  CHECK(failures(pgdr::check_mesh(indexed, &mesh.domain())) == "");
  return pgdr::mesh_quality(indexed).region_volumes;
}

Plc nested_boxes(pgdr::Nesting nesting) {
  Plc plc;
  add_box(plc, {0, 0, 0}, {5, 5, 5});
  add_box(plc, {1, 1, 1}, {4, 4, 4});
  add_box(plc, {2, 2, 2}, {3, 3, 3});
  plc.nesting = nesting;
  return plc;
}

}  // namespace

TEST_CASE("A tilted facet with many cocircular vertices leaves no flat tetrahedra", "[conforming]") {
  const Plc plc = tilted(gridded_box(32));
  const auto domain = pgdr::make_domain_3(plc);
  REQUIRE(domain.facets.size() == 6);
  require_good(refined(plc));
}

TEST_CASE("Tilted grids of many sizes are meshed", "[conforming]") {
  for (const pgdr::Index n : {1u, 2u, 3u, 5u, 9u})
    for (const double size : {std::numeric_limits<double>::infinity(), 0.7}) {
      CAPTURE(n, size);
      require_good(refined(tilted(gridded_box(n)), size));
    }
}

TEST_CASE("A tilted cylinder with a polygon of cocircular corners as cap is meshed", "[conforming]") {
  for (const pgdr::Index n : {4u, 8u, 20u, 40u}) {
    CAPTURE(n);
    SECTION("upright " + std::to_string(n)) { require_good(refined(cylinder(n))); }
    SECTION("tilted " + std::to_string(n)) { require_good(refined(tilted(cylinder(n)))); }
  }
}

TEST_CASE("A hole seed empties its volume", "[conforming]") {
  Plc plc;
  add_box(plc, {0, 0, 0}, {3, 3, 3});
  add_box(plc, {1, 1, 1}, {2, 2, 2});
  const auto filled = volumes(plc);
  REQUIRE(filled.size() == 2);
  CHECK(filled.at(1) == Approx(26));
  CHECK(filled.at(2) == Approx(1));
  plc.holes.emplace_back(1.5, 1.6, 1.7);
  const auto hollow = volumes(plc);
  REQUIRE(hollow.size() == 1);
  CHECK(hollow.at(1) == Approx(26));
  plc.holes = {{0.5, 0.6, 0.7}};
  const auto core = volumes(plc);
  REQUIRE(core.size() == 1);
  CHECK(core.at(1) == Approx(1));
}

TEST_CASE("Region seeds name the volumes around them", "[conforming]") {
  Plc plc;
  add_box(plc, {0, 0, 0}, {1, 1, 1});
  add_box(plc, {2, 0, 0}, {4, 1, 1});
  plc.regions = {{{0.5, 0.4, 0.3}, 17, 0}, {{2.5, 0.4, 0.3}, -4, 0}};
  const auto v = volumes(plc);
  REQUIRE(v.size() == 2);
  CHECK(v.at(17) == Approx(1));
  CHECK(v.at(-4) == Approx(2));
}

TEST_CASE("Nested shells are filled, or alternate between material and void", "[conforming]") {
  const auto filled = volumes(nested_boxes(pgdr::Nesting::fill));
  REQUIRE(filled.size() == 3);
  CHECK(filled.at(1) == Approx(98));
  CHECK(filled.at(2) == Approx(26));
  CHECK(filled.at(3) == Approx(1));
  const auto alternate = volumes(nested_boxes(pgdr::Nesting::alternate));
  REQUIRE(alternate.size() == 2);
  CHECK(alternate.at(1) == Approx(98));
  CHECK(alternate.at(2) == Approx(1));
}

TEST_CASE("Volumes without a seed get ids that no seed uses", "[conforming]") {
  Plc plc = nested_boxes(pgdr::Nesting::fill);
  add_box(plc, {6, 0, 0}, {8, 1, 1});
  plc.regions = {{{1.5, 1.5, 1.5}, 1, 0}, {{7, 0.5, 0.5}, 3, 0}};
  const auto v = volumes(plc);
  REQUIRE(v.size() == 4);
  CHECK(v.at(1) == Approx(26));  // its seed
  CHECK(v.at(3) == Approx(2));   // its seed
  CHECK(v.at(2) == Approx(98));  // the outermost shell has the smallest vertex
  CHECK(v.at(4) == Approx(1));
}
