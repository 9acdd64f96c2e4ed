// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that make room for a point by passing behind flat cells.
#include <pgdr/conforming/sheet_shift_3.h>

#include <cstdint>
#include <set>
#include <vector>

#include <pgdr/conforming/cavity_features_3.h>

#include "catch.h"
#include "conforming/consistency.h"
#include "conforming/gridded_box.h"
#include "refinement/refined.h"

using namespace pgdr_test;
using Tr = Mesh::Triangulation;

namespace {

/// The vertices of all subfacets.
std::set<std::set<const void*>> triangles(const Mesh::Complex& complex) {
  std::set<std::set<const void*>> all;
  for (std::uint32_t t = 0; t < complex.subfacet_slots(); ++t) {
    if (!complex.subfacet(t).alive()) continue;
    std::set<const void*> one;
    for (const auto v : complex.subfacet(t).vertices) one.insert(&*v);
    all.insert(one);
  }
  return all;
}

/// On the way from a flat cell to the vertex beyond its i-th face, a tenth of the cell's size away.
Tr::Point point_beyond(Tr::Cell_handle c, int i) {
  pgdr::Vec_3 middle{};
  for (int k = 0; k < 4; ++k) middle = middle + 0.25 * position(c->vertex(k));
  const Tr::Cell_handle n = c->neighbor(i);
  const pgdr::Vec_3 away = position(n->vertex(n->index(c))) - middle;
  const pgdr::Vec_3 at = middle + (0.1 * length(position(c->vertex(0)) - middle) / length(away)) * away;
  return {at.x, at.y, at.z};
}

/// Cells outside with two subfacets, beyond which the domain is, and all vertices on the facet of these.
std::vector<Tr::Cell_handle> flat_cells_outside(const Mesh& mesh) {
  const auto& tr = mesh.triangulation();
  std::vector<Tr::Cell_handle> flat;
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) {
    int towards_domain = 0;
    for (int i = 0; i < 4; ++i) towards_domain += c->subfacet(i) != Mesh::Complex::none && c->neighbor(i)->subdomain() != 0;
    if (c->subdomain() == 0 && towards_domain == 2 && pgdr::subfacet_of_flat_cell(mesh.complex(), c) != Mesh::Complex::none) flat.push_back(c);
  }
  return flat;
}

/// A box with flat cells at its top, and what a thread needs to move sheets across them.
struct Tilted_grid {
  Mesh mesh = refined(tilted(gridded_box(16)));
  Tr& tr = mesh.triangulation();
  Mesh::Complex& complex = mesh.complex();
  pgdr::Cavity_3<Tr> cavity{tr};
  pgdr::Sheet_shift_3<Tr> sheets;
};

}  // namespace

TEST_CASE("A sheet moves across the flat cells that keep a point out, and back", "[conforming]") {
  Tilted_grid grid;
  auto& [mesh, tr, complex, cavity, sheets] = grid;
  pgdr::Cavity_features_3<Tr> features;
  const auto before = triangles(complex);
  int blocked = 0;
  for (const auto c : flat_cells_outside(mesh)) {
    int i = 0;
    while (c->subfacet(i) == Mesh::Complex::none || c->neighbor(i)->subdomain() == 0) ++i;
    const auto inner = c->neighbor(i);
    const Tr::Point p = point_beyond(c, i);
    if (!cavity.find(p, c)) continue;
    features.gather(complex, cavity);
    if (features.deletes_any()) {
      ++blocked;
      REQUIRE(sheets.shift(complex, tr, cavity, p));
      features.gather(complex, cavity);
      CHECK(!features.deletes_any());
      CHECK(c->subdomain() == inner->subdomain());
      CHECK(triangles(complex) != before);
      const auto moved = sheets.moved();
      sheets.take_back(complex);
      for (const auto& m : moved) CHECK(m.cell->subdomain() == m.from);
    }
    cavity.abandon();
    CHECK(triangles(complex) == before);
  }
  CHECK(blocked > 10);
  CHECK(inconsistency(tr, complex) == "");
}

TEST_CASE("A sheet stays where a point is on its other side", "[conforming]") {
  Tilted_grid grid;
  auto& [mesh, tr, complex, cavity, sheets] = grid;
  int tried = 0;
  for (const auto c : flat_cells_outside(mesh)) {
    int i = 0;
    while (c->subfacet(i) != Mesh::Complex::none) ++i;
    if (tr.is_infinite(c->neighbor(i))) continue;
    const Tr::Point p = point_beyond(c, i);
    if (!cavity.find(p, c)) continue;
    ++tried;
    CHECK(!sheets.shift(complex, tr, cavity, p));
    cavity.abandon();
  }
  CHECK(tried > 10);
}
