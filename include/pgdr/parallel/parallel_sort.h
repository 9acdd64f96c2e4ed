// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PARALLEL_PARALLEL_SORT_H
#define PGDR_PARALLEL_PARALLEL_SORT_H

#include <functional>

#ifdef CGAL_LINKED_WITH_TBB
#include <oneapi/tbb/parallel_sort.h>
#else
#include <algorithm>
#endif

namespace pgdr {

/// Sorts on all threads of the caller's arena. Not stable: `less` must leave no two items unordered unless they are
/// equal in every bit, or the result would depend on how the work was cut.
template <class Iterator, class Less = std::less<>>
void parallel_sort(Iterator first, Iterator last, const Less& less = {}) {
#ifdef CGAL_LINKED_WITH_TBB
  oneapi::tbb::parallel_sort(first, last, less);
#else
  std::sort(first, last, less);
#endif
}

}  // namespace pgdr

#endif
