// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_THREAD_COUNTS_H
#define PGDR_TEST_THREAD_COUNTS_H

#include <cstdlib>
#include <vector>

namespace pgdr_test {

/// Whether tests take the time that only `scripts/nightly` has.
inline bool is_nightly() {
  const char* set = std::getenv("PGDR_NIGHTLY");
  return set != nullptr && *set == '1';
}

/// Numbers of threads with which the same has to come out: one, as many as a small machine has, an odd number, and more than
/// there are cores.
inline const std::vector<unsigned>& thread_counts() {
  static const std::vector<unsigned> counts = is_nightly() ? std::vector<unsigned>{1, 2, 3, 4, 8, 16} : std::vector<unsigned>{1, 2, 3, 8};
  return counts;
}

}  // namespace pgdr_test

#endif
