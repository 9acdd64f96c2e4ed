// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_FEATURE_ID_H
#define PGDR_DOMAIN_FEATURE_ID_H

#include <pgdr/domain/domain_3.h>

namespace pgdr {

/// A segment or a facet; or, where a point is said to be on it, a vertex of the domain.
struct Feature_id {
  int dimension = 0;  ///< 0: vertex, 1: segment, 2: facet
  Index index = 0;

  friend bool operator==(const Feature_id&, const Feature_id&) = default;
};

/// What a vertex of the mesh is on; of dimension 3 or more if that is no feature.
template <class Vertex_handle>
Feature_id feature_of(Vertex_handle v) {
  return {v->in_dimension(), v->index()};
}

}  // namespace pgdr

#endif
