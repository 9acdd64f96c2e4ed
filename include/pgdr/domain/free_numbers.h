// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_FREE_NUMBERS_H
#define PGDR_DOMAIN_FREE_NUMBERS_H

namespace pgdr {

/// Hands out the numbers from 1 on that `taken`, a set or map of integers, does not hold; each once, in ascending order.
template <class Taken>
class Free_numbers {
 public:
  explicit Free_numbers(const Taken& taken, int first = 1) : taken_(taken), last_(first - 1) {}

  int next() {
    do ++last_;
    while (taken_.contains(last_));
    return last_;
  }

 private:
  const Taken& taken_;
  int last_;
};

}  // namespace pgdr

#endif
