// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstring>

#include <pgdr/quality/mesh_quality.h>

namespace pgdr {

namespace {

class Mixer {
 public:
  void add(std::uint64_t word) {
    std::uint64_t z = (h_ ^ word) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    h_ = z ^ (z >> 31);
  }
  void add(double value) {
    static_assert(sizeof(double) == sizeof(std::uint64_t));
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
  }
  void add(std::uint32_t index) { add(std::uint64_t(index)); }
  void add(std::int32_t reference) { add(std::uint64_t(std::uint32_t(reference))); }
  template <class T, std::size_t N>
  void add(const std::array<T, N>& items) {
    for (const T& item : items) add(item);
  }
  template <class T>
  void add(const std::vector<T>& items) {
    add(std::uint64_t(items.size()));
    for (const T& item : items) add(item);
  }
  std::uint64_t value() const { return h_; }

 private:
  std::uint64_t h_ = 0x70676472u;
};

}  // namespace

std::uint64_t mesh_checksum(const Indexed_mesh_3& mesh) {
  Mixer mixer;
  mixer.add(mesh.points);
  mixer.add(mesh.point_references);
  mixer.add(mesh.edges);
  mixer.add(mesh.edge_references);
  mixer.add(mesh.triangles);
  mixer.add(mesh.triangle_references);
  mixer.add(mesh.tetrahedra);
  mixer.add(mesh.tetrahedron_references);
  return mixer.value();
}

}  // namespace pgdr
