// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/write_quality.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <pgdr/domain/scale.h>
#include <pgdr/io/atomic_file.h>
#include <pgdr/quality/measures.h>
#include <pgdr/quality/shape_measures.h>

#include "numbers.h"
#include "text_blocks.h"

namespace pgdr {
namespace {

using io_detail::put_char;
using io_detail::put_number;

constexpr char names[] =
    "tetrahedron,region,volume,circumradius,radius_edge_ratio,min_dihedral_angle,max_dihedral_angle,"
    "edge_ratio,aspect_ratio,mean_ratio,scaled_jacobian";
constexpr char names_of_marks[] = ",exempt,unrefined";
constexpr std::size_t columns = 13;

char* format_tetrahedron(const Indexed_mesh_3& mesh, std::size_t i, bool with_marks, char* out) {
  const auto& t = mesh.tetrahedra[i];
  const auto &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]], &d = mesh.points[t[3]];
  const double determinant = orientation_determinant(a, b, c, d);
  const auto angles = dihedral_angles_deg(a, b, c, d);
  const Shape_measures m = shape_measures(a, b, c, d, determinant);
  out = put_char(put_number(out, i), ',');
  out = put_number(out, i < mesh.tetrahedron_references.size() ? mesh.tetrahedron_references[i] : 0);
  for (const double value : {std::ldexp(determinant / 6, 3 * mesh.exponent), unit_of(mesh) * std::sqrt(squared_circumradius(a, b, c, d))})
    out = put_number(put_char(out, ','), value);
  for (const double value : {radius_edge_ratio(a, b, c, d), *std::ranges::min_element(angles), *std::ranges::max_element(angles), m.edge_ratio,
                             m.aspect_ratio, m.mean_ratio, m.scaled_jacobian})
    out = put_number(put_char(out, ','), static_cast<float>(value));
  if (with_marks)
    for (const auto* marked : {&mesh.exempt, &mesh.unrefined})
      out = put_char(put_char(out, ','), std::ranges::binary_search(*marked, i) ? '1' : '0');
  return put_char(out, '\n');
}

}  // namespace

void write_quality(const Indexed_mesh_3& mesh, const std::filesystem::path& path, bool with_marks) {
  Atomic_file out(path);
  out.write(names);
  if (with_marks) out.write(names_of_marks);
  out.write("\n");
  io_detail::write_rows(out, mesh.tetrahedra.size(), columns, [&mesh, with_marks](std::size_t first, std::size_t last, char* text) {
    for (std::size_t i = first; i < last; ++i) text = format_tetrahedron(mesh, i, with_marks, text);
    return text;
  });
  out.commit();
}

}  // namespace pgdr
