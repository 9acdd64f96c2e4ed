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

/// Sets have names of up to 80 characters that begin with a letter.
std::string set_name(const std::string& name) {
  std::string word = io_detail::word_of(name);
  if (!(('a' <= word[0] && word[0] <= 'z') || ('A' <= word[0] && word[0] <= 'Z'))) word = "_" + word;
  return word.substr(0, 64);  // what is put behind it where two would be the same has room
}

/// In the 20 characters that a number may take: exactly where that is enough, else in 13 digits.
char* put_real(char* out, double x) {
  constexpr std::ptrdiff_t most = 20;
  char* const end = put_number(out, x);
  return end - out <= most ? end : std::to_chars(out, out + io_detail::max_number_length, x, std::chars_format::scientific, 12).ptr;
}

template <std::size_t N, std::size_t M>
void write_elements(Atomic_file& out, const char* type, const std::vector<io_detail::Mesh_group>& groups, const io_detail::Element_nodes<N, M>& elements,
                    std::size_t& number) {
  for (const io_detail::Mesh_group& g : groups) {
    out.write(std::string("*ELEMENT, TYPE=") + type + ", ELSET=" + g.name + "\n");
    io_detail::write_rows(out, g.elements.size(), 1 + N + M, [&](std::size_t first, std::size_t last, char* text) {
      for (std::size_t i = first; i < last; ++i) text = put_char(io_detail::put_nodes(put_number(text, number + i), elements, g.elements[i], 1, ','), '\n');
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
  const bool is_second_order = !mesh.tetrahedron_nodes.empty();
  write_elements(out, is_second_order ? "C3D10" : "C3D4", io_detail::regions_of(mesh, set_name), io_detail::tetrahedra_of(mesh, io_detail::edges_in_vtk), number);
  write_elements(out, is_second_order ? "STRI65" : "S3", io_detail::markers_of(mesh, set_name), io_detail::triangles_of(mesh), number);
  out.commit();
}

}  // namespace pgdr
