// SPDX-License-Identifier: GPL-3.0-or-later
// The loops of the room: every item once, chunks and results that do not depend on the number of threads.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <forward_list>
#include <functional>
#include <mutex>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_in_order.h>
#include <pgdr/parallel/parallel_reduce.h>
#include <pgdr/parallel/parallel_sort.h>
#include <pgdr/parallel/parallel_walk.h>
#include <pgdr/parallel/thread_arena.h>

#include "catch.h"
#include "thread_counts.h"

namespace {

constexpr std::size_t sizes[] = {0, 1, 2, 9, 10, 11, 20, 1000, 12345};

}  // namespace

TEST_CASE("with_threads sets the number of threads and gives back what its function returns", "[parallel]") {
  const unsigned outside = pgdr::thread_count();
  for (const unsigned n : {1u, 2u, 3u, 8u, 16u}) CHECK(pgdr::with_threads(n, [] { return pgdr::thread_count(); }) == n);
  CHECK(pgdr::with_threads(0, [] { return pgdr::thread_count(); }) == outside);
  CHECK(pgdr::with_threads(3, [] { return pgdr::with_threads(0, [] { return pgdr::thread_count(); }); }) == 3);
  CHECK(pgdr::with_threads(3, [] { return pgdr::with_threads(2, [] { return pgdr::thread_count(); }); }) == 2);
  bool called = false;
  pgdr::with_threads(2, [&called] { called = true; });
  CHECK(called);
  CHECK_THROWS_AS(pgdr::with_threads(2, []() -> int { throw std::out_of_range("as it should"); }), std::out_of_range);
  CHECK(pgdr::thread_count() == outside);
}

TEST_CASE("more threads than cores really run", "[parallel]") {
  const unsigned n = std::thread::hardware_concurrency() + 3;
  std::mutex mutex;
  std::set<std::thread::id> seen;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  pgdr::with_threads(n, [&] {
    pgdr::parallel_for(0, n, [&](std::size_t) {
      for (bool waiting = true; waiting && std::chrono::steady_clock::now() < deadline; std::this_thread::yield()) {
        const std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
        waiting = seen.size() < n;
      }
    });
  });
  CHECK(seen.size() == n);
}

TEST_CASE("parallel loops visit every item once, in chunks that are the same for every number of threads",
          "[parallel]") {
  for (const unsigned threads : pgdr_test::thread_counts())
    for (const std::size_t n : sizes) {
      INFO(threads << " threads, " << n << " items");
      std::vector<int> visits(n), starts(n);
      pgdr::with_threads(threads, [&] {
        pgdr::parallel_for(0, n, [&](std::size_t i) { ++visits[i]; });
        pgdr::parallel_for_chunks(n, 10, [&](std::size_t first, std::size_t last) {
          ++starts[first];
          for (std::size_t i = first; i < last; ++i) ++visits[i];
        });
      });
      CHECK(visits == std::vector<int>(n, 2));
      for (std::size_t i = 0; i < n; ++i) REQUIRE(starts[i] == (i % 10 == 0));
    }
  pgdr::parallel_for(5, 5, [](std::size_t) { FAIL("an empty range has no items"); });
  CHECK_THROWS_AS(pgdr::parallel_for(0, 100, [](std::size_t i) { if (i == 57) throw std::out_of_range(""); }),
                  std::out_of_range);
}

TEST_CASE("parallel sums are the same, bit for bit, for every number of threads", "[parallel]") {
  std::mt19937_64 random(1);
  std::vector<double> terms(100'001);
  for (double& t : terms) t = std::ldexp(double(random()), int(random() % 60) - 120) - 0.1;
  const auto sum = [&terms](std::size_t n) {
    return pgdr::parallel_reduce(
        n, 100, 1.0,
        [&](std::size_t first, std::size_t last) {
          double part = 0;
          for (std::size_t i = first; i < last; ++i) part += terms[i];
          return part;
        },
        [](double& all, double part) { all += part; });
  };
  CHECK(sum(0) == 1);
  CHECK(sum(1) == 1 + terms[0]);
  const double one = pgdr::with_threads(1, [&] { return sum(terms.size()); });
  for (const unsigned threads : pgdr_test::thread_counts())
    CHECK(pgdr::with_threads(threads, [&] { return sum(terms.size()); }) == one);

  for (const unsigned threads : pgdr_test::thread_counts())
    for (const std::size_t n : sizes) {
      const auto multiples = pgdr::with_threads(threads, [n] {
        return pgdr::parallel_collect(n, 10, [](std::size_t first, std::size_t last) {
          std::vector<std::size_t> found;
          for (std::size_t i = first; i < last; ++i)
            if (i % 7 == 0) found.push_back(i);
          return found;
        });
      });
      REQUIRE(multiples.size() == (n + 6) / 7);
      for (std::size_t i = 0; i < multiples.size(); ++i) REQUIRE(multiples[i] == 7 * i);
    }
}

TEST_CASE("parallel_sort sorts", "[parallel]") {
  std::mt19937_64 random(2);
  for (const std::size_t n : {0, 1, 2, 1000, 100'000}) {
    std::vector<std::uint64_t> numbers(n);
    for (auto& x : numbers) x = random();
    auto expected = numbers;
    std::sort(expected.begin(), expected.end(), std::greater<>());
    pgdr::with_threads(3, [&] { pgdr::parallel_sort(numbers.begin(), numbers.end(), std::greater<>()); });
    CHECK(numbers == expected);
  }
}

TEST_CASE("parallel_walk hands out a list in chunks and returns their values in order", "[parallel]") {
  for (const unsigned threads : pgdr_test::thread_counts())
    for (const std::size_t n : sizes) {
      std::forward_list<std::size_t> list;
      for (std::size_t i = n; i > 0; --i) list.push_front(i - 1);
      std::vector<int> visits(n);
      const auto values = pgdr::with_threads(threads, [&] {
        return pgdr::parallel_walk(list.begin(), list.end(), 10, [&](std::size_t position, auto it, std::size_t count) {
          for (std::size_t i = 0; i < count; ++i, ++it) {
            if (*it == position + i) ++visits[*it];
          }
          return std::pair(position, count);
        });
      });
      CHECK(visits == std::vector<int>(n, 1));
      REQUIRE(values.size() == (n + 9) / 10);
      std::size_t position = 0;
      for (const auto& value : values) {
        REQUIRE(value == std::pair(position, std::min<std::size_t>(10, n - position)));
        position += 10;
      }
    }
}

TEST_CASE("parallel_in_order uses the products in order, of which there are few", "[parallel]") {
  struct Product {
    Product() = default;
    Product(const Product&) = delete;
    std::string text;
  };
  for (const unsigned threads : pgdr_test::thread_counts())
    for (const std::size_t n : sizes) {
      std::string all, expected;
      std::set<const Product*> products;
      for (std::size_t i = 0; i < n; ++i) expected += std::to_string(i) + " ";
      pgdr::with_threads(threads, [&] {
        pgdr::parallel_in_order<Product>(
            n, [](std::size_t i, Product& product) { product.text = std::to_string(i) + " "; },
            [&](std::size_t, const Product& product) {
              all += product.text;
              products.insert(&product);
            });
      });
      CHECK(all == expected);
      CHECK(products.size() <= 3 * threads);
    }
}

TEST_CASE("an exception ends parallel_in_order before anything more is used", "[parallel]") {
  for (const unsigned threads : pgdr_test::thread_counts()) {
    std::size_t used = 0;
    const auto run = [&](std::size_t bad_product, std::size_t bad_use) {
      used = 0;
      pgdr::with_threads(threads, [&] {
        pgdr::parallel_in_order<int>(
            1000, [&](std::size_t i, int&) { if (i == bad_product) throw std::out_of_range("made"); },
            [&](std::size_t i, int) {
              if (i == bad_use) throw std::length_error("used");
              ++used;
            });
      });
    };
    CHECK_THROWS_AS(run(500, 1000), std::out_of_range);
    CHECK(used <= 500);
    CHECK_THROWS_AS(run(1000, 500), std::length_error);
    CHECK(used == 500);
  }
}
