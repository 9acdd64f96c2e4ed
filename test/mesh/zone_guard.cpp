// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/mesh/zone_guard_3.h>

#include <cmath>
#include <stdexcept>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/mesh/cavity_3.h>

#include "catch.h"
#include "seeded_random.h"

using namespace pgdr_test;

namespace {

using Tr = pgdr::Mesh_triangulation_3<pgdr::Default_kernel>;
using Point = Tr::Point;
using Guard = pgdr::Zone_guard_3<Tr>;

/// Random points in the cube from -2 to 2, its corners included.
void fill(Tr& tr, int n) {
  for (int k = 0; k < 8; ++k) tr.insert(Point(k & 1 ? 2 : -2, k & 2 ? 2 : -2, k & 4 ? 2 : -2));
  Seeded_random random(17);
  for (int k = 0; k < n; ++k)
    tr.insert(Point(random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)));
}

pgdr::Region_3 cube(double lower, double upper) {
  return {{lower, lower, lower}, {upper, upper, upper}};
}

std::size_t owned(const Tr& tr) {
  std::size_t n = 0;
  for (auto c = tr.all_cells_begin(); c != tr.all_cells_end(); ++c)
    n += Tr::Cell_handle(c)->owner().load(std::memory_order_relaxed) != 0;
  return n;
}

}  // namespace

TEST_CASE("A task may touch what is in its reach, and owns it until it ends", "[mesh]") {
  Tr tr;
  fill(tr, 300);
  const auto c = tr.locate(Point(0.1, 0.2, 0.3));
  Guard guard;
  guard.open(tr, cube(-2, 2), 1);
  guard.touch(c);
  CHECK(owned(tr) == 1);
  CHECK_NOTHROW(guard.touch(c));  // its own
  for (int i = 0; i < 4; ++i) CHECK_NOTHROW(guard.touch(c->neighbor(i)));
  CHECK(owned(tr) == 5);
  guard.close();
  CHECK(owned(tr) == 0);
  // Without a task there is nothing to guard.
  guard.touch(c);
  CHECK(owned(tr) == 0);
}

TEST_CASE("Two running tasks that touch one tetrahedron are caught", "[mesh]") {
  Tr tr;
  fill(tr, 300);
  const auto c = tr.locate(Point(0.1, 0.2, 0.3));
  Guard one, two;
  one.open(tr, cube(-2, 2), 1);
  two.open(tr, cube(-2, 2), 2);
  one.touch(c);
  CHECK_THROWS_AS(two.touch(c), std::logic_error);
  one.close();
  two.close();
  // One after the other they may.
  one.open(tr, cube(-2, 2), 1);
  one.touch(c);
  one.close();
  two.open(tr, cube(-2, 2), 2);
  CHECK_NOTHROW(two.touch(c));
  two.close();
  CHECK(owned(tr) == 0);
}

TEST_CASE("A task that leaves its reach is caught", "[mesh]") {
  Tr tr;
  fill(tr, 2000);
  std::size_t inside = 0, outside = 0;
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) {
    bool within = true;
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 3; ++k) within = within && std::abs(pgdr::position(c->vertex(i))[k]) <= 1;
    Guard guard;
    guard.open(tr, cube(-1, 1), 1);
    if (within)
      CHECK_NOTHROW(guard.touch(c));
    else
      CHECK_THROWS_AS(guard.touch(c), std::logic_error);
    guard.close();
    ++(within ? inside : outside);
  }
  CHECK(inside > 100);
  CHECK(outside > 100);
}

TEST_CASE("A guarded cavity reports what it reads and what it makes", "[mesh]") {
  Tr tr;
  fill(tr, 500);
  const Point p(0.1, 0.2, 0.3);
  pgdr::Cavity_3<Tr> cavity(tr);
  Guard guard, other;
  cavity.set_guard(&guard);

  guard.open(tr, cube(0.09, 0.31), 1);
  CHECK_THROWS_AS(cavity.find(p, tr.locate(p)), std::logic_error);
  cavity.abandon();
  guard.close();

  guard.open(tr, cube(-2, 2), 1);
  REQUIRE(cavity.find(p, tr.locate(p)));
  const auto boundary = cavity.boundary();
  REQUIRE(owned(tr) > cavity.cells().size());  // the ring around it, too
  const auto v = cavity.commit(p);
  other.open(tr, cube(-2, 2), 2);
  for (const auto c : cavity.star()) CHECK_THROWS_AS(other.touch(c), std::logic_error);
  guard.close();
  other.close();
  for (const auto c : cavity.star()) CHECK(c->owner().load(std::memory_order_relaxed) == 0);
  CHECK(tr.is_vertex(v));
  CHECK(tr.is_valid());
}
