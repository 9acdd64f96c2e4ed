// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARALLEL_PARALLEL_IN_ORDER_H
#define PGDR_PARALLEL_PARALLEL_IN_ORDER_H

#include <cstddef>
#include <vector>

#include <pgdr/parallel/parallel_pipeline.h>

namespace pgdr {

/// Makes the products of 0, 1, ..., n - 1 at once, on all threads of the caller's arena, and uses them one after the
/// other in that order: make(i, product) overwrites an old product, use(i, product) is never called twice at a time.
///
/// There are at most three products for each thread, whatever n is; each is default-constructed and used again and
/// again, so that its memory is. After an exception nothing more is used; it passes through.
template <class Product, class Make, class Use>
void parallel_in_order(std::size_t n, const Make& make, const Use& use) {
  struct Item {
    std::size_t index = 0;
    Product product{};
  };
  // They are finished in order: item i may take what i - size left.
  std::vector<Item> items(3 * std::size_t{thread_count()});
  std::size_t next = 0;
  const auto begin = [&]() -> void* {
    if (next == n) return nullptr;
    Item& item = items[next % items.size()];
    item.index = next++;
    return &item;
  };
  const auto work = [&make](void* at) {
    Item& item = *static_cast<Item*>(at);
    make(item.index, item.product);
  };
  const auto finish = [&use](void* at) {
    Item& item = *static_cast<Item*>(at);
    use(item.index, item.product);
  };
  parallel_pipeline(items.size(), begin, work, finish);
}

}  // namespace pgdr

#endif
