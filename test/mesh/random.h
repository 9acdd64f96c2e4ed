// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_MESH_RANDOM_H
#define PGDR_TEST_MESH_RANDOM_H

#include <cstdint>
#include <random>

#include <pgdr/domain/vec_3.h>

namespace pgdr_test {

/// Random numbers that are the same on every machine, unlike the distributions of the standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  /// From 0 up to, but not including, n.
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }

 private:
  std::mt19937_64 engine_;
};

inline pgdr::Vec_3 in_cube(Random& random, double half) {
  const double x = random.between(-half, half), y = random.between(-half, half), z = random.between(-half, half);
  return {x, y, z};
}

}  // namespace pgdr_test

#endif
