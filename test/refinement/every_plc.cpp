// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that a PLC may contain, in every unit and far from the origin: each is meshed, and the mesh is checked against it.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "catch.h"
#include "domain/shapes.h"
#include "refinement/refined.h"

using namespace pgdr_test;
using pgdr::Plc;

namespace {

constexpr double side = 3;  ///< of the box around everything

struct Content {
  std::string name;
  std::function<void(Plc&)> add;  ///< to a box of this side
  std::size_t volumes = 1;
  double volume = side * side * side;
};

Index vertex(Plc& plc, double x, double y, double z) {
  plc.vertices.emplace_back(x, y, z);
  return static_cast<Index>(plc.vertices.size() - 1);
}

void add_rectangle(Plc& plc, double x0, double x1, double y0, double y1, double z) {
  const Index a = vertex(plc, x0, y0, z);
  vertex(plc, x1, y0, z), vertex(plc, x1, y1, z), vertex(plc, x0, y1, z);
  plc.facets.push_back({{{a, a + 1, a + 2, a + 3}}, {}, 7});
}

/// Puts a vertex between u and v in every polygon that has them next to each other.
void split_edge(Plc& plc, Index u, Index v, Index on) {
  for (auto& f : plc.facets)
    for (auto& polygon : f.polygons)
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Index a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if ((a != u || b != v) && (a != v || b != u)) continue;
        polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(i) + 1, on);
        break;
      }
}

const std::vector<Content>& contents() {
  static const std::vector<Content> all{
      {"nothing", [](Plc&) {}},
      {"an isolated vertex", [](Plc& p) { vertex(p, 1, 1.25, 1.5); }},
      {"an isolated segment", [](Plc& p) { const Index a = vertex(p, 1, 1, 1), b = vertex(p, 2, 1.5, 1.75); p.segments.push_back({a, b, 5}); }},
      {"a segment from wall to wall", [](Plc& p) { p.segments.push_back({0, 7, 5}); }},
      {"a vertex on a facet", [](Plc& p) { const Index a = vertex(p, 1, 1.5, 0); p.facets[0].polygons.push_back({a}); }},
      {"a segment in a facet", [](Plc& p) { const Index a = vertex(p, 1, 1, 0), b = vertex(p, 2, 1, 0); p.facets[0].polygons.push_back({a, b}); }},
      {"a floating facet", [](Plc& p) { add_rectangle(p, 1, 2, 1, 2, 1.5); }},
      {"a facet with a hole", [](Plc& p) {
         add_rectangle(p, 0.5, 2.5, 0.5, 2.5, 1.5);
         const Index a = vertex(p, 1, 1, 1.5);
         vertex(p, 2, 1, 1.5), vertex(p, 2, 2, 1.5), vertex(p, 1, 2, 1.5);
         p.facets.back().polygons.push_back({a, a + 1, a + 2, a + 3});
         p.facets.back().holes.emplace_back(1.5, 1.5, 1.5);
       }},
      {"a dividing facet", [](Plc& p) {
         add_rectangle(p, 0, side, 0, side, 1.5);
         const Index a = static_cast<Index>(p.vertices.size()) - 4;
         for (const auto& [on, low] : {std::pair<Index, Index>{a, 0}, {a + 1, 1}, {a + 2, 3}, {a + 3, 2}}) split_edge(p, low, low + 4, on);
         p.facets[2].polygons.push_back({a, a + 1});
         p.facets[3].polygons.push_back({a + 2, a + 3});
         p.facets[4].polygons.push_back({a, a + 3});
         p.facets[5].polygons.push_back({a + 1, a + 2});
       }, 2},
      {"three facets on one edge", [](Plc& p) {
         const Index a = vertex(p, 1, 1, 1), b = vertex(p, 1, 1, 2), c = vertex(p, 2, 1, 1.5), d = vertex(p, 0.5, 1.75, 1.5), e = vertex(p, 0.5, 0.25, 1.5);
         for (const Index x : {c, d, e}) p.facets.push_back({{{a, b, x}}, {}, 0});
       }},
      {"a body inside", [](Plc& p) { add_box(p, {1, 1, 1}, {2, 2, 2}); }, 2},
      {"a void inside", [](Plc& p) { add_box(p, {1, 1, 1}, {2, 2, 2}); p.holes.emplace_back(1.5, 1.5, 1.5); }, 1, side * side * side - 1},
      {"another component", [](Plc& p) { add_box(p, {4, 0, 0}, {5, 1, 1}); }, 2, side * side * side + 1},
      {"another component that touches in an edge", [](Plc& p) {
         const Index a = vertex(p, 4, 3, 0);
         vertex(p, 4, 4, 0), vertex(p, 3, 4, 0), vertex(p, 4, 3, 3), vertex(p, 4, 4, 3), vertex(p, 3, 4, 3);
         const Index low = 3, high = 7;  // the corners (3, 3, 0) and (3, 3, 3)
         const std::vector<Index> bottom{low, a, a + 1, a + 2}, top{high, a + 3, a + 4, a + 5};
         p.facets.push_back({{bottom}, {}, 0});
         p.facets.push_back({{top}, {}, 0});
         for (std::size_t i = 0; i < 4; ++i) p.facets.push_back({{{bottom[i], bottom[(i + 1) % 4], top[(i + 1) % 4], top[i]}}, {}, 0});
       }, 2, side * side * side + side},
      {"facets turned about", [](Plc& p) { for (const std::size_t f : {0, 3, 4}) std::ranges::reverse(p.facets[f].polygons[0]); }},
      {"a slot a thousandth wide", [](Plc& p) { add_box(p, {1, 1, 1.5}, {1.1, 1.1, 1.503}); p.holes.emplace_back(1.05, 1.05, 1.5015); }},
  };
  return all;
}

Plc scaled(Plc plc, double factor, double offset) {
  const auto move = [&](const auto& p) {
    return pgdr::Default_kernel::Point_3(factor * p.x() + offset, factor * p.y() + offset, factor * p.z() + offset);
  };
  for (auto& p : plc.vertices) p = move(p);
  for (auto& p : plc.holes) p = move(p);
  for (auto& f : plc.facets)
    for (auto& h : f.holes) h = move(h);
  return plc;
}

void check_meshed(const Content& content, const Plc& plc, double unit, double tolerance) {
  pgdr::Parameters parameters;
  parameters.max_vertices = 200000;
  const Mesh mesh = refined(plc, std::numeric_limits<double>::infinity(), parameters);
  CHECK(mesh.statistics().stop == pgdr::Stop_reason::finished);
  const auto indexed = pgdr::indexed_mesh_3(mesh);
  CHECK(failures(pgdr::check_mesh(indexed, &mesh.domain())) == "");
  CHECK(distinct(indexed.tetrahedron_references).size() == content.volumes);
  CHECK(pgdr::mesh_quality(indexed).volume == Approx(content.volume * unit * unit * unit).epsilon(tolerance));
}

}  // namespace

TEST_CASE("Everything that a PLC may contain is meshed", "[refinement]") {
  for (const Content& content : contents())
    for (const bool is_tilted : {false, true}) {
      CAPTURE(content.name, is_tilted);
      Plc plc = box({0, 0, 0}, {side, side, side});
      content.add(plc);
      check_meshed(content, is_tilted ? tilted(plc) : plc, 1, 1e-5);
    }
}

TEST_CASE("A PLC may come in any unit, and far from the origin", "[refinement]") {
  // In the last of these the slot is 3e-6 wide at 1e5, where coordinates are 1.5e-11 apart.
  const std::vector<std::pair<double, double>> placements{{1e-6, 0}, {1e9, 0}, {1, 1e5}, {1e-3, 1e5}};
  for (const Content& content : contents())
    for (const auto& [unit, offset] : placements) {
      CAPTURE(content.name, unit, offset);
      Plc plc = box({0, 0, 0}, {side, side, side});
      content.add(plc);
      check_meshed(content, scaled(tilted(plc), unit, offset), unit, 1e-4);
    }
}
