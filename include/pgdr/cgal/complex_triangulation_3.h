// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CGAL_COMPLEX_TRIANGULATION_3_H
#define PGDR_CGAL_COMPLEX_TRIANGULATION_3_H

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Tetrahedral_remeshing/Remeshing_cell_base_3.h>
#include <CGAL/Tetrahedral_remeshing/Remeshing_vertex_base_3.h>
#include <CGAL/version.h>
#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/Simplicial_mesh_cell_base_3.h>
#include <CGAL/Simplicial_mesh_vertex_base_3.h>
#endif

namespace pgdr {

namespace internal {

// What CGAL's remeshing bases are over: since CGAL 6, over bases that have the indices of a mesh already.
#if CGAL_VERSION_MAJOR >= 6
template <class K, class Vb>
using Indexed_vertex_base_3 = CGAL::Simplicial_mesh_vertex_base_3<K, int, int, int, int, Vb>;
template <class K, class Cb>
using Indexed_cell_base_3 = CGAL::Simplicial_mesh_cell_base_3<K, int, int, Cb>;
#else
template <class, class Vb>
using Indexed_vertex_base_3 = Vb;
template <class, class Cb>
using Indexed_cell_base_3 = Cb;
#endif

}  // namespace internal

/// A Delaunay triangulation for `CGAL::Mesh_complex_3_in_triangulation_3` and CGAL's remeshing, with CGAL 5 and 6 alike. All indices are `int`.
/// \tparam Cb what a cell has besides: a model of `TriangulationCellBase_3`, `CGAL::Triangulation_cell_base_with_info_3` for instance
/// \tparam Vb the same for a vertex
template <class K, class Cb = CGAL::Triangulation_cell_base_3<K>, class Vb = CGAL::Triangulation_vertex_base_3<K>>
using Complex_triangulation_3 =
    CGAL::Delaunay_triangulation_3<K, CGAL::Triangulation_data_structure_3<CGAL::Tetrahedral_remeshing::Remeshing_vertex_base_3<K, internal::Indexed_vertex_base_3<K, Vb>>,
                                                                           CGAL::Tetrahedral_remeshing::Remeshing_cell_base_3<K, internal::Indexed_cell_base_3<K, Cb>>>>;

}  // namespace pgdr

#endif
