// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
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

/// Each triangle as the side of a tetrahedron: which one, and the number that the format gives the side (S1 to S4).
struct Side {
  std::uint32_t tetrahedron = none;
  int number = 0;
  static constexpr std::uint32_t none = 0xffffffffu;
};

std::vector<Side> sides_of(const Indexed_mesh_3& mesh) {
  std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> triangles;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) triangles.emplace_back(io_detail::sorted_corners(mesh.triangles[i]), i);
  std::ranges::sort(triangles);
  std::vector<Side> sides(triangles.size());
  constexpr int number_opposite_of[4] = {3, 4, 2, 1};  // S1 has the first three corners, S2 1 4 2, S3 2 4 3, S4 3 4 1
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto face = io_detail::sorted_face(mesh.tetrahedra[t], k);
      const auto found = std::ranges::lower_bound(triangles, std::pair(face, std::uint32_t{0}));
      if (found == triangles.end() || found->first != face) continue;
      Side& side = sides[found->second];
      if (side.tetrahedron == Side::none) side = {t, number_opposite_of[k]};
    }
  return sides;
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
  const auto tetrahedra = io_detail::tetrahedra_of(mesh, io_detail::edges_in_vtk);
  std::vector<std::uint32_t> numbers(mesh.tetrahedra.size());
  std::uint32_t number = 0;
  for (const io_detail::Mesh_group& g : io_detail::regions_of(mesh, set_name)) {
    out.write(std::string("*ELEMENT, TYPE=") + (mesh.tetrahedron_nodes.empty() ? "C3D4" : "C3D10") + ", ELSET=" + g.name + "\n");
    for (const std::uint32_t i : g.elements) numbers[i] = ++number;
    io_detail::write_rows(out, g.elements.size(), 1 + 10, [&](std::size_t first, std::size_t last, char* text) {
      for (std::size_t i = first; i < last; ++i) text = put_char(io_detail::put_nodes(put_number(text, numbers[g.elements[i]]), tetrahedra, g.elements[i], 1, ','), '\n');
      return text;
    });
  }
  const std::vector<Side> sides = sides_of(mesh);
  for (const io_detail::Mesh_group& g : io_detail::markers_of(mesh, set_name)) {
    out.write("*SURFACE, TYPE=ELEMENT, NAME=" + g.name + "\n");
    for (const std::uint32_t i : g.elements)
      if (sides[i].tetrahedron != Side::none) out.write(std::to_string(numbers[sides[i].tetrahedron]) + ",S" + std::to_string(sides[i].number) + "\n");
  }
  out.commit();
}

}  // namespace pgdr
