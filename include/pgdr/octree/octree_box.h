// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_OCTREE_OCTREE_BOX_H
#define PGDR_OCTREE_OCTREE_BOX_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include <pgdr/octree/octree_key.h>

namespace pgdr {

/// The root cube of an octree, with bounds that are exact.
///
/// The edge E is a power of two, the lower corner a multiple of E * 2^-20 (20 is `Octree_key::max_level`), and no
/// coordinate of the cube exceeds 2^29 * E in magnitude. Hence every bound of every node is a double without
/// rounding, and so is every bound moved by a multiple of 1/8 of a node's edge: a multiple of E * 2^-23 that is at
/// most 2^52 of them needs 53 bits. Two leaves that share a face agree on its coordinate bit for bit.
class Octree_box {
 public:
  /// The smallest such cube that contains the closed box from `lower` to `upper`; its lower corner is as close to
  /// `lower` as the grid of E * 2^-20 allows. The unit cube is its own root. A box that is tiny and far from the
  /// origin gets a larger root, of at least 2^-28 times its distance.
  /// Throws `std::invalid_argument` if the box is empty or a coordinate NaN or above 2^1000 in magnitude.
  static Octree_box around(const std::array<double, 3>& lower, const std::array<double, 3>& upper) {
    double extent = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(lower[axis] <= upper[axis])) throw std::invalid_argument("the box of the octree is empty");
      if (!(std::fabs(lower[axis]) <= 0x1p1000 && std::fabs(upper[axis]) <= 0x1p1000)) {
        throw std::invalid_argument("a coordinate is too large for an octree");
      }
      extent = std::max(extent, upper[axis] - lower[axis]);
    }
    // One power of two below the extent: the rounded difference may be one too large.
    int exponent = extent > 0 ? std::max(smallest_exponent, std::ilogb(extent) - 1) : smallest_exponent;
    for (;; ++exponent) {
      Octree_box box;
      box.edge_ = std::ldexp(1.0, exponent);
      if (box.place(lower, upper)) return box;
    }
  }

  double edge() const { return edge_; }

  /// The edge of the nodes of a level, 0 to 20.
  double edge(int level) const { return std::ldexp(edge_, -level); }

  const std::array<double, 3>& lower() const { return lower_; }

  std::array<double, 3> upper() const { return {lower_[0] + edge_, lower_[1] + edge_, lower_[2] + edge_}; }

  std::array<double, 3> lower(const Octree_key& key) const {
    return {bound(0, key.lower_units(0)), bound(1, key.lower_units(1)), bound(2, key.lower_units(2))};
  }

  std::array<double, 3> upper(const Octree_key& key) const {
    const std::uint32_t edge = key.edge_units();
    return {bound(0, key.lower_units(0) + edge), bound(1, key.lower_units(1) + edge),
            bound(2, key.lower_units(2) + edge)};
  }

  /// The node of level 20 whose half-open cube contains `p`; a point outside the root is moved to the nearest node.
  /// Exact: p is compared with the bounds themselves. NaN counts as the lower bound.
  Octree_key locate(const std::array<double, 3>& p) const {
    return {locate(0, p[0]), locate(1, p[1]), locate(2, p[2]),
            static_cast<std::uint8_t>(Octree_key::max_level)};
  }

  friend bool operator==(const Octree_box& a, const Octree_box& b) {
    return a.edge_ == b.edge_ && a.lower_ == b.lower_;
  }

 private:
  static constexpr int smallest_exponent = -990;  // far above the subnormal numbers, also after 23 halvings
  static constexpr std::uint32_t units = std::uint32_t{1} << Octree_key::max_level;

  Octree_box() = default;

  /// Puts the lower corner; false if the cube is too small for the box or too far out for exact bounds.
  bool place(const std::array<double, 3>& lower, const std::array<double, 3>& upper) {
    const double unit = edge(Octree_key::max_level);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double largest = std::max(std::fabs(lower[axis]), std::fabs(upper[axis]));
      if (largest > 0x1p28 * edge_) return false;  // one bit is left for the cube beyond the box
      double corner = std::floor(lower[axis] / unit) * unit;
      if (corner > lower[axis]) corner -= unit;  // the quotient was below the smallest double
      if (!(upper[axis] <= corner + edge_)) return false;
      lower_[axis] = corner + 0.0;  // no negative zero
    }
    return true;
  }

  double bound(std::size_t axis, std::uint32_t position) const {
    return lower_[axis] + static_cast<double>(position) * edge(Octree_key::max_level);
  }

  std::uint32_t locate(std::size_t axis, double c) const {
    if (!(c > lower_[axis])) return 0;
    if (c >= lower_[axis] + edge_) return units - 1;
    // The difference rounds, by less than one unit: settle by the exact bounds.
    auto position = static_cast<std::uint32_t>(
        std::min((c - lower_[axis]) / edge(Octree_key::max_level), static_cast<double>(units - 1)));
    if (c < bound(axis, position)) {
      --position;
    } else if (c >= bound(axis, position + 1)) {
      ++position;
    }
    return position;
  }

  double edge_ = 1;
  std::array<double, 3> lower_{};
};

}  // namespace pgdr

#endif
