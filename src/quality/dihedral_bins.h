// SPDX-License-Identifier: GPL-3.0-or-later
// Private to src/quality: the bins of the histogram of dihedral angles, found without an arc tangent.
#ifndef PGDR_SRC_QUALITY_DIHEDRAL_BINS_H
#define PGDR_SRC_QUALITY_DIHEDRAL_BINS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

#include <pgdr/quality/mesh_quality.h>

namespace pgdr::quality_detail {

/// Finds the bin of `Mesh_quality::dihedral_histogram` of an angle from its cosine.
///
/// [-1, 1] is cut into cells so small that each holds at most one boundary between bins, and of a number that keeps
/// every boundary a tenth of a cell away from its ends: only that one need be looked at.
class Dihedral_bins {
 public:
  static constexpr int unclear = -1;

  Dihedral_bins() {
    constexpr double radians = 0.017453292519943295769;
    for (auto& cell : cells_) cell.boundary = -std::numeric_limits<double>::infinity();
    for (std::size_t bin = 1; bin < bins; ++bin) {
      const double boundary = std::cos(radians * Mesh_quality::dihedral_bin_deg * double(bin));
      cells_[cell_of(boundary)].boundary = boundary;
    }
    int bin = int(bins) - 1;  // of 180 degrees, where the cosine is least
    for (auto& cell : cells_) {
      cell.below = bin;
      if (std::isfinite(cell.boundary)) --bin;
      cell.above = bin;
    }
  }

  /// The bin, or `unclear` where the cosine is within 1e-9 of a boundary's.
  int find(double cosine) const {
    const Cell& cell = cells_[cell_of(cosine)];
    if (std::abs(cosine - cell.boundary) < 1e-9) return unclear;
    return cosine > cell.boundary ? cell.above : cell.below;
  }

 private:
  struct Cell {
    double boundary;   ///< minus infinity: none
    int below, above;  ///< bins of smaller cosines and of larger ones
  };
  static constexpr std::size_t bins = std::tuple_size_v<decltype(Mesh_quality::dihedral_histogram)>;
  static constexpr std::size_t count = 227;

  static std::size_t cell_of(double cosine) {
    const double cell = (cosine + 1) * (count / 2.0);
    return cell < count ? std::size_t(std::max(cell, 0.0)) : count - 1;
  }

  std::array<Cell, count> cells_;
};

}  // namespace pgdr::quality_detail

#endif
