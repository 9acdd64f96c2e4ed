// SPDX-License-Identifier: GPL-3.0-or-later
// Defects that are made, so that what has to come out is known.
#include <pgdr/repair/repair.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/quality/check_mesh.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/refine_mesh_3.h>

#include "catch.h"
#include "domain/shapes.h"
#include "seeded_random.h"

using namespace pgdr;
using namespace pgdr_test;

namespace {

constexpr double tolerance = 1e-6, largest_hole = 1;

Plc as_surface(Plc plc) {
  plc.nesting = Nesting::alternate;
  return plc;
}

Indexed_mesh_3 meshed(const Plc& plc) {
  Parameters parameters;
  parameters.triangulate_facets = true;
  return indexed_mesh_3(refine_mesh_3(plc, Uniform_sizing_field(), parameters));
}

/// By region id.
std::map<std::int32_t, double> volumes(const Plc& plc) { return mesh_quality(meshed(plc)).region_volumes; }

/// Of a repaired surface without regions.
double volume(const Plc& plc) {
  REQUIRE(validate_domain_3(make_domain_3(plc, 0.0, true)).empty());
  double sum = 0;
  for (const auto& [id, v] : volumes(plc)) sum += v;
  return sum;
}

/// Enclosed by a surface of triangles, oriented alike.
double surface_volume(const Plc& plc) {
  double sum = 0;
  for (const Facet& f : plc.facets) {
    const auto& c = f.polygons[0];
    sum += dot(to_vec(plc.vertices[c[0]]), cross(to_vec(plc.vertices[c[1]]), to_vec(plc.vertices[c[2]]))) / 6;
  }
  return sum;
}

Plc repaired(const Plc& plc, Repair_report* report = nullptr) { return repair(plc, {tolerance, largest_hole}, report); }

/// Of a prism over a regular polygon.
double cylinder_volume(int n, double radius, double height) {
  return 0.5 * n * radius * radius * std::sin(2 * std::numbers::pi / n) * height;
}

/// A prism over a regular polygon around a vertical axis, its sides and caps triangles.
Plc bolt(Index n, double radius, double lower, double upper, double x, double y) {
  Plc plc;
  for (const double z : {lower, upper})
    for (Index i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n;
      plc.vertices.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle), z);
    }
  Facet bottom, top;
  bottom.polygons.resize(1);
  top.polygons.resize(1);
  for (Index i = 0; i < n; ++i) {
    const Index j = (i + 1) % n;
    plc.facets.push_back({{{i, j, n + j, n + i}}, {}, 0});
    bottom.polygons[0].push_back(n - 1 - i);
    top.polygons[0].push_back(n + i);
  }
  plc.facets.push_back(bottom);
  plc.facets.push_back(top);
  return as_surface(triangulated(plc));
}

/// One triangle becomes two, at a vertex on its first edge that the neighbor does not have, off it by `gap`.
void make_t_junction(Plc& plc, std::size_t facet, double gap) {
  const std::vector<Index> c = plc.facets[facet].polygons[0];
  const auto a = plc.vertices[c[0]], b = plc.vertices[c[1]];
  const auto v = static_cast<Index>(plc.vertices.size());
  plc.vertices.emplace_back(0.5 * (a.x() + b.x()) + gap, 0.5 * (a.y() + b.y()), 0.5 * (a.z() + b.z()));
  plc.facets[facet].polygons = {{c[0], v, c[2]}};
  plc.facets.push_back({{{v, c[1], c[2]}}, {}, plc.facets[facet].marker});
}

/// A triangle gets vertices of its own, off those of its neighbors.
void make_crack(Plc& plc, std::size_t facet, double gap) {
  for (Index& v : plc.facets[facet].polygons[0]) {
    const auto p = plc.vertices[v];
    v = static_cast<Index>(plc.vertices.size());
    plc.vertices.emplace_back(p.x() + gap, p.y(), p.z() - gap);
  }
}

enum class Defect { missing, doubled, flipped, t_junction, crack, all_inside_out, same_twice };

void damage(Plc& plc, Defect defect, Random& random) {
  const std::size_t facet = random.below(static_cast<std::uint32_t>(plc.facets.size()));
  auto& corners = plc.facets[facet].polygons[0];
  switch (defect) {
    case Defect::missing: plc.facets.erase(plc.facets.begin() + static_cast<std::ptrdiff_t>(facet)); break;
    case Defect::doubled: plc.facets.push_back(plc.facets[facet]); break;
    case Defect::flipped: std::swap(corners[0], corners[1]); break;
    case Defect::t_junction: make_t_junction(plc, facet, random.between(-0.3, 0.3) * tolerance); break;
    case Defect::crack: make_crack(plc, facet, random.between(-0.3, 0.3) * tolerance); break;
    case Defect::all_inside_out:
      for (Facet& f : plc.facets) std::swap(f.polygons[0][0], f.polygons[0][1]);
      break;
    case Defect::same_twice:
      for (const Facet& f : std::vector<Facet>(plc.facets)) plc.facets.push_back(f);
      break;
  }
}

}  // namespace

TEST_CASE("what is valid stays as it is") {
  for (const Plc& plc : {as_surface(triangulated(box())), as_surface(triangulated(tilted(cylinder(12))))}) {
    Repair_report report;
    const Plc same = repaired(plc, &report);
    CHECK(report.is_none());
    CHECK(same.vertices == plc.vertices);
    CHECK(same.facets.size() == plc.facets.size());
  }
}

TEST_CASE("made defects of one surface: the volume is what it was") {
  const std::vector<Plc> shapes{as_surface(triangulated(box())), as_surface(triangulated(tilted(box({0, 0, 0}, {1, 2, 0.5})))),
                                bolt(12, 0.5, 0, 1, 0, 0), as_surface(triangulated(tilted(cylinder(9))))};
  std::vector<double> whole;
  for (const Plc& plc : shapes) whole.push_back(volume(plc));
  const std::vector<Defect> defects{Defect::missing, Defect::doubled,        Defect::flipped,   Defect::t_junction,
                                    Defect::crack,   Defect::all_inside_out, Defect::same_twice};
  for (std::uint64_t seed = 0; seed < 5; ++seed)
    for (std::size_t s = 0; s < shapes.size(); ++s)
      for (const Defect defect : defects) {
        Seeded_random random(seed);
        INFO("shape " << s << ", defect " << static_cast<int>(defect));
        Plc plc = shapes[s];
        damage(plc, defect, random);
        Repair_report report;
        const Plc good = repaired(plc, &report);
        CHECK(report.is_none() == (defect == Defect::all_inside_out));  // which side is inside follows from what is enclosed
        CHECK(report.largest_move <= tolerance);
        // A triangle that is missing is filled by the same one only where its neighbors lie in planes of their own or in its.
        CHECK(std::abs(volume(good) - whole[s]) <= 20 * tolerance);
      }
}

TEST_CASE("what intersects since it was rounded keeps its volume") {
  std::size_t intersecting = 0, thin = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Seeded_random random(seed);
    const double step = seed % 2 == 0 ? 0.01 : 0.005;  // sides are 0.0123 to 0.05 wide
    Plc plc = bolt(static_cast<Index>(64 * (1 + seed % 4)), 0.5, 0, random.between(0.2, 0.6), 0, 0);
    const Vec_3 axis{random.between(-1, 1), random.between(-1, 1), 1};
    for (auto& p : plc.vertices) {
      const Vec_3 turned = to_vec(p) + cross(axis, to_vec(p));  // that, and larger
      p = Default_kernel::Point_3(step * std::nearbyint(turned.x / step), step * std::nearbyint(turned.y / step), step * std::nearbyint(turned.z / step));
    }
    const double expected = surface_volume(plc);
    Repair_report report;
    const Plc good = repaired(plc, &report);
    intersecting += report.intersecting_pairs > 0;
    CHECK(std::abs(surface_volume(good) - expected) <= 1e-2 * expected);
    const auto domain = make_domain_3(good, 0.0, true);
    CHECK(validate_domain_3(domain).empty());
    thin += small_angles_3(domain).smallest_dihedral_deg < 1e-4;
  }
  CHECK(intersecting >= 20);
  CHECK(thin <= 5);  // sheets that are one but for rounding; 17 where wedges are left open
}

TEST_CASE("two shells pushed into each other become their union") {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Seeded_random random(seed);
    const double dx = random.between(0.1, 0.9), dy = random.between(0.1, 0.9), dz = random.between(0.1, 0.9);
    Plc plc = box();
    add_box(plc, {dx, dy, dz}, {dx + 1, dy + 1, dz + 1});
    plc = as_surface(triangulated(seed % 2 == 0 ? plc : tilted(plc)));
    Repair_report report;
    const Plc good = repaired(plc, &report);
    CHECK(report.intersecting_pairs > 0);
    CHECK(report.inner_triangles > 0);
    CHECK(std::abs(volume(good) - (2 - (1 - dx) * (1 - dy) * (1 - dz))) <= 1e-9);
  }
}

TEST_CASE("boxes with part of a side in common become their union") {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Seeded_random random(seed);
    const double dy = random.between(-0.5, 0.5), dz = random.between(-0.5, 0.5);
    Plc plc = box();
    add_box(plc, {1, dy, dz}, {2, dy + 1, dz + 1});
    const Plc good = repaired(as_surface(triangulated(plc)));
    CHECK(std::abs(volume(good) - 2) <= 1e-9);
  }
}

TEST_CASE("a shell within another one is a void, whichever way it faces") {
  for (const bool is_turned : {false, true}) {
    Plc plc = box({0, 0, 0}, {3, 3, 3});
    add_box(plc, {1, 1, 1}, {2, 2, 2});
    plc = as_surface(triangulated(plc));
    if (is_turned)
      for (std::size_t f = 12; f < 24; ++f) std::swap(plc.facets[f].polygons[0][0], plc.facets[f].polygons[0][1]);
    plc.facets.push_back(plc.facets[0]);  // something to repair
    CHECK(std::abs(volume(repaired(plc)) - 26) <= 1e-9);
  }
}

TEST_CASE("holes with many corners are filled, flat or not, wherever memory is") {
  Random random(7);
  for (const Index n : {40u, 150u, 450u})
    for (const double wave : {0.0, 0.7}) {
      CAPTURE(n, wave);
      Plc plc = bolt(n, 1, 0, 3, 0, 0);
      std::erase_if(plc.facets, [&](const Facet& f) { return std::ranges::all_of(f.polygons[0], [&](Index v) { return plc.vertices[v].z() == 3; }); });
      for (Index i = 0; i < n; ++i) {
        const auto p = plc.vertices[n + i];
        plc.vertices[n + i] = {p.x(), p.y(), 3 + wave * p.x() * p.y()};
      }
      Repair_report report;
      const Plc whole = repair(plc, {tolerance, 10}, &report);
      CHECK(report.filled_holes == 1);
      CHECK(report.filling_triangles == n - 2);
      CHECK(report.intersecting_pairs == 0);
      CHECK(validate_domain_3(make_domain_3(whole)).empty());
      const double expected = cylinder_volume(static_cast<int>(n), 1, 3);
      CHECK(std::abs(std::abs(surface_volume(whole)) - expected) < (wave == 0 ? 1e-9 : 0.1) * expected);
      std::vector<std::vector<char>> in_the_way;
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 300; ++k) in_the_way.emplace_back(16 + random.below(3000));
        for (int k = 0; k < 200; ++k) {
          std::swap(in_the_way[random.below(static_cast<std::uint32_t>(in_the_way.size()))], in_the_way.back());
          in_the_way.pop_back();
        }
        const Plc again = repair(plc, {tolerance, 10});
        REQUIRE(again.facets.size() == whole.facets.size());
        for (std::size_t f = 0; f < whole.facets.size(); ++f) CHECK(again.facets[f].polygons == whole.facets[f].polygons);
      }
    }
}

TEST_CASE("holes that are too wide, and sheets, are refused by name") {
  Plc open = as_surface(triangulated(box()));
  open.facets.erase(open.facets.begin(), open.facets.begin() + 2);  // its bottom
  try {
    repair(open, {tolerance, 0.5});
    FAIL("filled a hole that is wider than allowed");
  } catch (const Input_error& e) {
    REQUIRE(e.problems()[0].kind == Input_problem::Kind::open_surface);
    CHECK(std::string(e.what()).find("1.41421 wide") != std::string::npos);
    CHECK(e.problems()[0].facets.size() == 1);
  }
  CHECK(std::abs(volume(repair(open, {tolerance, 1.5})) - 1) <= 1e-9);
}

TEST_CASE("triangles that enclose nothing once they are repaired are refused") {
  Plc crossing, flat;
  crossing.vertices = {{0, 0, 0}, {-1, 0, 5}, {1, 0, 5}, {0, -1, 5}, {0, 1, 5}};
  crossing.facets = {{{{0, 1, 2}}, {}, 0}, {{{0, 3, 4}}, {}, 0}};
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  flat.facets = {{{{0, 1, 2}}, {}, 0}};
  for (const Plc& plc : {crossing, flat}) CHECK_THROWS_WITH(repair(plc, {tolerance, 1}), "the triangles enclose nothing");
}

TEST_CASE("a surface that leaks at edges of three triangles is refused, not left out") {
  // A triangle is missing, and no edge of it belongs to one triangle only.
  Plc plc = as_surface(triangulated(box()));
  const std::vector<Index> missing = plc.facets[0].polygons[0];
  plc.facets.erase(plc.facets.begin());
  for (std::size_t i = 0; i < 3; ++i) {
    const Index a = missing[i], b = missing[(i + 1) % 3];
    const auto middle = CGAL::midpoint(plc.vertices[a], plc.vertices[b]);
    const auto apex = static_cast<Index>(plc.vertices.size());
    for (const double depth : {-0.1, -0.2}) plc.vertices.emplace_back(middle.x() + 0.01 * depth, middle.y() + 0.02 * depth * depth, depth);
    plc.facets.push_back({{{a, b, apex}}, {}, 0});
    plc.facets.push_back({{{b, a, apex + 1}}, {}, 0});
  }
  add_box(plc, {3, 3, 3}, {4, 4, 4});
  try {
    repair(plc, {tolerance, 2});
    FAIL("lost a box");
  } catch (const Input_error& e) {
    CHECK(std::string(e.what()).find("leaks where edges belong to three triangles") != std::string::npos);
  }
}

TEST_CASE("what is closed by triangles without area stays closed, however close their vertices are") {
  Plc plc = as_surface(triangulated(box()));
  const auto with_edge = std::ranges::find_if(plc.facets, [](const auto& f) { return std::ranges::count(f.polygons[0], 0U) + std::ranges::count(f.polygons[0], 1U) == 2; });
  REQUIRE(with_edge != plc.facets.end());
  // Of the edge from 0 to 1, one side's triangle gets three vertices on it, and triangles without area are between.
  const std::vector<Index> whole = with_edge->polygons[0];
  const Index opposite = *std::ranges::find_if(whole, [](Index v) { return v > 1; });
  const bool runs_forward = whole[(static_cast<std::size_t>(std::ranges::find(whole, 0U) - whole.begin()) + 1) % 3] == 1;
  plc.facets.erase(with_edge);
  Index before = 0;
  for (const double x : {1e-4, 1.5e-4, 0.5, 1.0}) {
    const Index v = x == 1 ? 1 : static_cast<Index>(plc.vertices.size());
    if (v != 1) plc.vertices.emplace_back(x, 0.0, 0.0);
    for (std::vector<Index> t : {std::vector<Index>{before, v, opposite}, {before, 1, v}}) {
      if (t[1] == t[2]) continue;
      if (!runs_forward) std::swap(t[0], t[1]);
      plc.facets.push_back({{t}, {}, 0});
    }
    before = v;
  }
  add_box(plc, {0.5, 0.5, 0.5}, {2, 2, 2});
  for (const double wide : {0.0, 1e-6, 1.2e-4, 1e-3, 1e-2}) {
    INFO("tolerance " << wide);
    Repair_report report;
    const Plc result = repair(plc, {wide, 0.0}, &report);
    CHECK(std::abs(volume(result) - (1 + 3.375 - 0.125)) <= 1e-9);
    CHECK(report.closed_cracks == 0);
    CHECK(report.degenerate_triangles == 3);
  }
}

TEST_CASE("three boxes that share sides with different triangles are an assembly of three regions") {
  const Plc left = as_surface(triangulated(box({0, 0, 0}, {1, 1, 1})));
  Plc middle = as_surface(triangulated(box({1, 0, 0}, {2, 1, 1})));
  make_t_junction(middle, 8, 0);  // its side towards the left one
  Plc right = as_surface(triangulated(box({2, 0.25, 0.25}, {3, 0.75, 0.75})));
  for (Facet& f : right.facets) f.marker = 7;
  const std::vector<Plc> parts{left, middle, right};
  const Plc plc = assemble(parts, {tolerance, 0});
  REQUIRE(validate_domain_3(make_domain_3(plc)).empty());
  const Indexed_mesh_3 mesh = meshed(plc);
  const auto v = mesh_quality(mesh).region_volumes;
  REQUIRE(v.size() == 3);
  CHECK(std::abs(v.at(1) - 1) <= 1e-9);
  CHECK(std::abs(v.at(2) - 1) <= 1e-9);
  CHECK(std::abs(v.at(3) - 0.25) <= 1e-9);
  // Each triangle of an interface is there once, between tetrahedra of two regions.
  double between = 0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](double x) { return std::ranges::all_of(t, [&](std::uint32_t i) { return mesh.points[i][0] == x; }); };
    if (!at(1) && !at(2)) continue;
    const auto &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    between += 0.5 * std::abs((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]));
  }
  CHECK(std::abs(between - 2) <= 1e-9);
  CHECK(std::set<std::int32_t>(mesh.triangle_references.begin(), mesh.triangle_references.end()) == std::set<std::int32_t>{1, 2, 7});
}

TEST_CASE("where parts overlap the later one has it: a bolt in a plate") {
  const Plc plate = as_surface(triangulated(box({0, 0, 0}, {4, 4, 1})));
  const int n = 16;
  for (const double x : {1.0, 2.3}) {
    const std::vector<Plc> parts{plate, bolt(n, 0.6, -0.5, 2, x, 2)};
    Repair_report report;
    const auto v = volumes(assemble(parts, {tolerance, 0}, &report));
    CHECK(report.overlaps == 1);
    REQUIRE(v.size() == 2);
    CHECK(std::abs(v.at(1) - (16 - cylinder_volume(n, 0.6, 1))) <= 1e-9);
    CHECK(std::abs(v.at(2) - cylinder_volume(n, 0.6, 2.5)) <= 1e-9);
  }
}

TEST_CASE("a part of an assembly keeps its volume where its own shells overlap") {
  // On this grid points inside the union lie on facets inside it.
  for (const std::array<double, 3> d : {std::array<double, 3>{1, 1, -2}, {2, 0, -2}, {-2, -2, 0}, {0, -2, 2}}) {
    Plc plc = box({0, 0, 0}, {4, 4, 4});
    add_box(plc, d, {d[0] + 4, d[1] + 4, d[2] + 4});
    const auto v = volumes(assemble(std::vector<Plc>{as_surface(plc), as_surface(box({20, 20, 20}, {21, 21, 21}))}, {tolerance, 0}));
    double both = 1;
    for (const double x : d) both *= 4 - std::abs(x);
    REQUIRE(v.size() == 2);
    CHECK(std::abs(v.at(1) - (128 - both)) <= 1e-9);
    CHECK(std::abs(v.at(2) - 1) <= 1e-9);
  }
}

/// Unit cubes with names, the second one so far from the origin.
static std::vector<Plc> named_boxes(const std::string& first, const std::string& second, double at) {
  std::vector<Plc> parts{as_surface(box({0, 0, 0}, {1, 1, 1})), as_surface(box({at, 0, 0}, {at + 1, 1, 1}))};
  parts[0].name = first;
  parts[1].name = second;
  return parts;
}

TEST_CASE("the regions and markers of an assembly are called as its parts are") {
  std::vector<Plc> parts = named_boxes("bolt", "plate", 1);
  // The file of the second part has names of its own for some facets, and the first one numbers that mean something to its user.
  parts[0].facets[0].marker = 3;
  parts[1].facets[0].marker = 1;
  parts[1].names.markers = {{1, "front"}};
  const Plc plc = assemble(parts, {tolerance, 0});
  CHECK(plc.names.regions == std::map<int, std::string>{{1, "bolt"}, {2, "plate"}});
  CHECK(plc.names.markers == std::map<int, std::string>{{1, "bolt"}, {2, "plate"}, {4, "plate:front"}});
  std::set<int> markers;
  for (const auto& facet : plc.facets) markers.insert(facet.marker);
  CHECK(markers == std::set<int>{1, 2, 3, 4});
}

TEST_CASE("numbers that two parts of an assembly use are told apart, and parts that are no surfaces are refused") {
  std::vector<Plc> parts = named_boxes("a", "b", 3);
  parts[0].facets[0].marker = 9;
  parts[1].facets[0].marker = 1;
  parts[1].facets[1].marker = 9;
  const Plc plc = assemble(parts, {tolerance, 0});
  CHECK(plc.names.markers == std::map<int, std::string>{{1, "a"}, {2, "b"}, {3, "a:9"}, {4, "b:1"}, {5, "b:9"}});
  parts[1].nesting = Nesting::fill;
  CHECK(assemble(parts, {tolerance, 0}).facets.size() == plc.facets.size());
  parts[1].regions.push_back({{3.5, 0.5, 0.5}, 1, 0, 0});
  CHECK_THROWS_AS(assemble(parts, {tolerance, 0}), Input_error);
  parts[1].regions.clear();
  parts[1].facets.push_back(parts[1].facets[0]);  // something inside, or twice
  CHECK_THROWS_AS(assemble(parts, {tolerance, 0}), Input_error);
}

TEST_CASE("a hole that was filled is part of no patch") {
  Plc plc = as_surface(box());
  for (Facet& f : plc.facets) f.marker = 5;
  plc.facets.pop_back();
  std::set<int> markers;
  for (const auto& facet : repair(plc, {tolerance, 2}).facets) markers.insert(facet.marker);
  CHECK(markers == std::set<int>{0, 5});
}

TEST_CASE("repaired surfaces keep markers and seeds") {
  Plc plc = box();
  add_box(plc, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}, 5);
  plc = as_surface(triangulated(plc));
  for (std::size_t f = 0; f < 12; ++f) plc.facets[f].marker = 3;
  plc.regions.push_back({{0.25, 0.25, 0.25}, 9});
  const Plc good = repaired(plc);
  REQUIRE(good.regions.size() == 1);
  std::set<int> markers;
  for (const Facet& f : good.facets) markers.insert(f.marker);
  CHECK(markers == std::set<int>{3, 5});
  CHECK(volumes(good).contains(9));
}

TEST_CASE("pockets thinner than the tolerance are no volumes") {
  for (const bool is_thin : {true, false}) {
    Plc plc = box({0, 0, 0}, {3, 3, 3});
    const double height = is_thin ? 0.5 * tolerance : 0.5;
    add_box(plc, {1, 1, 1}, {2, 2, 1 + height});
    add_box(plc, {2.5, 2.5, 2.5}, {4, 4, 4});
    Repair_report report;
    const Plc good = repaired(as_surface(triangulated(plc)), &report);
    CHECK(std::abs(volume(good) - (27 + 27.0 / 8 - 1.0 / 8 - (is_thin ? 0 : height))) <= 1e-9);
  }
}
