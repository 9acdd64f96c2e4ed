// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as a small PLC, meshed with at most 2,000 vertices on two threads and checked. What is valid is meshed, or a limit says why not.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include <pgdr/domain/input_error.h>
#include <pgdr/domain/scale.h>
#include <pgdr/quality/check_mesh.h>
#include <pgdr/refine_mesh_3.h>

namespace {

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

void add_box(pgdr::Plc& plc, const pgdr::Default_kernel::Point_3& p, const pgdr::Default_kernel::Point_3& q) {
  const auto first = static_cast<pgdr::Index>(plc.vertices.size());
  for (unsigned i = 0; i < 8; ++i) plc.vertices.emplace_back((i & 1u ? p : q).x(), (i & 2u ? p : q).y(), (i & 4u ? p : q).z());
  for (const auto& f : {std::array<pgdr::Index, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}) {
    pgdr::Plc_facet<pgdr::Default_kernel> facet;
    facet.polygons.push_back({first + f[0], first + f[1], first + f[2], first + f[3]});
    plc.facets.push_back(facet);
  }
}

pgdr::Plc plc_of(Bytes& bytes) {
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  pgdr::Parameters parameters;
  parameters.max_vertices = 2000;
  parameters.threads = 2;
  parameters.time_limit = 1;  // a box of 1 by 2^40 is all exact arithmetic: slow, but it stops when it is told to
  parameters.verify = true;
  parameters.triangulate_facets = bytes.byte() & 1u;
  const unsigned size_code = bytes.byte();
  pgdr::Plc plc = plc_of(bytes);
  const double radius = size_code & 3u ? std::numeric_limits<double>::infinity() : 0.5 + size_code / 16.0;
  try {
    const auto mesh = pgdr::refine_mesh_3(plc, pgdr::Uniform_sizing_field(radius), parameters);
    const auto indexed = pgdr::indexed_mesh_3(mesh);
    const bool is_done = mesh.statistics().stop == pgdr::Stop_reason::finished;
    if (is_done && mesh.statistics().unrecovered > 0) std::abort();
    if (!is_done || indexed.tetrahedra.empty()) return 0;
    for (const auto& line : pgdr::check_mesh(indexed, &mesh.domain()))
      if (!line.passed) {
        std::fprintf(stderr, "%s: %s\n", line.property.c_str(), line.detail.c_str());
        std::abort();
      }
  } catch (const pgdr::Input_error&) {
  }
  return 0;
}
