// SPDX-License-Identifier: GPL-3.0-or-later
#include "face_table.h"

#include <algorithm>
#include <tuple>

#include <pgdr/parallel/parallel_for.h>

namespace pgdr::quality_detail {

namespace {

// Faces opposite to vertex 0..3 of a positive tetrahedron, counterclockwise from outside.
constexpr std::array<std::array<std::size_t, 3>, 4> face_vertices{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

Face_table::Triangle sorted(Face_table::Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

}  // namespace

Face_table::Face_table(const Indexed_mesh_3& mesh) : mesh_(mesh), begin_(mesh.points.size() + 1, 0) {
  const auto for_each_half = [&mesh](auto f) {
    for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const auto& t = mesh.tetrahedra[i];
        const auto& k = face_vertices[j];
        f(sorted({t[k[0]], t[k[1]], t[k[2]]}), std::uint32_t(4 * i + j));
      }
  };
  for_each_half([this](const Triangle& t, std::uint32_t) { ++begin_[t[0] + 1]; });
  for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
  halves_.resize(4 * mesh.tetrahedra.size());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for_each_half([&](const Triangle& t, std::uint32_t half) { halves_[next[t[0]]++] = {t[1], t[2], half}; });
  const auto key = [](const Half_face& h) { return std::make_tuple(h.second, h.third, h.tetrahedron_face); };
  parallel_for_chunks(mesh.points.size(), default_grain / 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      std::sort(halves_.begin() + std::ptrdiff_t(begin_[v]), halves_.begin() + std::ptrdiff_t(begin_[v + 1]),
                [key](const Half_face& a, const Half_face& b) { return key(a) < key(b); });
  });
  listed_.resize(halves_.size());
  for (const auto& t : mesh.triangles) {
    const auto [first, n] = find(t);
    if (n > 0) listed_[first] = true;
  }
}

std::array<std::size_t, 2> Face_table::find(Triangle t) const {
  t = sorted(t);
  const auto key = std::make_pair(t[1], t[2]);
  const auto end = halves_.begin() + std::ptrdiff_t(begin_[t[0] + 1]);
  const auto it = std::lower_bound(
      halves_.begin() + std::ptrdiff_t(begin_[t[0]]), end, key,
      [](const Half_face& h, const auto& k) { return std::make_pair(h.second, h.third) < k; });
  if (it == end || std::make_pair(it->second, it->third) != key) return {0, 0};
  const std::size_t i = std::size_t(it - halves_.begin());
  return {i, group_size(i, begin_[t[0] + 1])};
}

Face_table::Triangle Face_table::outward(std::size_t position) const {
  const std::uint32_t half = halves_[position].tetrahedron_face;
  const auto& t = mesh_.tetrahedra[half / 4];
  const auto& k = face_vertices[half % 4];
  return {t[k[0]], t[k[1]], t[k[2]]};
}

bool Face_table::ascending_is_outward(std::size_t position) const {
  const Triangle t = outward(position);
  return (t[0] < t[1]) == ((t[1] < t[2]) == (t[0] < t[2]));
}

}  // namespace pgdr::quality_detail
