// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <pgdr/octree/octree_box.h>
#include <pgdr/octree/octree_key.h>

#include "catch.h"
#include "octree/random_octree.h"
#include "seeded_random.h"

using pgdr::Octree_key;

namespace {

/// Morton code bit by bit, from the definition.
std::uint64_t interleave(const Octree_key& key) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int bit = 0; bit < Octree_key::max_level; ++bit) {
      if (key.lower_units(axis) >> bit & 1U) code |= std::uint64_t{1} << (3 * bit + axis);
    }
  }
  return code;
}

std::vector<Octree_key> all_keys(int max_level) {
  std::vector<Octree_key> keys{Octree_key{}};
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Octree_key key = keys[i];
    if (key.level == max_level) break;
    for (int c = 0; c < 8; ++c) keys.push_back(key.child(c));
  }
  return keys;
}

}  // namespace

TEST_CASE("children, parents and parity of octree keys agree") {
  for (const Octree_key& key : all_keys(2)) {
    for (int c = 0; c < 8; ++c) {
      CHECK(key.child(c).parent() == key);
      CHECK(key.child(c).parity() == c);
      CHECK(2 * edge_units(key.child(c)) == edge_units(key));
      CHECK(contains(key, key.child(c)));
      CHECK_FALSE(contains(key.child(c), key));
    }
  }
}

TEST_CASE("Morton codes interleave the bits of the lower corner") {
  pgdr_test::Seeded_random random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto level = static_cast<std::uint8_t>(random.below(Octree_key::max_level + 1));
    const std::uint32_t end = std::uint32_t{1} << level;
    const Octree_key key{random.below(end), random.below(end), random.below(end), level};
    CHECK(key.morton() == interleave(key));
  }
  const std::uint32_t last = (std::uint32_t{1} << Octree_key::max_level) - 1;
  CHECK(Octree_key{last, last, last, Octree_key::max_level}.morton() == (std::uint64_t{1} << 60U) - 1);
}

TEST_CASE("sorting keys puts ancestors first and subtrees in one piece") {
  std::vector<Octree_key> keys = all_keys(3);
  std::sort(keys.begin(), keys.end(), pgdr::precedes);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    std::size_t end = i;
    while (end < keys.size() && contains(keys[i], keys[end])) ++end;
    const auto below =
        std::count_if(keys.begin(), keys.end(), [&](const Octree_key& k) { return contains(keys[i], k); });
    CHECK(end - i == static_cast<std::size_t>(below));
    CHECK_FALSE(precedes(keys[i], keys[i]));
  }
}

TEST_CASE("touch and contains agree with closed cubes in space") {
  const pgdr::Octree_box box = pgdr_test::unit_cube();
  const std::vector<Octree_key> keys = all_keys(3);
  std::size_t wrong = 0, touching = 0;
  for (const Octree_key& a : keys) {
    const auto lower_a = box.lower(a), upper_a = box.upper(a);
    for (const Octree_key& b : keys) {
      const auto lower_b = box.lower(b), upper_b = box.upper(b);
      bool meet = true, overlap = true, inside = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        meet = meet && lower_a[axis] <= upper_b[axis] && lower_b[axis] <= upper_a[axis];
        overlap = overlap && lower_a[axis] < upper_b[axis] && lower_b[axis] < upper_a[axis];
        inside = inside && lower_a[axis] <= lower_b[axis] && upper_b[axis] <= upper_a[axis];
      }
      wrong += touch(a, b) != (meet && !overlap);
      wrong += touch(a, b) != touch(b, a);
      wrong += contains(a, b) != inside;
      touching += touch(a, b);
    }
  }
  CHECK(wrong == 0);
  CHECK(touching > 10000);
}
