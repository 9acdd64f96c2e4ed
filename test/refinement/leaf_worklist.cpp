// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/refinement/leaf_worklist_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/mesh/mesh_triangulation_3.h>

#include "catch.h"
#include "seeded_random.h"

using namespace pgdr_test;

namespace {

using Tr = pgdr::Mesh_triangulation_3<pgdr::Default_kernel>;
using Worklist = pgdr::Leaf_worklist_3<Tr>;
using Cell_id = Worklist::Cell_id;

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

/// Tetrahedra of random points, on a worklist with radii from 1 to 8.
struct Work {
  Work() {
    Seeded_random random(1);
    for (int k = 0; k < 1000; ++k) tr.insert(Tr::Point(random.between(0, 1), random.between(0, 1), random.between(0, 1)));
    for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c)
      list.add_poor({c, c->generation(), static_cast<float>(random.between(1, 8))}, 0);
    all = list.active();
  }

  Tr tr;
  Worklist list;
  std::size_t all = 0;
};

}  // namespace

TEST_CASE("Tetrahedra are handed out to the last one, or as many as a part may have", "[refinement]") {
  for (const std::size_t most : {unlimited, std::size_t{100}}) {
    Work work;
    std::vector<Worklist> parts(3);
    std::uint16_t turn = 0;
    work.list.divide(parts, [&](const auto&...) { return static_cast<std::uint16_t>(1 + turn++ % 3); }, most);
    std::size_t handed_out = 0;
    for (Worklist& part : parts) {
      CHECK((most == unlimited || part.active() == most));
      handed_out += part.active();
      while (part.has_active()) CHECK(part.pop_active().radius >= (most == unlimited ? 1 : 4));  // the largest ones
    }
    CHECK(handed_out + work.list.active() == work.all);
    CHECK(turn == handed_out);  // nobody asks about the others
  }
}

TEST_CASE("Where a large tetrahedron stays, so do smaller ones", "[refinement]") {
  Work work;
  std::vector<Worklist> parts(2);
  const auto number_of = [](const auto& item, const auto&...) {
    if constexpr (requires { item.radius; }) return static_cast<std::uint16_t>(item.radius > 3.9f && item.radius < 3.99f ? 0 : 1);
    return std::uint16_t{1};
  };
  work.list.divide(parts, number_of, unlimited);
  CHECK(parts[0].active() > work.all / 2);
  CHECK(parts[1].active() == 0);
  CHECK(parts[0].active() + work.list.active() == work.all);
  while (parts[0].has_active()) CHECK(parts[0].pop_active().radius >= 2);
}
