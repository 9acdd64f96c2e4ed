// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_QUALITY_COMPENSATED_SUM_H
#define PGDR_QUALITY_COMPENSATED_SUM_H

#include <cmath>

namespace pgdr {

/// A running sum of doubles whose rounding error does not grow with the number of terms (Neumaier 1974).
/// Not for use under -ffast-math.
class Compensated_sum {
 public:
  Compensated_sum& operator+=(double x) {
    const double s = sum_ + x;
    lost_ += std::abs(sum_) >= std::abs(x) ? (sum_ - s) + x : (x - s) + sum_;
    sum_ = s;
    return *this;
  }
  /// The sum; plus or minus infinity or NaN when the terms make it so.
  double value() const { return std::isfinite(sum_) ? sum_ + lost_ : sum_; }

 private:
  double sum_ = 0;
  double lost_ = 0;
};

}  // namespace pgdr

#endif
