// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as a small PLC: boxes, loose vertices, polygons, segments and seeds on a coarse grid.
#ifndef PGDR_FUZZ_PLC_OF_BYTES_H
#define PGDR_FUZZ_PLC_OF_BYTES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pgdr/domain/default_kernel.h>

namespace pgdr_fuzz {

/// Takes numbers off the front of the bytes; zeros when there are none left.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}
  bool empty() const { return next_ == end_; }
  unsigned byte() { return empty() ? 0 : *next_++; }
  /// On a coarse grid mostly, so that features meet and coincide; with a small offset or another order of magnitude now and then.
  double coordinate() {
    const unsigned b = byte();
    double x = static_cast<double>(b & 15u);
    if ((b & 0xf0u) == 0xf0u) x += std::ldexp(static_cast<double>(byte()), -static_cast<int>(byte() % 60u));
    if ((b & 0xf0u) == 0xe0u) x = std::ldexp(x, static_cast<int>(byte() % 41u) - 20);
    return (b & 0xf0u) == 0xd0u ? -x : x;
  }
  pgdr::Default_kernel::Point_3 point() {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
  }

 private:
  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

inline void add_box(pgdr::Plc& plc, const pgdr::Default_kernel::Point_3& p, const pgdr::Default_kernel::Point_3& q) {
  const auto first = static_cast<pgdr::Index>(plc.vertices.size());
  for (unsigned i = 0; i < 8; ++i) plc.vertices.emplace_back((i & 1u ? p : q).x(), (i & 2u ? p : q).y(), (i & 4u ? p : q).z());
  for (const auto& f : {std::array<pgdr::Index, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}) {
    pgdr::Plc_facet<pgdr::Default_kernel> facet;
    facet.polygons.push_back({first + f[0], first + f[1], first + f[2], first + f[3]});
    plc.facets.push_back(facet);
  }
}

inline pgdr::Plc plc_of(Bytes& bytes) {
  pgdr::Plc plc;
  if (bytes.byte() & 1u) plc.nesting = pgdr::Nesting::alternate;
  for (unsigned boxes = bytes.byte() % 4u; boxes > 0; --boxes) {
    const auto p = bytes.point(), q = bytes.point();
    add_box(plc, p, q);
  }
  for (unsigned n = bytes.byte() % 12u; n > 0; --n) plc.vertices.push_back(bytes.point());
  const auto vertex = [&] { return static_cast<pgdr::Index>(bytes.byte() % std::max<std::size_t>(plc.vertices.size(), 1)); };
  for (unsigned n = bytes.byte() % 12u; n > 0; --n) {
    pgdr::Plc_facet<pgdr::Default_kernel> facet;
    facet.marker = static_cast<int>(bytes.byte() % 3u);
    for (unsigned polygons = 1 + bytes.byte() % 5u / 4u; polygons > 0; --polygons) {
      std::vector<pgdr::Index>& polygon = facet.polygons.emplace_back();
      for (unsigned corners = 1 + bytes.byte() % 5u; corners > 0; --corners) polygon.push_back(vertex());
    }
    plc.facets.push_back(facet);
  }
  for (unsigned n = bytes.byte() % 3u; n > 0; --n) plc.segments.push_back({vertex(), vertex(), static_cast<int>(n)});
  for (unsigned n = bytes.byte() % 3u; n > 0; --n) plc.holes.push_back(bytes.point());
  for (unsigned n = bytes.byte() % 3u; n > 0; --n) plc.regions.push_back({bytes.point(), static_cast<int>(n), 0, 0});
  return plc;
}

}  // namespace pgdr_fuzz

#endif
