// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_EXACT_FUNCTIONS_H
#define PGDR_DOMAIN_EXACT_FUNCTIONS_H

#include <array>
#include <cmath>
#include <numbers>

namespace pgdr {

// The C library's transcendental functions differ in the last bits from version to version and from processor to processor. Where a mesh depends
// on one, it is made of sums, products, quotients and square roots, which IEEE 754 defines to the bit.

/// The largest power of two that is at most x. \pre x is positive and finite
inline double floor_power_of_two(double x) { return std::ldexp(1.0, std::ilogb(x)); }

/// The largest power of two whose cube is at most x > 0.
inline double floor_cube_root(double x) {
  double r = floor_power_of_two(std::cbrt(x));  // cube roots differ between C libraries
  while (r * r * r > x) r /= 2;
  while (8 * r * r * r <= x) r *= 2;
  return r;
}

/// The smallest power of two that is at least x. \pre x is positive and finite
inline double ceil_power_of_two(double x) {
  const double below = floor_power_of_two(x);
  return below == x ? below : 2 * below;
}

/// The angle of the direction (x, y) to the first axis, from -pi to pi; `std::atan2` but for the last two bits or so, which are the same
/// everywhere. 0 for (0, 0).
inline double arc_tangent(double y, double x) {
  const double ax = std::abs(x), ay = std::abs(y);
  if (ax == 0 && ay == 0) return 0;
  const bool is_steep = ay > ax;
  double t = is_steep ? ax / ay : ay / ax;
  for (int halving = 0; halving < 3; ++halving) t /= 1 + std::sqrt(1 + t * t);
  // At 5.6 degrees and less, the next term of the series is below 1e-19 of the first.
  const double s = t * t;
  double sum = 0;
  for (int k = 17; k > 1; k -= 2) sum = s * (1.0 / k - sum);
  double angle = 8 * (t - t * sum);
  if (is_steep) angle = std::numbers::pi / 2 - angle;
  if (x < 0) angle = std::numbers::pi - angle;
  return y < 0 ? -angle : angle;
}

/// `std::cos` of an angle of 0 to 180 degrees, but for the last three bits or so.
inline double cosine_of_degrees(double degrees) {
  const double x = degrees * (std::numbers::pi / 180) / 8;
  // At 22.5 degrees and less, the next term of the series is below 1e-18.
  const double s = x * x;
  double c = 0;
  for (int k = 14; k > 0; k -= 2) c = s / (k * (k - 1)) * (1 - c);
  // 1 - cos(x), doubled: of small angles nothing is lost.
  for (int doubling = 0; doubling < 3; ++doubling) c = 2 * c * (2 - c);
  return 1 - c;
}

/// Radians in degrees; from one degree on rounded to 2^-40 of one, so that angles that are meant to be 60 or 90 degrees are.
inline double to_degrees(double radians) {
  const double degrees = radians * (180 / std::numbers::pi);
  return std::abs(degrees) < 1 ? degrees : std::ldexp(std::nearbyint(std::ldexp(degrees, 40)), -40);
}

}  // namespace pgdr

#endif
