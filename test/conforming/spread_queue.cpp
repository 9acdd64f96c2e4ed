// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/conforming/spread_queue.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "catch.h"
#include "seeded_random.h"

namespace {

using Queue = pgdr::Spread_queue<std::uint32_t>;

std::vector<std::uint32_t> emptied(Queue& queue) {
  std::vector<std::uint32_t> order;
  while (!queue.empty()) {
    const std::uint32_t next = queue.next();
    order.push_back(queue.pop());
    REQUIRE(order.back() == next);
  }
  return order;
}

}  // namespace

TEST_CASE("What comes at once is taken far apart first, all of it once", "[conforming]") {
  constexpr std::uint32_t n = 1000;
  Queue queue;
  for (std::uint32_t k = 1; k <= n; ++k) queue.push(k);
  REQUIRE(queue.size() == n);
  const std::vector<std::uint32_t> order = emptied(queue);
  auto sorted = order;
  std::ranges::sort(sorted);
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 1u);
  CHECK(sorted == all);

  // Every 128th, then every 64th of the others, down to each second one.
  std::size_t taken = 0;
  for (std::uint32_t apart = 128; apart >= 1; apart /= 2) {
    while (taken < order.size() && order[taken] % apart == 0) ++taken;
    INFO(apart);
    CHECK(taken == n / apart);
  }
}

TEST_CASE("A queue that spreads keeps what it holds through pushes and pops in between", "[conforming]") {
  pgdr_test::Seeded_random random(17);
  Queue queue;
  std::vector<std::uint32_t> inside;
  for (std::uint32_t k = 0; k < 20000; ++k) {
    if (inside.empty() || random.below(10) < (k / 5000 % 2 == 0 ? 7u : 3u)) {
      queue.push(k);
      inside.push_back(k);
    } else {
      const auto at = std::ranges::find(inside, queue.pop());
      REQUIRE(at != inside.end());
      inside.erase(at);
    }
    REQUIRE(queue.size() == inside.size());
    if (k % 100 == 0) queue.release_if_empty();  // of a level that is not, it takes nothing
  }
  REQUIRE(inside.size() > 10);

  Queue other;
  other.push(30000);
  other.take_all(queue);
  inside.push_back(30000);
  CHECK(queue.empty());
  auto all = emptied(other);
  std::ranges::sort(all);
  std::ranges::sort(inside);
  CHECK(all == inside);
}
