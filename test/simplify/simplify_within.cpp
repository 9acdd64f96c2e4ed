// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/simplify/simplify_within.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/simplify/narrowness.h>
#include <pgdr/simplify/surface_distance.h>

#include "catch.h"
#include "domain/shapes.h"
#include "inputs.h"

using namespace pgdr;
using namespace pgdr_test;

namespace {

/// A round bar of n strips, two triangles each, whose corners are off their cylinder by at most `noise`: no strip is plane.
Plc noisy_bar(Index n, double noise) {
  Plc bar = triangulated(cylinder(n));
  for (Index i = 0; i < bar.vertices.size(); ++i) {
    const auto& p = bar.vertices[i];
    const double s = 1 + noise * std::sin(17.0 * i);
    bar.vertices[i] = {s * p.x(), s * p.y(), p.z()};
  }
  return bar;
}

}  // namespace

TEST_CASE("Strips that are plane within the tolerance become plane facets", "[simplify]") {
  const Plc bar = noisy_bar(48, 1e-4);
  CHECK(make_domain_3(bar).facets.size() == 2 * 48 + 2);
  const double tolerance = 1e-3 * bounding_diagonal(bar);
  Simplification_within done;
  const Plc simpler = simplify_within(bar, tolerance, 1e-6, false, &done);
  CHECK(done.planarization.flattened_facets > 0);
  const auto domain = make_domain_3(simpler);
  CHECK(domain.facets.size() == 48 + 2);
  CHECK(validate_domain_3(domain).empty());
  const auto distance = surface_distance(bar, simpler, tolerance);
  REQUIRE(distance);
  CHECK(distance->is_within);
  CHECK(distance->seen > 1e-6);
  // Within less than they are off nothing is done, and with no tolerance nothing at all.
  CHECK(make_domain_3(simplify_within(bar, 1e-5, 1e-6)).facets.size() == 2 * 48 + 2);
  CHECK(simplify_within(bar, 0, 1e-6, false, &done).vertices == bar.vertices);
  CHECK(done.is_none());
}

TEST_CASE("A wide tolerance leaves no needles where strips end", "[simplify]") {
  // Its two rims have edges shorter than the tolerance, and collapsed in an order of their own leave strips whose sides meet.
  Plc bar = noisy_bar(360, 2e-5);
  for (auto& p : bar.vertices) p = {p.x(), p.y(), 20 * p.z()};
  const double tolerance = 1e-3 * bounding_diagonal(bar);
  Simplification_within done;
  const Plc simpler = simplify_within(bar, tolerance, 1e-6, false, &done);
  const auto without = narrowness(make_domain_3(simplify_within(bar, 1e-6 * bounding_diagonal(bar), 1e-6))), with = narrowness(make_domain_3(simpler));
  CHECK(with.halvings == 0);
  CHECK(with.widths < without.widths / 2);
  CHECK(done.distance.is_within);
}

TEST_CASE("No wider than what is fused, only that is made plane", "[simplify]") {
  const Plc bar = noisy_bar(48, 1e-7);
  const double tolerance = 1e-6 * bounding_diagonal(bar);
  const Plc simpler = simplify_within(bar, tolerance, 1e-6);
  CHECK(simpler.vertices == planarize(simplify(bar, tolerance), 1e-6).vertices);
  CHECK(simpler.vertices != bar.vertices);
  // Where nothing is fused there are no facets to be made plane, and no stages down to nothing.
  CHECK(simplify_within(bar, tolerance, 0).vertices == simplify(bar, tolerance).vertices);
}

TEST_CASE("As much is fused as leaves a surface valid", "[simplify]") {
  for (const bool is_dirty : {false, true}) {
    Plc plc = box_above_valley(1e-7);
    if (is_dirty) add_box(plc, {-0.01, -0.01, 1.4}, {0.01, 0.01, 1.6});
    const std::size_t before = make_domain_3(plc).facets.size();
    const auto domain = make_domain_3(simplify_as_far_as_valid(plc, 1e-6 * bounding_diagonal(plc), 1e-6));
    // What is not valid unfused is no reason to fuse less.
    CHECK(domain.facets.size() == before + (is_dirty ? 0 : 1));
    CHECK(validate_domain_3(domain).empty() != is_dirty);
  }
}

TEST_CASE("What was understood on the way is the result", "[simplify]") {
  // Nothing to be done with a seed that names nothing; noise and strips made plane.
  Plc seeded = box();
  seeded.holes.emplace_back(9.0, 9.0, 9.0);
  for (const auto& [plc, relative] : {std::pair{seeded, 0.0}, {seeded, 1e-6}, {noisy_bar(48, 1e-8), 0.9e-6}, {noisy_bar(48, 1e-4), 1e-3}, {noisy_bar(300, 1e-4), 1e-2}}) {
    INFO(plc.vertices.size() << " vertices, " << relative);
    Simplification_within done;
    const Plc result = simplify_as_far_as_valid(plc, relative * bounding_diagonal(plc), 1e-6, false, &done);
    REQUIRE(done.understood);
    const auto domain = make_domain_3(result);
    CHECK(done.understood->domain.vertices == domain.vertices);
    CHECK(std::ranges::equal(done.understood->domain.facets, domain.facets, [](const auto& a, const auto& b) { return a.input_facets == b.input_facets && a.segments == b.segments && a.triangles == b.triangles; }));
    CHECK(done.understood->domain.holes == domain.holes);
    CHECK(done.understood->problems.size() == validate_domain_3(domain).size());
  }
}

TEST_CASE("Making facets plane makes no small dihedral angles", "[simplify][models]") {
  // 0.13 degrees, and no end of its refinement, where nothing kept facets from falling onto each other.
  const auto file = input_model("a29_cdt_112544.off");
  if (!file) return;
  const Plc plc = normalized(read_plc(*file));
  const auto smallest = [](const Plc& p) { return small_angles_3(make_domain_3(p)).smallest_dihedral_deg; };
  CHECK(smallest(simplify_within(plc, 1e-4 * bounding_diagonal(plc), 1e-6)) > smallest(plc) / 4);
}

TEST_CASE("A corner may become narrow for the sake of strips that are gone", "[simplify][models]") {
  const auto path = inputs_folder().parent_path() / "cad" / "mendel90_z_motor_bracket_lhs_bb32.stl";
  if (!std::filesystem::is_regular_file(path)) PGDR_SKIP("no folder of printed parts");
  const Plc plc = read_plc(path);
  const auto narrow = [&](double tolerance) { return narrowness(make_domain_3(simplify_within(plc, tolerance * bounding_diagonal(plc), 1e-6))); };
  const Narrowness without = narrow(1e-6), with = narrow(1e-3);
  CHECK(with.halvings < 10);
  CHECK(with.tetrahedra() < without.tetrahedra() / 4);
}

TEST_CASE("The distance of two surfaces is measured both ways", "[simplify]") {
  const Plc cube = box();
  const auto same = surface_distance(cube, triangulated(cube), 1e-3);
  REQUIRE(same);
  CHECK(same->is_within);
  CHECK(same->seen < 1e-15);

  const Plc larger = box({0, 0, 0}, {1, 1, 1.25});
  for (const auto& [a, b] : {std::pair<const Plc*, const Plc*>{&cube, &larger}, {&larger, &cube}}) {
    CHECK(surface_distance(*a, *b, 0.2500001)->is_within);
    const auto too_far = surface_distance(*a, *b, 0.2499);
    CHECK_FALSE(too_far->is_within);
    CHECK(too_far->seen > 0.2499);
    CHECK(too_far->at.z >= 1);
  }

  // The middle of a facet is far from the other surface, none of its corners is.
  Plc dented = triangulated(cube);
  dented.vertices.emplace_back(0.5, 0.5, 0.3);
  const auto at_top = [&](const auto& f) {
    return std::ranges::all_of(f.polygons[0], [&](Index v) { return dented.vertices[v].z() == 1; });
  };
  std::erase_if(dented.facets, at_top);
  for (const auto& [a, b] : {std::pair<Index, Index>{4, 5}, {5, 7}, {7, 6}, {6, 4}}) dented.facets.push_back({{{a, b, 8}}, {}, 0});
  for (const auto& [a, b] : {std::pair<const Plc*, const Plc*>{&cube, &dented}, {&dented, &cube}}) {
    CHECK_FALSE(surface_distance(*a, *b, 0.3)->is_within);
    CHECK(surface_distance(*a, *b, 0.5)->is_within);
  }

  Plc broken = cube;
  broken.facets[0].polygons = {{0, 2, 3, 4}};
  broken.facets[0].polygons.push_back({99, 98, 97});
  CHECK_FALSE(surface_distance(cube, broken, 1));
}
