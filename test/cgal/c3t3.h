// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_CGAL_C3T3_H
#define PGDR_TEST_CGAL_C3T3_H

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>

#include <pgdr/cgal/complex_triangulation_3.h>
#include <pgdr/domain/default_kernel.h>

namespace pgdr_test {

/// Something of the user's that cells know.
struct Note {
  int value = 3;
};
using Kernel = pgdr::Default_kernel;
using User_triangulation = pgdr::Complex_triangulation_3<Kernel, CGAL::Triangulation_cell_base_with_info_3<Note, Kernel>>;
/// CGAL's complex over such a triangulation.
using C3t3 = CGAL::Mesh_complex_3_in_triangulation_3<User_triangulation>;

}  // namespace pgdr_test

#endif
