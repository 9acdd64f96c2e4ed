// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pgdr/io/abaqus.h>
#include <pgdr/io/atomic_file.h>

#include "mesh_groups.h"

namespace pgdr {
namespace {

using io_detail::put_char;
using io_detail::put_number;

/// In the 20 characters that a number may take: exactly where that is enough, else in 13 digits.
char* put_real(char* out, double x) {
  constexpr std::ptrdiff_t most = 20;
  char* const end = put_number(out, x);
  return end - out <= most ? end : std::to_chars(out, out + io_detail::max_number_length, x, std::chars_format::scientific, 12).ptr;
}

template <std::size_t N>
void write_elements(Atomic_file& out, const char* type, const std::vector<io_detail::Mesh_group>& groups, const std::vector<std::array<std::uint32_t, N>>& elements,
                    std::size_t& number) {
  for (const io_detail::Mesh_group& g : groups) {
    out.write(std::string("*ELEMENT, TYPE=") + type + ", ELSET=" + g.name + "\n");
    io_detail::write_rows(out, g.elements.size(), 1 + N, [&](std::size_t first, std::size_t last, char* text) {
      for (std::size_t i = first; i < last; ++i) text = put_char(io_detail::put_vertices(put_number(text, number + i), elements[g.elements[i]], 1, ','), '\n');
      return text;
    });
    number += g.elements.size();
  }
}

}  // namespace

void write_abaqus(const Indexed_mesh_3& mesh, const std::filesystem::path& path) {
  Atomic_file out(path);
  out.write("*HEADING\npgdr\n*NODE\n");
  io_detail::write_rows(out, mesh.points.size(), 4, [&](std::size_t first, std::size_t last, char* text) {
    const double unit = unit_of(mesh);
    for (std::size_t i = first; i < last; ++i) {
      text = put_number(text, i + 1);
      for (const double x : mesh.points[i]) text = put_real(put_char(text, ','), unit * x);
      text = put_char(text, '\n');
    }
    return text;
  });
  std::size_t number = 1;
  write_elements(out, "C3D4", io_detail::regions_of(mesh), mesh.tetrahedra, number);
  write_elements(out, "S3", io_detail::markers_of(mesh), mesh.triangles, number);
  out.commit();
}

}  // namespace pgdr
