// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/conforming/constraint_complex_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/conforming/initial_complex_3.h>
#include <pgdr/conforming/sheet_walk_3.h>
#include <pgdr/domain/make_domain_3.h>
#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "conforming/consistency.h"
#include "conforming/gridded_box.h"
#include "inputs.h"
#include "seeded_random.h"

using namespace pgdr_test;
using pgdr::Vec_3;

namespace {

using K = pgdr::Default_kernel;
using Tr = pgdr::Mesh_triangulation_3<K>;
using Complex = pgdr::Constraint_complex_3<Tr>;

/// A pyramid whose lid is a needle of 1e-4 radians, bent at the middle of a long side by `bend`. Its length is 10.
Plc bent_needle(double bend) {
  Plc plc;
  for (const auto& [x, y, z] : {std::array{0.0, 0.0, 0.0}, {10, 0, 0}, {10, 1e-3, 0}, {2, 2e-4, bend}, {5, 0.3, -4}}) plc.vertices.emplace_back(x, y, z);
  for (const auto& corners : {std::array<pgdr::Index, 3>{0, 1, 3}, {3, 1, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}) plc.facets.push_back({{{corners.begin(), corners.end()}}, {}, 0});
  return plc;
}

/// The complex of a PLC over the triangulation of its vertices, nothing recovered.
struct Initial {
  explicit Initial(const Plc& plc) : domain(pgdr::make_domain_3(plc)), complex(domain) {
    handles = pgdr::insert_domain_vertices(tr, domain);
    pgdr::build_complex(complex, pool, handles);
  }
  std::string fault() const { return Complex_audit<Tr>(tr, complex).sheets(); }
  std::size_t subsegments() const {
    std::size_t n = 0;
    for (std::uint32_t s = 0; s < complex.subsegment_slots(); ++s) n += complex.subsegment(s).alive();
    return n;
  }
  /// Slots are given out in batches: not every one is in use.
  std::vector<std::uint32_t> subfacets() const {
    std::vector<std::uint32_t> alive;
    for (std::uint32_t t = 0; t < complex.subfacet_slots(); ++t)
      if (complex.subfacet(t).alive()) alive.push_back(t);
    return alive;
  }

  pgdr::Domain_3<K> domain;
  Tr tr;
  Complex complex;
  Complex::Pool pool;
  std::vector<Tr::Vertex_handle> handles;
};

}  // namespace

TEST_CASE("The complex of a PLC has its segments and facets", "[conforming]") {
  for (const Plc& plc : {box(), tilted(box()), tilted(gridded_box(5)), cylinder(12)}) {
    const Initial initial(plc);
    CHECK(initial.fault() == "");
    CHECK(initial.subsegments() == initial.domain.segments.size());
    std::size_t triangles = 0;
    for (const auto& f : initial.domain.facets) triangles += f.triangles.size();
    CHECK(initial.subfacets().size() == triangles);
    for (pgdr::Index s = 0; s < initial.domain.segments.size(); ++s) {
      const auto& ends = initial.domain.segments[s].vertices;
      const auto slot = initial.complex.find_subsegment(initial.handles[ends[0]], initial.handles[ends[1]]);
      REQUIRE(slot != Complex::none);
      CHECK(initial.complex.subsegment(slot).segment == s);
    }
  }
}

TEST_CASE("A box that is its own hull gets no box around it", "[conforming]") {
  CHECK(pgdr::is_box(pgdr::make_domain_3(box())));
  CHECK(pgdr::is_box(pgdr::make_domain_3(gridded_box(3))));
  CHECK(!pgdr::is_box(pgdr::make_domain_3(tilted(box()))));
  // The normal of a side that is tilted by a rounding error is an axis, and yet no point in its middle is on the hull.
  CHECK(!pgdr::is_box(pgdr::make_domain_3(pgdr::read_plc(data_file("../test/corpus/tilted_plate.poly")))));
  Plc two = box();
  add_box(two, {2, 0, 0}, {3, 1, 1});
  CHECK(!pgdr::is_box(pgdr::make_domain_3(two)));
  CHECK(Initial(box()).tr.number_of_vertices() == 8);
  const Initial framed(tilted(box()));
  REQUIRE(framed.tr.number_of_vertices() == 16);
  for (auto v = framed.tr.finite_vertices_begin(); v != framed.tr.finite_vertices_end(); ++v) {
    if (v->in_dimension() == 0) continue;
    CHECK(v->in_dimension() == 4);
    // Between half of the diagonal and twice of it away.
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = pgdr::to_vec(v->point())[static_cast<int>(i)];
      const double gap = std::max(framed.domain.lower[i] - x, x - framed.domain.upper[i]);
      CHECK(gap >= framed.domain.diagonal / 2);
      CHECK(gap <= 2 * framed.domain.diagonal);
    }
  }
}

TEST_CASE("Halving a subsegment moves its links to the halves", "[conforming]") {
  Initial initial(box());
  Complex& complex = initial.complex;
  const auto a = complex.subsegment(3).vertices[0], b = complex.subsegment(3).vertices[1];
  const pgdr::Index segment = complex.subsegment(3).segment;
  const pgdr::Piece_id old = complex.subsegment_id(3);
  const auto middle = [](auto u, auto w) { return CGAL::midpoint(u->point(), w->point()); };
  auto v = initial.tr.insert(middle(a, b));
  v->set_feature(1, segment);
  CHECK(complex.is_live_subsegment(old));
  const auto halves = complex.halve_subsegment(initial.pool, 3, v);
  CHECK(complex.find_subsegment(a, b) == Complex::none);
  CHECK(complex.find_subsegment(a, v) == halves[0]);
  CHECK(complex.find_subsegment(v, a) == halves[0]);
  CHECK(complex.find_subsegment(v, b) == halves[1]);
  CHECK(complex.find_subsegment(b, v) == halves[1]);
  for (const auto h : halves) {
    CHECK(complex.subsegment(h).segment == segment);
    CHECK(!complex.subsegment(h).present);
  }
  CHECK(complex.is_on_segment(v, segment));
  for (const pgdr::Index f : initial.domain.segments[segment].facets) CHECK(complex.is_on_facet(v, f));
  int facets = 0;
  for (pgdr::Index f = 0; f < initial.domain.facets.size(); ++f) facets += complex.is_on_facet(v, f);
  CHECK(facets == 2);

  complex.remove_subsegment(initial.pool, 3);
  CHECK(!complex.is_live_subsegment(old));
  // Its slot is used again, but is not mistaken for the old one.
  const auto w = initial.tr.insert(middle(a, v));
  w->set_feature(1, segment);
  const auto quarters = complex.halve_subsegment(initial.pool, halves[0], w);
  CHECK(quarters[0] == 3);
  CHECK(complex.is_live_subsegment(complex.subsegment_id(3)));
  CHECK(!complex.is_live_subsegment(old));
  CHECK(complex.find_subsegment(a, w) == quarters[0]);
  CHECK(complex.find_subsegment(w, v) == quarters[1]);
  CHECK(complex.find_subsegment(v, b) == halves[1]);
  CHECK(complex.find_subsegment(a, v) == Complex::none);
}

TEST_CASE("Flips keep the neighbours of subfacets in order", "[conforming]") {
  Initial initial(tilted(gridded_box(8)));
  Complex& complex = initial.complex;
  const auto subfacets = initial.subfacets();
  Seeded_random random(21);
  int flips = 0;
  for (int k = 0; k < 3000; ++k) {
    const std::uint32_t t = subfacets[random.below(static_cast<std::uint32_t>(subfacets.size()))];
    const std::size_t i = random.below(3);
    const std::uint32_t u = complex.subfacet(t).neighbors[i];
    if (u & Complex::subsegment_bit) continue;
    const pgdr::Index facet = complex.subfacet(t).facet;
    const auto& v = complex.subfacet(t).vertices;
    const auto apex = v[i], from = v[(i + 1) % 3], to = v[(i + 2) % 3];
    const auto opposite =
        complex.subfacet(u).vertices[static_cast<std::size_t>(complex.edge_with_neighbor(u, t))];
    if (complex.orientation(facet, apex->point(), from->point(), opposite->point()) != CGAL::POSITIVE ||
        complex.orientation(facet, opposite->point(), to->point(), apex->point()) != CGAL::POSITIVE)
      continue;
    const pgdr::Piece_id before = complex.subfacet_id(t), other = complex.subfacet_id(u);
    complex.flip(t, u);
    ++flips;
    CAPTURE(k, t, u);
    CHECK(!complex.is_live_subfacet(before));
    CHECK(!complex.is_live_subfacet(other));
    // The common edge is the other diagonal now.
    const int edge = complex.edge_with_neighbor(t, u);
    REQUIRE(edge >= 0);
    const auto e = static_cast<std::size_t>(edge);
    const auto p = complex.subfacet(t).vertices[(e + 1) % 3], q = complex.subfacet(t).vertices[(e + 2) % 3];
    CHECK(((p == apex && q == opposite) || (p == opposite && q == apex)));
    if (k % 100 == 0) REQUIRE(initial.fault() == "");
  }
  CHECK(flips > 500);
  CHECK(initial.fault() == "");
}

TEST_CASE("The audit of a complex notices faults", "[conforming]") {
  // Without this the other tests could pass for the wrong reason.
  const auto spoiled = [](auto spoil) {
    Initial initial(tilted(gridded_box(3)));
    REQUIRE(initial.fault() == "");
    spoil(initial.complex);
    return initial.fault();
  };
  const auto inner_edge = [](const Complex& c) {
    for (std::uint32_t t = 0;; ++t)
      for (std::size_t i = 0; i < 3; ++i)
        if (!(c.subfacet(t).neighbors[i] & Complex::subsegment_bit)) return std::make_pair(t, i);
  };
  CHECK(spoiled([&](Complex& c) {
          const auto [t, i] = inner_edge(c);
          c.subfacet(t).neighbors[i] = t;
        }) != "");
  CHECK(spoiled([](Complex& c) { c.subsegment(2).subfacets.pop_back(); }) != "");
  CHECK(spoiled([](Complex& c) { c.subsegment(2).version.advance(); }) != "");
  CHECK(spoiled([](Complex& c) { c.subfacet(2).version.advance(); }) != "");
  CHECK(spoiled([](Complex& c) { std::swap(c.subfacet(4).vertices[0], c.subfacet(4).vertices[1]); }) != "");
  CHECK(spoiled([](Complex& c) { c.subsegment(1).vertices[0] = c.subsegment(1).vertices[1]; }) != "");
}

TEST_CASE("Distances to small angles", "[conforming]") {
  // A prism over a triangle with 30 degrees at the origin: the edge there and both of its ends are acute.
  Plc prism;
  const double t = std::tan(std::acos(-1.0) / 6);
  for (const double z : {0.0, 4.0})
    for (const auto& [x, y] : {std::array<double, 2>{0, 0}, {3, 0}, {3, 3 * t}})
      prism.vertices.emplace_back(x, y, z);
  for (const std::vector<pgdr::Index>& p :
       {std::vector<pgdr::Index>{0, 1, 2}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}})
    prism.facets.push_back({{p}, {}, 0});
  const auto domain = pgdr::make_domain_3(prism);
  const pgdr::Acute_neighborhood_3 acute(domain);
  for (pgdr::Index v = 0; v < 6; ++v) CHECK(acute.is_acute_vertex(v) == (v == 0 || v == 3));
  Seeded_random random(22);
  int inside = 0;
  for (int k = 0; k < 500; ++k) {
    const pgdr::Vec_3 p{random.between(-2, 4), random.between(-2, 4), random.between(-2, 6)};
    const double beyond = std::max({0.0, -p.z, p.z - 4});
    const double distance = std::sqrt(p.x * p.x + p.y * p.y + beyond * beyond);
    CAPTURE(k, p.x, p.y, p.z, distance);
    CHECK(acute.contains(p, distance * (1 + 1e-9)));
    CHECK(!acute.contains(p, distance * (1 - 1e-9)));
    inside += beyond == 0;
  }
  CHECK(inside > 100);

  // The two facets at the acute edge, and in the bottom the two segments at its acute corner.
  const auto facet_with = [&](pgdr::Index a, pgdr::Index b, pgdr::Index c) {
    for (pgdr::Index f = 0; f < domain.facets.size(); ++f) {
      const auto& v = domain.facets[f].vertices;
      if (std::ranges::count(v, a) + std::ranges::count(v, b) + std::ranges::count(v, c) == 3) return f;
    }
    return pgdr::Index(-1);
  };
  const auto segment_with = [&](pgdr::Index a, pgdr::Index b) {
    for (pgdr::Index s = 0; s < domain.segments.size(); ++s)
      if (domain.segments[s].vertices == std::array<pgdr::Index, 2>{a, b}) return s;
    return pgdr::Index(-1);
  };
  const pgdr::Index side = facet_with(0, 1, 4), wall = facet_with(0, 2, 5), end = facet_with(1, 2, 4);
  const pgdr::Vec_3 p{2, 0, 2}, mirrored{2 * std::cos(0.5), 2 * std::sin(0.5), 2};
  CHECK(acute.explains({2, side}, p, {2, wall}, mirrored));
  CHECK(acute.explains({2, wall}, mirrored, {2, side}, p));
  CHECK_FALSE(acute.explains({2, side}, p, {2, side}, {2, 0, 2.1}));         // one facet
  CHECK_FALSE(acute.explains({2, side}, p, {2, wall}, {2, 0.4, 2}));         // closer than half of what the angle makes
  CHECK_FALSE(acute.explains({2, side}, {2.9, 0, 2}, {2, end}, {3, 0.1, 2}));  // meet at 90 degrees
  CHECK_FALSE(acute.explains({3, 0}, p, {2, wall}, mirrored));               // a point of the volume
  CHECK(acute.explains({1, segment_with(0, 1)}, {2, 0, 0}, {1, segment_with(0, 2)}, {2 * std::cos(0.5), 2 * std::sin(0.5), 0}));
  CHECK_FALSE(acute.explains({1, segment_with(0, 1)}, {2, 0, 0}, {2, facet_with(0, 1, 2)}, {2, 0.6, 0}));  // bounds it

  const pgdr::Acute_neighborhood_3 none(pgdr::make_domain_3(tilted(box())));
  for (pgdr::Index v = 0; v < 8; ++v) CHECK(!none.is_acute_vertex(v));
  CHECK(!none.contains({0, 0, 0}, 1e9));
}

TEST_CASE("What is in a bent facet stays in it on the plane, however narrow it is", "[conforming]") {
  std::size_t tried = 0;
  for (const double bend : {1e-6, -3e-6, 5e-6}) {
    const Initial initial(tilted(bent_needle(bend)));
    for (const std::uint32_t t : initial.subfacets()) {
      const auto& subfacet = initial.complex.subfacet(t);
      if (!initial.complex.is_bent(subfacet.facet)) continue;
      // Near the tip of the needle, which is narrower than the bend there.
      const Vec_3 tip = pgdr::position(subfacet.vertices[0]), middle = pgdr::barycenter(subfacet), in = tip + 0.01 * (middle - tip);
      const Vec_3 m = initial.complex.on_plane(subfacet.facet, in);
      CHECK(std::abs(dot(m - pgdr::to_vec(initial.domain.facets[subfacet.facet].origin), initial.complex.plane(subfacet.facet).normal())) < 1e-12);
      CHECK(pgdr::is_in_subfacet(initial.complex, subfacet, Tr::Point(m.x, m.y, m.z)));
      const Vec_3 lifted = initial.complex.on_sheet(t, m);
      CHECK(length(lifted - in) < 1e-12);
      CHECK(length(initial.complex.on_sheet(t, lifted) - lifted) < 1e-12);  // what was handed on is lifted by whom it reaches, too
      ++tried;
    }
  }
  CHECK(tried >= 6);
}
