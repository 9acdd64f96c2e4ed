// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pgdr/mesh/scale_mesh.h>
#include <pgdr/parallel/parallel_reduce.h>
#include <pgdr/quality/mesh_quality.h>

namespace pgdr {

namespace {

constexpr std::size_t numbers_per_block = std::size_t(1) << 14;
constexpr std::uint64_t start = 0x70676472u;

/// The finalizer of SplitMix64.
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Four sequences side by side, since a processor can mix several numbers at once but none before the one it needs.
class Mixer {
 public:
  void add(std::size_t position, std::uint64_t word) {
    std::uint64_t& h = h_[position % h_.size()];
    h = mixed(h ^ word);
  }
  std::uint64_t value() const {
    std::uint64_t all = start;
    for (const std::uint64_t h : h_) all = mixed(all ^ h);
    return all;
  }

 private:
  std::array<std::uint64_t, 4> h_{start, start, start, start};
};

std::uint64_t block_hash(const double* first, std::size_t n) {
  static_assert(sizeof(double) == sizeof(std::uint64_t));
  Mixer mixer;
  for (std::size_t i = 0; i < n; ++i) mixer.add(i, std::bit_cast<std::uint64_t>(first[i]));
  return mixer.value();
}

/// Of 32-bit numbers, two to a word.
template <class Integer>
std::uint64_t block_hash(const Integer* first, std::size_t n) {
  static_assert(sizeof(Integer) == sizeof(std::uint32_t));
  const auto number = [first](std::size_t i) { return std::uint64_t(std::uint32_t(first[i])); };
  Mixer mixer;
  for (std::size_t i = 0; i < n / 2; ++i) mixer.add(i, number(2 * i) | number(2 * i + 1) << 32);
  if (n % 2 != 0) mixer.add(n / 2, number(n - 1));
  return mixer.value();
}

template <class Number>
void add_numbers(std::uint64_t& h, const Number* first, std::size_t n) {
  h = mixed(h ^ std::uint64_t(n));
  h = parallel_reduce(
      n, numbers_per_block, h, [first](std::size_t i, std::size_t end) { return block_hash(first + i, end - i); },
      [](std::uint64_t& all, std::uint64_t block) { all = mixed(all ^ block); });
}

template <class Number>
void add(std::uint64_t& h, const std::vector<Number>& numbers) {
  add_numbers(h, numbers.data(), numbers.size());
}

template <class Number, std::size_t N>
void add(std::uint64_t& h, const std::vector<std::array<Number, N>>& rows) {
  static_assert(sizeof(rows[0]) == N * sizeof(Number));
  add_numbers(h, rows.empty() ? nullptr : rows.front().data(), N * rows.size());
}

}  // namespace

std::uint64_t mesh_checksum(const Indexed_mesh_3& mesh) {
  if (mesh.exponent != 0) return mesh_checksum(scaled_to(mesh, 0));
  std::uint64_t h = start;
  add(h, mesh.points);
  add(h, mesh.point_references);
  add(h, mesh.edges);
  add(h, mesh.edge_references);
  add(h, mesh.triangles);
  add(h, mesh.triangle_references);
  add(h, mesh.tetrahedra);
  add(h, mesh.tetrahedron_references);
  return h;
}

}  // namespace pgdr
