// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/refinement/outside_cells_3.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <CGAL/Delaunay_triangulation_3.h>

#include <pgdr/domain/default_kernel.h>

#include "catch.h"
#include "seeded_random.h"

using namespace pgdr_test;

namespace {

using K = pgdr::Default_kernel;
using Tr = pgdr::Mesh_triangulation_3<K>;

auto corners(const Tr& tr) {
  std::vector<decltype(pgdr::sorted_corners(Tr::Cell_handle()))> all;
  for (const Tr::Cell_handle c : pgdr::outside_cells(tr)) all.push_back(pgdr::sorted_corners(c));
  return all;
}

}  // namespace

TEST_CASE("The tetrahedra outside have an order and a volume that do not tell how they were made", "[refinement]") {
  Seeded_random random(3);
  std::vector<K::Point_3> points;
  for (int k = 0; k < 8; ++k) points.emplace_back(k & 1, k >> 1 & 1, k >> 2);
  for (int k = 0; k < 300; ++k) points.emplace_back(random.between(0, 1), random.between(0, 1), random.between(0, 1));
  Tr one, other;
  for (auto p = points.begin(); p != points.end(); ++p) one.insert(*p);
  for (auto p = points.rbegin(); p != points.rend(); ++p) other.insert(*p);
  CHECK(corners(one) == corners(other));
  CHECK(corners(one).size() == one.number_of_finite_cells());
  const double volume = pgdr::outside_volume(one, 1);
  CHECK(volume == pgdr::outside_volume(other, 1));
  CHECK(std::abs(volume - 1) < 1e-10);
  one.finite_cells_begin()->set_subdomain(1);
  CHECK(corners(one).size() + 1 == one.number_of_finite_cells());
  CHECK(pgdr::outside_volume(one, 1) < volume);
}
