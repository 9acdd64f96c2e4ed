// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's legacy format: W. Schroeder et al., VTK file formats, "Simple legacy formats".
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <pgdr/io/atomic_file.h>
#include <pgdr/io/vtk.h>

#include "mesh_groups.h"

namespace pgdr {
namespace {

/// Numbers with the first byte first, as the format wants them, some thousands at a time.
class Big_endian {
 public:
  explicit Big_endian(Atomic_file& out) : out_(out) {}
  ~Big_endian() = default;
  Big_endian(const Big_endian&) = delete;
  Big_endian& operator=(const Big_endian&) = delete;

  void put(std::int32_t x) { put_bytes<4>(static_cast<std::uint32_t>(x)); }
  void put(double x) { put_bytes<8>(std::bit_cast<std::uint64_t>(x)); }

  /// Ends a list of numbers.
  void end() {
    flush();
    out_.write("\n");
  }

 private:
  template <int N>
  void put_bytes(std::uint64_t bits) {
    for (int shift = 8 * (N - 1); shift >= 0; shift -= 8) bytes_ += static_cast<char>(bits >> shift & 0xff);
    if (bytes_.size() >= std::size_t{1} << 16) flush();
  }
  void flush() {
    out_.write(bytes_);
    bytes_.clear();
  }

  Atomic_file& out_;
  std::string bytes_;
};

}  // namespace

void write_vtk(const Indexed_mesh_3& mesh, const std::filesystem::path& path) {
  const auto tetrahedra = io_detail::tetrahedra_of(mesh, io_detail::edges_in_vtk);
  const auto triangles = io_detail::triangles_of(mesh);
  const std::size_t cells = tetrahedra.size() + triangles.size();
  const std::size_t numbers = cells + tetrahedra.size() * tetrahedra.nodes_of_each() + triangles.size() * triangles.nodes_of_each();
  if (numbers > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::length_error("the mesh is too large for VTK's legacy format: write it as .vtu");
  const auto for_both = [&](const auto& f) {
    f(tetrahedra, mesh.tetrahedron_references, mesh.tetrahedron_nodes.empty() ? 10 : 24);
    f(triangles, mesh.triangle_references, mesh.triangle_nodes.empty() ? 5 : 22);
  };

  Atomic_file out(path);
  Big_endian bytes(out);
  out.write("# vtk DataFile Version 3.0\npgdr\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS " + std::to_string(mesh.points.size()) + " double\n");
  const double unit = unit_of(mesh);
  for (const auto& p : mesh.points)
    for (const double x : p) bytes.put(unit * x);
  bytes.end();
  out.write("CELLS " + std::to_string(cells) + " " + std::to_string(numbers) + "\n");
  for_both([&](const auto& elements, const auto&, int) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      bytes.put(static_cast<std::int32_t>(elements.nodes_of_each()));
      for (std::size_t k = 0; k < elements.nodes_of_each(); ++k) bytes.put(static_cast<std::int32_t>(elements.node(i, k)));
    }
  });
  bytes.end();
  out.write("CELL_TYPES " + std::to_string(cells) + "\n");
  for_both([&](const auto& elements, const auto&, int type) {
    for (std::size_t i = 0; i < elements.size(); ++i) bytes.put(type);
  });
  bytes.end();
  out.write("CELL_DATA " + std::to_string(cells) + "\nSCALARS attribute int 1\nLOOKUP_TABLE default\n");
  for_both([&](const auto& elements, const auto& references, int) {
    for (std::size_t i = 0; i < elements.size(); ++i) bytes.put(io_detail::reference_of(references, i));
  });
  bytes.end();
  out.commit();
}

}  // namespace pgdr
