// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay/wave_graph.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

namespace pgdr::bench {

namespace {

/// Numbers of tasks by the key of their leaf: open addressing, half full at most.
class Leaf_table {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  explicit Leaf_table(std::size_t size) : slots_(std::bit_ceil(2 * size + 2)) {}

  /// False if the leaf is there already.
  bool insert(const Octree_key& leaf, std::uint32_t task) {
    Slot& slot = slots_[slot_of(code(leaf))];
    if (slot.code != 0) return false;
    slot = {code(leaf), task};
    return true;
  }
  std::uint32_t find(const Octree_key& leaf) const {
    const Slot& slot = slots_[slot_of(code(leaf))];
    return slot.code == 0 ? none : slot.task;
  }

 private:
  struct Slot {
    std::uint64_t code = 0;
    std::uint32_t task = none;
  };

  /// The Morton code at the leaf's own level below a leading one: different for all nodes, never 0.
  static std::uint64_t code(const Octree_key& leaf) {
    const int shift = 3 * (Octree_key::max_level - leaf.level);
    return leaf.morton() >> shift | std::uint64_t{1} << 3 * leaf.level;
  }
  /// Where the code is, or where it would have to go.
  std::size_t slot_of(std::uint64_t code) const {
    // Fibonacci hashing: the upper bits of the product are well mixed.
    std::size_t i = code * 0x9e3779b97f4a7c15ULL >> 20 & (slots_.size() - 1);
    while (slots_[i].code != 0 && slots_[i].code != code) i = (i + 1) & (slots_.size() - 1);
    return i;
  }

  std::vector<Slot> slots_;
};

/// Calls `visit(key)` for every node of `level`, at most that of `leaf`, whose closed cube meets that of `leaf`.
template <class Visit>
void for_each_touching_node(const Octree_key& leaf, int level, Visit visit) {
  const int up = leaf.level - level;
  const std::array<std::int64_t, 3> at = {leaf.x, leaf.y, leaf.z};
  const std::int64_t end = std::int64_t{1} << level;
  std::array<std::int64_t, 3> low{}, high{};
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::max<std::int64_t>(0, (at[i] - 1) >> up);  // the node that holds the unit cube just below
    high[i] = std::min(end - 1, (at[i] + 1) >> up);
  }
  for (std::int64_t z = low[2]; z <= high[2]; ++z)
    for (std::int64_t y = low[1]; y <= high[1]; ++y)
      for (std::int64_t x = low[0]; x <= high[0]; ++x)
        visit(Octree_key{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                         static_cast<std::uint32_t>(z), static_cast<std::uint8_t>(level)});
}

std::string name_of(const Octree_key& leaf) {
  return "level " + std::to_string(leaf.level) + " (" + std::to_string(leaf.x) + ", " +
         std::to_string(leaf.y) + ", " + std::to_string(leaf.z) + ")";
}

Wave_graph make_graph_without_edges(std::span<const Leaf_task> tasks) {
  Wave_graph graph;
  for (const Leaf_task& task : tasks) graph.seconds.push_back(task.seconds);
  graph.predecessors.assign(tasks.size(), 0);
  graph.first.assign(tasks.size() + 1, 0);
  return graph;
}

}  // namespace

Wave_graph make_wave_graph(std::span<const Leaf_task> tasks) {
  if (std::ranges::any_of(tasks, &Leaf_task::is_part)) return make_graph_without_edges(tasks);
  std::vector<std::uint32_t> order(tasks.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto rank = [&](std::uint32_t i) {
    const Octree_key& leaf = tasks[i].key;
    return std::tuple(leaf.level, leaf.parity(), leaf.morton());
  };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return rank(a) < rank(b); });

  Leaf_table table(tasks.size());
  std::array<bool, Octree_key::max_level + 1> levels{};
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const Leaf_task& task = tasks[order[i]];
    if (!table.insert(task.key, i))
      throw Trace_error("epoch " + std::to_string(task.epoch) + ", wave " + std::to_string(task.wave) +
                        ": leaf " + name_of(task.key) + " ran twice");
    levels[task.key.level] = true;
  }

  // Each pair is found once, from its later task, which has the smaller leaf or a leaf of the same size.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const Octree_key& leaf = tasks[order[i]].key;
    for (int level = 0; level <= leaf.level; ++level) {
      if (!levels[static_cast<std::size_t>(level)]) continue;
      for_each_touching_node(leaf, level, [&](const Octree_key& node) {
        const std::uint32_t other = table.find(node);
        if (other == Leaf_table::none || other >= i) return;
        if (contains(node, leaf))
          throw Trace_error("epoch " + std::to_string(tasks[order[i]].epoch) + ", wave " +
                            std::to_string(tasks[order[i]].wave) + ": leaf " + name_of(node) +
                            " contains leaf " + name_of(leaf));
        edges.emplace_back(other, i);
      });
    }
  }

  Wave_graph graph;
  graph.predecessors.assign(order.size(), 0);
  graph.first.assign(order.size() + 1, 0);
  graph.successors.resize(edges.size());
  for (std::uint32_t i : order) graph.seconds.push_back(tasks[i].seconds);
  for (const auto& [from, to] : edges) {
    ++graph.first[from + 1];
    ++graph.predecessors[to];
  }
  std::partial_sum(graph.first.begin(), graph.first.end(), graph.first.begin());
  std::vector<std::uint32_t> next(graph.first.begin(), graph.first.end() - 1);
  for (const auto& [from, to] : edges) graph.successors[next[from]++] = to;
  return graph;
}

}  // namespace pgdr::bench
