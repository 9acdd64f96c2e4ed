// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_INSERT_STEINER_POINT_3_H
#define PGDR_REFINEMENT_INSERT_STEINER_POINT_3_H

#include <algorithm>
#include <cstddef>

#include <pgdr/acute/split_guard_3.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/refinement/cell_classifier_3.h>
#include <pgdr/refinement/leaf_session_3.h>
#include <pgdr/refinement/steiner_point_3.h>

namespace pgdr {

/// Inserts the Steiner point of a tetrahedron, and looks at the tetrahedra around it. \pre its cavity is found
template <class Tr, class Criteria>
typename Tr::Vertex_handle insert_steiner_point(Leaf_session_3<Tr>& s, const Steiner_attempt_3<Tr>& t, Cell_classifier_3<Tr, Criteria>& classifier) {
  Cavity_3<Tr>& cavity = s.cavity();
  const double radius = std::max(t.least_distance(), inherited_radius(t.id.cell, t.ball, t.corners));
  const double relaxed = relaxed_length(t.id.cell, t.ball, t.corners);
  const typename Tr::Vertex_handle v = cavity.commit(t.point());
  v->set_feature(3, Tr::Vertex::none);
  v->set_insertion_radius(radius);
  v->relax_radius(relaxed);
  s.list().set_anchor(v);
  ++s.result.inserted;
  for (std::size_t k = 0; k < cavity.star().size(); ++k) classifier.classify_new(s, k);
  return v;
}

}  // namespace pgdr

#endif
