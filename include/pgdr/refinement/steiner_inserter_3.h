// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_STEINER_INSERTER_3_H
#define PGDR_REFINEMENT_STEINER_INSERTER_3_H

#include <algorithm>
#include <cstddef>

#include <pgdr/acute/split_guard_3.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/refinement/cell_classifier_3.h>
#include <pgdr/refinement/leaf_session_3.h>
#include <pgdr/refinement/steiner_point_3.h>

namespace pgdr {

/// Inserts Steiner points in the volume.
template <class Tr, class Criteria>
class Steiner_inserter_3 {
 public:
  using Vertex_handle = typename Tr::Vertex_handle;
  using Session = Leaf_session_3<Tr>;

  explicit Steiner_inserter_3(Cell_classifier_3<Tr, Criteria>& classifier) : classifier_(classifier) {}

  /// Inserts the Steiner point. \pre its cavity is found
  void insert(Session& s, const Steiner_attempt_3<Tr>& t) const {
    Cavity_3<Tr>& cavity = s.cavity();
    const double radius = std::max(t.least_distance(), inherited_radius(t.id.cell, t.ball, t.corners));
    const Vertex_handle v = cavity.commit(t.point());
    v->set_feature(3, Tr::Vertex::none);
    v->set_insertion_radius(radius);
    s.list().set_anchor(v);
    ++s.result.inserted;
    for (std::size_t k = 0; k < cavity.star().size(); ++k) classifier_.classify_new(s, k);
  }

 private:
  Cell_classifier_3<Tr, Criteria>& classifier_;
};

}  // namespace pgdr

#endif
