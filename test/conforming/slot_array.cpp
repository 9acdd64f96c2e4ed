// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/conforming/slot_array.h>

#include <cstdint>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "catch.h"

using Array = pgdr::Slot_array<std::uint64_t>;

TEST_CASE("Slots are distinct, zero to begin with, and stay where they are", "[conforming]") {
  Array array;
  Array::Pool pool;
  std::vector<std::uint64_t*> where;
  for (std::uint32_t k = 0; k < 5000; ++k) {
    const std::uint32_t i = array.take(pool);
    REQUIRE(i == k);  // one pool alone counts up
    REQUIRE(array[i] == 0);
    array[i] = 7 * k + 1;
    where.push_back(&array[i]);
  }
  CHECK(array.size() >= 5000);
  CHECK(array.size() < 5000 + 64);
  for (std::uint32_t k = 0; k < 5000; ++k) {
    REQUIRE(&array[k] == where[k]);
    REQUIRE(array[k] == 7 * k + 1);
  }
  // What is below the size may be looked at, though no one took it.
  for (auto i = static_cast<std::uint32_t>(where.size()); i < array.size(); ++i) CHECK(array[i] == 0);
}

TEST_CASE("A slot that was given back is taken first", "[conforming]") {
  Array array;
  Array::Pool pool, other;
  for (int k = 0; k < 10; ++k) array.take(pool);
  pool.free.push_back(3);
  pool.free.push_back(8);
  CHECK(array.take(other) >= 10);  // another pool's slots are its own
  CHECK(array.take(pool) == 8);
  CHECK(array.take(pool) == 3);
  CHECK(array.take(pool) == 10);
}

TEST_CASE("Several threads take slots at once", "[conforming]") {
  Array array;
  constexpr std::size_t threads = 8, each = 20000;
  std::vector<std::vector<std::uint32_t>> taken(threads);
  std::vector<std::thread> running;
  for (std::size_t t = 0; t < threads; ++t)
    running.emplace_back([&array, &mine = taken[t], t] {
      Array::Pool pool;
      for (std::size_t k = 0; k < each; ++k) {
        mine.push_back(array.take(pool));
        array[mine.back()] = t * each + k;
        if (k % 5 == 4) {
          pool.free.push_back(mine.back());
          mine.pop_back();
        }
      }
    });
  for (auto& t : running) t.join();
  std::set<std::uint32_t> all;
  for (const auto& mine : taken) all.insert(mine.begin(), mine.end());
  CHECK(all.size() == threads * each * 4 / 5);
  CHECK(*all.rbegin() < array.size());
  // Each slot holds what its own thread wrote last.
  std::size_t wrong = 0;
  for (std::size_t t = 0; t < threads; ++t)
    for (const std::uint32_t i : taken[t]) wrong += array[i] / each != t;
  CHECK(wrong == 0);
}

TEST_CASE("No more slots are given out than there are numbers", "[conforming]") {
  for (const std::uint32_t most : {1u, 64u, 100u, 300u}) {
    Array array(most);
    Array::Pool one, other;
    std::set<std::uint32_t> taken;
    const auto take_all = [&](Array::Pool& pool) {
      while (true) taken.insert(array.take(pool));
    };
    taken.insert(array.take(other));
    CHECK_THROWS_AS(take_all(one), std::length_error);
    CHECK_THROWS_AS(take_all(other), std::length_error);
    CHECK(taken.size() == most);
    CHECK(*taken.rbegin() == most - 1);
    other.free.push_back(0);
    CHECK(array.take(other) == 0);  // what is given back may be used again
  }
}
