// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARALLEL_PARALLEL_IN_ORDER_H
#define PGDR_PARALLEL_PARALLEL_IN_ORDER_H

#include <cstddef>
#include <vector>

#ifdef CGAL_LINKED_WITH_TBB
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace pgdr {

/// Makes the products of 0, 1, ..., n - 1 at once, on all threads of the caller's arena, and uses them one after the
/// other in that order: make(i, product) overwrites an old product, use(i, product) is never called twice at a time.
///
/// There are at most three products for each thread, whatever n is; each is default-constructed and used again and
/// again, so that its memory is. After an exception nothing more is used; it passes through.
template <class Product, class Make, class Use>
void parallel_in_order(std::size_t n, const Make& make, const Use& use) {
#ifdef CGAL_LINKED_WITH_TBB
  namespace tbb = oneapi::tbb;
  struct Item {
    std::size_t index = 0;
    Product* product = nullptr;
  };
  // At most `tokens` items are under way, and they are finished in order: item i may take what i - tokens left.
  const auto tokens = 3 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  std::vector<Product> products(tokens);
  std::size_t next = 0;
  const auto begin = [&](tbb::flow_control& control) -> Item {
    if (next == n) {
      control.stop();
      return {};
    }
    const Item item{next, &products[next % tokens]};
    ++next;
    return item;
  };
  const auto work = [&make](const Item& item) {
    make(item.index, *item.product);
    return item;
  };
  const auto finish = [&use](const Item& item) { use(item.index, *item.product); };
  tbb::parallel_pipeline(tokens, tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, begin) &
                                     tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, work) &
                                     tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order, finish));
#else
  Product product;
  for (std::size_t k = 0; k < n; ++k) {
    make(k, product);
    use(k, product);
  }
#endif
}

}  // namespace pgdr

#endif
