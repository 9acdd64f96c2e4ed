// SPDX-License-Identifier: GPL-3.0-or-later
#include "catch.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <mutex>
#include <set>
#include <tuple>
#include <vector>

#include <pgdr/io/read_plc.h>

#include "conforming/consistency.h"
#include "domain/shapes.h"
#include "inputs.h"
#include "quality/corruptions.h"
#include "refinement/refined.h"
#include "seeded_random.h"

using namespace pgdr_test;
using pgdr::Plc;

namespace {

const Sized_shape shapes[] = {{"cube.poly", 0.15},           {"l_block.poly", 0.2},
                        {"cavity.poly", 0.4},          {"two_regions.poly", 0.2},
                        {"plate_with_hole.poly", 0.3}, {"winged_body_in_box.poly", 4}};

Plc read(const char* file) { return pgdr::read_plc(data_file(file)); }

double volume(const pgdr::Indexed_mesh_3& mesh, std::size_t t) {
  const auto corner = [&](std::size_t i) { return pgdr::to_vec(mesh.points[mesh.tetrahedra[t][i]]); };
  return pgdr::dot(pgdr::cross(corner(1) - corner(0), corner(2) - corner(0)), corner(3) - corner(0)) / 6;
}

double largest_volume(const pgdr::Indexed_mesh_3& mesh, std::int32_t region) {
  double largest = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    if (mesh.tetrahedron_references[t] == region) largest = std::max(largest, volume(mesh, t));
  return largest;
}

}  // namespace

TEST_CASE("Every shape is refined to the promised quality", "[refinement]") {
  for (const auto& [file, size] : shapes)
    for (const double bound : {2.0, 3.0}) {
      CAPTURE(file, size, bound);
      pgdr::Parameters parameters;
      parameters.verify = true;
      parameters.radius_edge_ratio = bound;
      const Mesh mesh = refined(read(file), size, parameters);
      CHECK(mesh.radius_edge_ratio() == bound);
      CHECK(inconsistency(mesh.triangulation(), mesh.complex()) == "");

      std::size_t over = 0, too_large = 0, cells = 0;
      const auto& tr = mesh.triangulation();
      for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) {
        if (c->subdomain() == 0) continue;
        ++cells;
        const auto& p = c->vertex(0)->point();
        const auto center =
            CGAL::circumcenter(p, c->vertex(1)->point(), c->vertex(2)->point(), c->vertex(3)->point());
        const double r = std::sqrt(CGAL::squared_distance(center, p));
        double shortest = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 4; ++i)
          for (int j = i + 1; j < 4; ++j)
            shortest = std::min(
                shortest, std::sqrt(CGAL::squared_distance(c->vertex(i)->point(), c->vertex(j)->point())));
        over += r > bound * shortest * (1 + 1e-9);
        too_large += r > size * (1 + 1e-9);
      }
      const auto indexed = pgdr::indexed_mesh_3(mesh);
      CHECK(cells == indexed.tetrahedra.size());
      CHECK(over == indexed.exempt.size());
      CHECK(over == 0);
      CHECK(too_large == 0);
      pgdr::Check_options options;
      options.radius_edge_ratio = bound;
      CHECK(failures(pgdr::check_mesh(indexed, &mesh.domain(), options)) == "");

      const auto& statistics = mesh.statistics();
      CHECK(statistics.stop == pgdr::Stop_reason::finished);
      CHECK(statistics.stop_message == "");
      CHECK(statistics.unrecovered == 0);
      std::size_t steiner = 0;
      for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v)
        steiner += v->in_dimension() != 0 && v->in_dimension() != 4;
      CHECK(statistics.steiner_points == steiner);
      std::vector<std::string> phases;
      for (const auto& [phase, seconds] : statistics.seconds) {
        phases.push_back(phase);
        CHECK(seconds >= 0);
      }
      CHECK(phases == std::vector<std::string>{"triangulation", "conforming", "labelling", "refinement",
                                               "slivers", "verification"});
    }
}

TEST_CASE("Nothing is bounded unless asked for", "[refinement]") {
  const auto coarse = pgdr::indexed_mesh_3(refined(box()));
  CHECK(coarse.points.size() == 8);
  CHECK(coarse.edges.size() == 12);
  CHECK(coarse.triangles.size() == 12);
  // A finer size gives more, and each bound its own.
  const auto fine = pgdr::indexed_mesh_3(refined(box(), 0.2)),
             finer = pgdr::indexed_mesh_3(refined(box(), 0.1));
  CHECK(fine.tetrahedra.size() > 2 * coarse.tetrahedra.size());
  CHECK(finer.tetrahedra.size() > 4 * fine.tetrahedra.size());
}

TEST_CASE("A sizing field with boxes is obeyed where it is fine", "[refinement]") {
  const pgdr::Combined_sizing_field sizing(pgdr::Uniform_sizing_field(0.5),
                                         {{{0, 0, 0}, {0.5, 0.5, 0.5}, 0.06}});
  const auto mesh = pgdr::indexed_mesh_3(pgdr::refine_mesh_3(box(), sizing));
  CHECK(failures(pgdr::check_mesh(mesh)) == "");
  std::size_t inside = 0, outside_and_large = 0;
  for (const auto& t : mesh.tetrahedra) {
    std::array<CGAL::Epick::Point_3, 4> p;
    for (std::size_t i = 0; i < 4; ++i)
      p[i] = {mesh.points[t[i]][0], mesh.points[t[i]][1], mesh.points[t[i]][2]};
    const auto c = CGAL::circumcenter(p[0], p[1], p[2], p[3]);
    const double r = std::sqrt(CGAL::squared_distance(c, p[0]));
    CHECK(r <= sizing(c) * (1 + 1e-9));
    inside += sizing(c) < 0.1;
    outside_and_large += r > 0.12;
  }
  CHECK(inside > 100);
  CHECK(outside_and_large > 10);
}

TEST_CASE("Parameters without sense and bad input are refused", "[refinement]") {
  pgdr::Parameters parameters;
  for (const double bad : {1.99, 0.0, -2.0, std::nan("")}) {
    parameters.radius_edge_ratio = bad;
    CHECK_THROWS_AS(refined(box(), 1, parameters), std::invalid_argument);
  }
  CHECK_THROWS_AS(refined(Plc()), pgdr::Input_error);
  Plc open = box();
  open.facets.pop_back();
  CHECK_THROWS_AS(refined(open), pgdr::Input_error);
  Plc crossing = box();
  add_box(crossing, {0.5, 0.5, 0.5}, {2, 2, 2});
  CHECK_THROWS_AS(refined(crossing), pgdr::Input_error);
  Plc wrong_index = box();
  wrong_index.facets[0].polygons[0][1] = 77;
  CHECK_THROWS_AS(refined(wrong_index), pgdr::Input_error);
}

TEST_CASE("A limit on vertices stops with a valid mesh", "[refinement]") {
  for (const char* file : {"cube.poly", "l_block.poly", "cavity.poly", "two_regions.poly"})
    for (const std::size_t limit : {60u, 97u, 150u, 151u, 152u, 333u, 1000u}) {
      CAPTURE(file, limit);
      pgdr::Parameters parameters;
      parameters.max_vertices = limit;
      parameters.verify = true;
      const Mesh mesh = refined(read(file), 0.02, parameters);
      CHECK(mesh.statistics().stop == pgdr::Stop_reason::vertex_budget);
      CHECK(mesh.statistics().stop_message != "");
      // A few more may be needed to leave every facet whole.
      CHECK(mesh.triangulation().number_of_vertices() >= limit);
      CHECK(mesh.triangulation().number_of_vertices() <= limit + 50);
      CHECK(inconsistency(mesh.triangulation(), mesh.complex(), true) == "");
      const auto indexed = pgdr::indexed_mesh_3(mesh);
      CHECK(!indexed.tetrahedra.empty());
      CHECK(valid_when_stopped(mesh, indexed) == "");
    }
}

TEST_CASE("A tilted box stopped at any number of vertices is still a valid mesh", "[refinement]") {
  Plc plc = tilted(box({0, 0, 0}, {3, 2, 1}));
  for (std::size_t limit = 17; limit <= 140; ++limit) {
    CAPTURE(limit);
    pgdr::Parameters parameters;
    parameters.max_vertices = limit;
    const Mesh mesh = refined(plc, 0.1, parameters);
    CHECK(mesh.statistics().stop == pgdr::Stop_reason::vertex_budget);
    CHECK(inconsistency(mesh.triangulation(), mesh.complex(), true) == "");
    const auto indexed = pgdr::indexed_mesh_3(mesh);
    CHECK(!indexed.tetrahedra.empty());
    CHECK(valid_when_stopped(mesh, indexed) == "");
  }
}

TEST_CASE("A flag stops the refinement", "[refinement]") {
  std::atomic<bool> cancel{false};
  pgdr::Parameters parameters;
  parameters.cancel = &cancel;
  std::size_t calls = 0, last = 0;
  parameters.progress = [&](const pgdr::Progress& p) {
    CHECK(p.vertices >= last);
    last = p.vertices;
    if (++calls == 3) cancel = true;
  };
  const Mesh mesh = refined(read("cube.poly"), 0.03, parameters);
  CHECK(calls >= 3);
  CHECK(calls <= 4);  // what was stopped is reported as well
  CHECK(mesh.statistics().stop == pgdr::Stop_reason::cancelled);
  CHECK(mesh.statistics().stop_message != "");
  CHECK(mesh.triangulation().is_valid());
  CHECK(mesh.triangulation().number_of_vertices() >= last);
  CHECK(mesh.triangulation().number_of_vertices() <= last + 50);
  const auto indexed = pgdr::indexed_mesh_3(mesh);
  CHECK(indexed.tetrahedra.size() > 1000);
  CHECK(mesh.statistics().unrecovered == 0);
  CHECK(valid_when_stopped(mesh, indexed) == "");

  // Set from the start: nothing is refined.
  parameters.progress = nullptr;
  const Mesh none = refined(read("cube.poly"), 0.03, parameters);
  CHECK(none.statistics().stop == pgdr::Stop_reason::cancelled);
  CHECK(none.triangulation().number_of_vertices() == 8);
}

TEST_CASE("Every new vertex is told, by whatever thread", "[refinement]") {
  for (const auto& [file, size, min_dihedral] : {std::tuple{"cube.poly", 0.04, 20.0}, {"plate_with_hole.poly", 0.2, 12.0}}) {
    CAPTURE(file);
    std::mutex lock;
    std::vector<pgdr::Inserted_vertex> told;
    pgdr::Parameters parameters;
    parameters.threads = 2;
    parameters.min_dihedral = min_dihedral;
    parameters.inserted = [&](const pgdr::Inserted_vertex& v) {
      const std::lock_guard guard(lock);
      told.push_back(v);
    };
    Plc plc = read(file);
    for (auto& p : plc.vertices) p = {1000 * p.x(), 1000 * p.y(), 1000 * p.z()};
    const Mesh mesh = refined(plc, 1000 * size, parameters);
    REQUIRE(!told.empty());
    // Of the vertices that lie on features or inside of a volume; those outside are not told.
    std::set<std::array<double, 3>> on_features;
    std::array<std::size_t, 4> there{}, new_ones{};
    const double unit = pgdr::unit_of(mesh.domain());
    const auto& tr = mesh.triangulation();
    for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v) {
      const auto d = static_cast<std::size_t>(v->in_dimension());
      std::vector<pgdr_test::Mesh::Triangulation::Cell_handle> around;
      tr.incident_cells(v, std::back_inserter(around));
      if (std::ranges::none_of(around, [](auto c) { return c->subdomain() != 0; })) continue;
      ++there[d];
      if (d < 3) on_features.insert({unit * v->point().x(), unit * v->point().y(), unit * v->point().z()});
    }
    for (const auto& v : told) {
      ++new_ones[static_cast<std::size_t>(v.dimension)];
      if (v.dimension < 3) CHECK(on_features.contains({v.x, v.y, v.z}));
    }
    CHECK(new_ones[0] == 0);
    for (const std::size_t d : {1u, 2u, 3u}) CHECK(new_ones[d] == there[d]);
  }
}

TEST_CASE("The mesh does not depend on where memory lies", "[refinement]") {
  Seeded_random random(31);
  std::vector<std::unique_ptr<char[]>> garbage;
  for (const auto& [file, size] : shapes) {
    CAPTURE(file);
    const Plc plc = read(file);
    const auto first = pgdr::indexed_mesh_3(refined(plc, size));
    const auto checksum = pgdr::mesh_checksum(first);
    for (int run = 0; run < 3; ++run) {
      // Holes of all sizes for the next run's allocations to fall into.
      for (int k = 0; k < 3000; ++k) garbage.push_back(std::make_unique<char[]>(1 + random.below(3000)));
      for (std::size_t k = 0; k < garbage.size(); k += 1 + random.below(3)) garbage[k].reset();
      const auto again = pgdr::indexed_mesh_3(refined(plc, size));
      CAPTURE(run);
      CHECK(equal(first, again));
      CHECK(pgdr::mesh_checksum(again) == checksum);
    }
    CHECK(pgdr::mesh_checksum(pgdr::indexed_mesh_3(refined(plc, 0.9 * size))) != checksum);
  }
}

TEST_CASE("Giving up the mesh for its arrays gives the same arrays", "[refinement]") {
  Mesh mesh = refined(read("two_regions.poly"), 0.3);
  const auto kept = pgdr::indexed_mesh_3(mesh);
  CHECK(equal(kept, pgdr::indexed_mesh_3(std::move(mesh))));
}

TEST_CASE("Arrays are in canonical order", "[refinement]") {
  const auto mesh = pgdr::indexed_mesh_3(refined(read("cavity.poly"), 0.5));
  CHECK(std::is_sorted(mesh.tetrahedra.begin(), mesh.tetrahedra.end()));
  CHECK(std::is_sorted(mesh.triangles.begin(), mesh.triangles.end()));
  CHECK(std::is_sorted(mesh.edges.begin(), mesh.edges.end()));
  const Plc plc = read("cavity.poly");
  for (std::size_t i = 0; i < plc.vertices.size(); ++i) {
    const auto p = pgdr::to_vec(plc.vertices[i]);
    CHECK(mesh.points[i] == pgdr::Indexed_mesh_3::Point{p.x, p.y, p.z});
    CHECK(mesh.point_dimensions[i] == 0);
  }
  for (std::size_t i = plc.vertices.size(); i < mesh.points.size(); ++i) CHECK(mesh.point_dimensions[i] > 0);
}

TEST_CASE("Triangles face away from the meshed side, and from the smaller region id", "[refinement]") {
  const auto normal = [](const pgdr::Indexed_mesh_3& mesh, std::size_t t) {
    const auto corner = [&](std::size_t i) { return pgdr::to_vec(mesh.points[mesh.triangles[t][i]]); };
    return pgdr::cross(corner(1) - corner(0), corner(2) - corner(0));
  };
  // The flux of the positions through the boundary is thrice the volume.
  const auto cavity = pgdr::indexed_mesh_3(refined(read("cavity.poly"), 0.5));
  double flux = 0;
  for (std::size_t t = 0; t < cavity.triangles.size(); ++t)
    flux += 0.5 * pgdr::dot(pgdr::to_vec(cavity.points[cavity.triangles[t][0]]), normal(cavity, t));
  CHECK(flux / 3 == Approx(26));

  const auto two = pgdr::indexed_mesh_3(refined(read("two_regions.poly"), 0.5));
  std::size_t between = 0;
  for (std::size_t t = 0; t < two.triangles.size(); ++t) {
    if (two.triangle_references[t] != 3) continue;
    ++between;
    CHECK(normal(two, t).x > 0);  // from region 10, at smaller x, to region 20
  }
  CHECK(between > 2);
}

TEST_CASE("Volumes without seeds are numbered alike by the mesher and from the facets alone", "[refinement]") {
  // The inner box comes first: its vertices are the first ones of both volumes.
  for (const bool inner_first : {true, false}) {
    CAPTURE(inner_first);
    Plc plc;
    if (inner_first) add_box(plc, {1, 1, 1}, {2, 2, 2});
    add_box(plc, {0, 0, 0}, {3, 3, 3});
    if (!inner_first) add_box(plc, {1, 1, 1}, {2, 2, 2});
    for (const Plc& placed : {plc, tilted(plc)}) {
      const Mesh mesh = refined(placed);
      CHECK(failures(pgdr::check_mesh(pgdr::indexed_mesh_3(mesh), &mesh.domain())) == "");
    }
  }
}

TEST_CASE("Region sizes bound volumes unless they are ignored", "[refinement]") {
  const Plc plc = read("two_regions.poly");
  REQUIRE(plc.regions.size() == 2);
  const auto bounded = pgdr::indexed_mesh_3(refined(plc, 10));
  CHECK(failures(pgdr::check_mesh(bounded)) == "");
  CHECK(largest_volume(bounded, 20) <= 1.0 / 256);
  CHECK(largest_volume(bounded, 10) > 1.0 / 256);
  pgdr::Parameters parameters;
  parameters.ignore_region_sizes = true;
  const auto unbounded = pgdr::indexed_mesh_3(refined(plc, 10, parameters));
  CHECK(largest_volume(unbounded, 20) > 1.0 / 256);
  CHECK(unbounded.tetrahedra.size() < bounded.tetrahedra.size());
  CHECK(distinct(bounded.tetrahedron_references) == std::set<std::int32_t>{10, 20});
  CHECK(distinct(bounded.triangle_references) == std::set<std::int32_t>{1, 2, 3});
}

TEST_CASE("The checker notices every corruption of a refined mesh", "[refinement]") {
  for (const char* file : {"cavity.poly", "two_regions.poly"}) {
    const Mesh mesh = refined(read(file), 0.5);
    const auto good = pgdr::indexed_mesh_3(mesh);
    REQUIRE(failures(pgdr::check_mesh(good, &mesh.domain())) == "");
    for (const Corruption& corruption : corruptions()) {
      CAPTURE(file, corruption.name, corruption.property);
      auto bad = good;
      corruption.apply(bad);
      const auto lines = pgdr::check_mesh(bad, &mesh.domain());
      CHECK(!pgdr::all_passed(lines));
      CHECK(std::any_of(lines.begin(), lines.end(),
                        [&](const auto& l) { return l.property == corruption.property && !l.passed; }));
    }
  }
}

TEST_CASE("A segment in a void is not in the mesh, though its ends are", "[refinement]") {
  // Found by fuzzing: its edges were listed, and no tetrahedron had them.
  Plc plc = box({0, 0, 0}, {9, 9, 9});
  add_box(plc, {3, 3, 3}, {6, 6, 6});
  plc.holes.emplace_back(4, 5, 4.5);
  const auto at = [&plc](double x, double y, double z) {
    return static_cast<Index>(std::ranges::find(plc.vertices, Plc::Point_3(x, y, z)) - plc.vertices.begin());
  };
  plc.segments.push_back({at(3, 3, 3), at(6, 6, 6), 5});
  for (const double size : {2.0, std::numeric_limits<double>::infinity()}) {
    const auto mesh = refined(plc, size);
    const auto indexed = pgdr::indexed_mesh_3(mesh);
    CHECK(failures(pgdr::check_mesh(indexed, &mesh.domain())) == "");
    CHECK(std::ranges::count(indexed.edge_references, 5) == 0);
  }
}
