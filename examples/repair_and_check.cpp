// SPDX-License-Identifier: GPL-3.0-or-later
// A surface with two parts pushed into each other and a face missing: repaired, meshed, measured and checked.
#include <iostream>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/quality/check_mesh.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/refine_mesh_3.h>
#include <pgdr/repair/repair.h>

#include "cube.h"

int main() {
  pgdr::Plc parts;
  add_cube(parts);
  add_cube(parts, 0.6);
  parts.facets.pop_back();

  pgdr::Repair_options options;
  options.largest_hole = 2;  // the diagonal of the box around its rim
  const pgdr::Plc plc = pgdr::repair(parts, options);
  const pgdr::Indexed_mesh_3 mesh = pgdr::indexed_mesh_3(pgdr::refine_mesh_3(plc, pgdr::Uniform_sizing_field(0.2)));
  const pgdr::Mesh_quality quality = pgdr::mesh_quality(mesh);
  std::cout << quality.tetrahedra << " tetrahedra, volume " << quality.volume << ", smallest dihedral angle " << quality.min_dihedral_deg << "\n";
  const auto domain = pgdr::make_domain_3(plc);
  return pgdr::all_passed(pgdr::check_mesh(mesh, &domain)) ? 0 : 1;
}
