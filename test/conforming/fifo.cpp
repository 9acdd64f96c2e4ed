// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/conforming/fifo.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>

#include "catch.h"
#include "seeded_random.h"

TEST_CASE("A queue gives back in order what was put in", "[conforming]") {
  // Long enough for the spent front to be cut off several times.
  pgdr::Fifo<std::uint32_t> queue;
  std::deque<std::uint32_t> expected;
  pgdr_test::Seeded_random random(31);
  for (std::uint32_t k = 0; k < 50000; ++k) {
    const bool grows = k / 10000 % 2 == 0;
    if (expected.empty() || random.below(10) < (grows ? 7u : 3u)) {
      queue.push(k);
      expected.push_back(k);
    } else {
      REQUIRE(queue.pop() == expected.front());
      expected.pop_front();
    }
    REQUIRE(queue.size() == expected.size());
    REQUIRE(queue.empty() == expected.empty());
    if (!expected.empty()) {
      const std::uint32_t at = random.below(static_cast<std::uint32_t>(expected.size()));
      REQUIRE(queue[at] == expected[at]);
    }
    if (k % 100 == 0) {
      queue.release_if_empty();  // of a queue that is not, it takes nothing
      REQUIRE(std::equal(queue.begin(), queue.end(), expected.begin(), expected.end()));
    }
  }
  REQUIRE(expected.size() > 100);
  queue.clear();
  CHECK(queue.empty());
  queue.release_if_empty();
  queue.push(5);
  CHECK(queue.pop() == 5);
  CHECK(queue.empty());
}

TEST_CASE("A queue holds what can only be moved", "[conforming]") {
  pgdr::Fifo<std::unique_ptr<int>> queue;
  for (int k = 0; k < 3000; ++k) queue.push(std::make_unique<int>(k));
  for (int k = 0; k < 3000; ++k) {
    const auto item = queue.pop();
    REQUIRE(*item == k);
  }
  CHECK(queue.empty());
}
