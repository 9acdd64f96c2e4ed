// SPDX-License-Identifier: GPL-3.0-or-later
// Random PLCs without acute angles.
#ifndef PGDR_TEST_PROPERTY_RANDOM_BOXES_H
#define PGDR_TEST_PROPERTY_RANDOM_BOXES_H

#include <array>
#include <cmath>
#include <numbers>

#include "domain/shapes.h"
#include "refinement/refined.h"

namespace pgdr_test {

/// Boxes side by side on full common faces, with boxes inside them that are holes, regions or shells.
class Random_boxes {
 public:
  explicit Random_boxes(std::uint64_t seed) : random_(seed) {}

  Plc make() {
    const std::uint32_t blocks = 1 + random_.below(3);
    std::array<double, 3> upper{random_.between(1, 3), random_.between(1, 3), 0};
    for (std::uint32_t k = 0; k <= blocks; ++k) {
      for (const auto& [x, y] :
           {std::array<double, 2>{0, 0}, {upper[0], 0}, {upper[0], upper[1]}, {0, upper[1]}})
        plc_.vertices.emplace_back(x, y, upper[2]);
      const Index top = 4 * k;
      plc_.facets.push_back({{{top, top + 1, top + 2, top + 3}}, {}, marker()});
      if (k == blocks) break;
      for (Index i = 0; i < 4; ++i) {
        const Index j = (i + 1) % 4;
        plc_.facets.push_back({{{top + i, top + j, top + 4 + j, top + 4 + i}}, {}, marker()});
      }
      heights_.push_back(upper[2]);
      upper[2] += random_.between(0.8, 2.5);
      heights_.push_back(upper[2]);
    }
    for (std::uint32_t k = 0; k < blocks; ++k)
      fill({0, 0, heights_[2 * k]}, {upper[0], upper[1], heights_[2 * k + 1]}, 0);
    return plc_;
  }

 private:
  int marker() { return static_cast<int>(random_.below(4)); }

  /// Halves the box in some directions and puts a box into some of the parts.
  void fill(const std::array<double, 3>& lower, const std::array<double, 3>& upper, int depth) {
    std::array<std::uint32_t, 3> parts;
    for (auto& n : parts) n = depth == 0 ? 1 + random_.below(2) : 1;
    for (std::uint32_t i = 0; i < parts[0]; ++i)
      for (std::uint32_t j = 0; j < parts[1]; ++j)
        for (std::uint32_t k = 0; k < parts[2]; ++k) {
          if (random_.below(3) == 0) continue;
          const std::array<std::uint32_t, 3> at{i, j, k};
          std::array<double, 3> a, b;
          for (std::size_t d = 0; d < 3; ++d) {
            const double width = (upper[d] - lower[d]) / parts[d], start = lower[d] + at[d] * width;
            a[d] = start + random_.between(0.1, 0.35) * width;
            b[d] = start + random_.between(0.6, 0.9) * width;
          }
          add_inner(a, b, depth);
        }
  }

  void add_inner(const std::array<double, 3>& a, const std::array<double, 3>& b, int depth) {
    add_box(plc_, a, b, marker());
    // Just inside the corner, where no deeper box reaches.
    std::array<double, 3> seed;
    for (std::size_t d = 0; d < 3; ++d) seed[d] = a[d] + 0.05 * (b[d] - a[d]);
    const std::uint32_t kind = random_.below(3);
    if (kind == 0) plc_.holes.emplace_back(seed[0], seed[1], seed[2]);
    if (kind == 1)
      plc_.regions.push_back({{seed[0], seed[1], seed[2]}, static_cast<int>(random_.below(20)), 0});
    if (depth == 0 && random_.below(3) == 0) fill(a, b, 1);
  }

  Random random_;
  Plc plc_;
  std::vector<double> heights_;
};

/// Rotates at random, moves by up to 1e5 and scales by 1e-6 to 1e9; the scale comes back in `scale`.
inline Plc moved_at_random(Plc plc, std::uint64_t seed, double& scale) {
  Random random(seed);
  std::array<double, 4> q;
  double norm;
  do {
    norm = 0;
    for (double& x : q) {
      x = random.between(-1, 1);
      norm += x * x;
    }
  } while (norm > 1 || norm < 0.01);
  for (double& x : q) x /= std::sqrt(norm);
  const auto [w, x, y, z] = q;
  const bool rotate = random.below(4) != 0, move = random.below(2) != 0;
  const double m[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                          {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                          {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
  double offset[3];
  for (double& o : offset) o = move ? random.between(-1e5, 1e5) : 0;
  scale = std::pow(10.0, random.between(-6, 9));
  const auto apply = [&](const auto& p) {
    const double in[3] = {p.x(), p.y(), p.z()};
    double out[3];
    for (int i = 0; i < 3; ++i) {
      out[i] = rotate ? m[i][0] * in[0] + m[i][1] * in[1] + m[i][2] * in[2] : in[i];
      out[i] = scale * (out[i] + offset[i]);
    }
    return pgdr::Default_kernel::Point_3(out[0], out[1], out[2]);
  };
  for (auto& p : plc.vertices) p = apply(p);
  for (auto& p : plc.holes) p = apply(p);
  for (auto& r : plc.regions) r.point = apply(r.point);
  return plc;
}

}  // namespace pgdr_test

#endif
