// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/refinement/radius_queue.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "catch.h"
#include "seeded_random.h"

namespace {

struct Item {
  float radius;
  int number;
};

/// Powers of two from 1/8 to 16, times 1 to 2.
float some_radius(pgdr_test::Seeded_random& random) {
  return static_cast<float>(1u << random.below(8)) / 8 * (1 + static_cast<float>(random.below(1000)) / 1000);
}

int size_class(const Item& i) { return std::ilogb(i.radius); }

}  // namespace

TEST_CASE("Large elements come before small ones, those of about the same size as they came", "[refinement]") {
  pgdr_test::Seeded_random random(3);
  pgdr::Radius_queue<Item> queue;
  constexpr int n = 2000;
  for (int k = 0; k < n; ++k) queue.push({some_radius(random), k});
  REQUIRE(queue.size() == n);

  Item last = queue.pop();
  std::size_t popped = 1;
  const auto follows = [&](const Item& i) {
    return size_class(i) < size_class(last) || (size_class(i) == size_class(last) && i.number > last.number);
  };
  for (; size_class(last) > 0; ++popped) {
    const Item i = queue.pop();
    REQUIRE(follows(i));
    last = i;
  }
  // The rest of this class, and the next one, whole.
  for (const int expected : {0, -1}) {
    auto all = queue.pop_class();
    REQUIRE_FALSE(all.empty());
    popped += all.size();
    while (!all.empty()) {
      const Item i = all.pop();
      REQUIRE(size_class(i) == expected);
      REQUIRE(follows(i));
      last = i;
    }
  }
  CHECK(queue.size() == n - popped);
  // What is left of a class that was taken comes first again.
  auto rest = queue.pop_class();
  const Item first = rest.pop();
  const std::size_t left = rest.size();
  queue.push_class(std::move(rest));
  CHECK(queue.size() == n - popped - 1);
  CHECK(size_class(queue.next()[0]) == size_class(first));
  CHECK(queue.next().size() == left);
  queue.push_class({});
  CHECK(queue.size() == n - popped - 1);
  CHECK(queue.pop().radius < 0.5);
}
