// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay/wave_graph.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "catch.h"
#include "traces.h"

using namespace pgdr::bench;
using namespace pgdr_test;

namespace {

std::size_t edge_count(const std::vector<Leaf_task>& tasks) {
  return make_wave_graph(tasks).successors.size();
}

}  // namespace

TEST_CASE("leaves that touch in a face, an edge or a corner are joined, others are not") {
  CHECK(edge_count({task(node(2, 0, 0, 0), 1), task(node(2, 1, 0, 0), 1)}) == 1);
  CHECK(edge_count({task(node(2, 0, 0, 0), 1), task(node(2, 1, 1, 0), 1)}) == 1);
  CHECK(edge_count({task(node(2, 0, 0, 0), 1), task(node(2, 1, 1, 1), 1)}) == 1);
  CHECK(edge_count({task(node(2, 0, 0, 0), 1), task(node(2, 2, 0, 0), 1)}) == 0);
  CHECK(edge_count({task(node(2, 3, 0, 0), 1), task(node(2, 0, 1, 0), 1)}) == 0);  // no wrap around
  CHECK(edge_count({task(node(1, 0, 0, 0), 1), task(node(3, 4, 4, 4), 1)}) == 1);
  CHECK(edge_count({task(node(1, 0, 0, 0), 1), task(node(3, 4, 4, 5), 1)}) == 0);
}

TEST_CASE("the parts of one leaf run all at once") {
  std::vector<Leaf_task> tasks(3, task(node(0, 0, 0, 0), 1));
  tasks[1].seconds = 2;
  CHECK_THROWS_AS(make_wave_graph(tasks), Trace_error);
  for (Leaf_task& t : tasks) t.is_part = true;
  const Wave_graph graph = make_wave_graph(tasks);
  CHECK(graph.seconds == std::vector<double>{1, 2, 1});
  CHECK(graph.predecessors == std::vector<std::uint32_t>(3, 0));
  CHECK(graph.successors.empty());
  CHECK(graph.first == std::vector<std::uint32_t>(4, 0));
}

TEST_CASE("a full grid has as many pairs as a king in space has moves") {
  for (int level = 1; level <= 4; ++level) {
    const std::size_t n = std::size_t{1} << level;
    // (3n - 2)^3 ordered pairs at distance at most one on each axis, less the n^3 of a leaf with itself
    CHECK(edge_count(grid(level, 1)) == ((3 * n - 2) * (3 * n - 2) * (3 * n - 2) - n * n * n) / 2);
  }
}

TEST_CASE("the pairs are those of comparing all, directed from large to small, by parity, by Morton code") {
  std::size_t mixed = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::vector<Leaf_task> tasks = random_leaves(seed, 5);
    const auto rank = [](const Leaf_task& t) {
      return std::tuple(t.key.level, t.key.parity(), t.key.morton());
    };
    std::sort(tasks.begin(), tasks.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    std::set<std::pair<std::size_t, std::size_t>> expected;
    for (std::size_t i = 0; i < tasks.size(); ++i)
      for (std::size_t j = i + 1; j < tasks.size(); ++j)
        if (touch(tasks[i].key, tasks[j].key)) {
          expected.emplace(i, j);
          mixed += tasks[j].key.level > tasks[i].key.level + 1;
        }

    const Wave_graph graph = make_wave_graph(tasks);
    REQUIRE(graph.size() == tasks.size());
    std::set<std::pair<std::size_t, std::size_t>> found;
    std::vector<std::uint32_t> predecessors(tasks.size(), 0);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      CHECK(graph.seconds[i] == tasks[i].seconds);
      for (std::uint32_t k = graph.first[i]; k < graph.first[i + 1]; ++k) {
        found.emplace(i, graph.successors[k]);
        ++predecessors[graph.successors[k]];
      }
    }
    CHECK(found == expected);
    CHECK(graph.successors.size() == expected.size());  // none twice
    CHECK(predecessors == graph.predecessors);

    std::reverse(tasks.begin(), tasks.end());  // the order of the trace does not matter
    CHECK(make_wave_graph(tasks).successors == graph.successors);
  }
  CHECK(mixed > 1000);  // pairs two and more levels apart did occur
}

TEST_CASE("overlapping leaves in one wave are refused") {
  CHECK_THROWS_AS(edge_count({task(node(2, 1, 1, 1), 1), task(node(2, 1, 1, 1), 1)}), Trace_error);
  CHECK_THROWS_AS(edge_count({task(node(3, 2, 2, 3), 1), task(node(2, 1, 1, 1), 1)}), Trace_error);
}
