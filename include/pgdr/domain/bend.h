// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_BEND_H
#define PGDR_DOMAIN_BEND_H

#include <algorithm>
#include <cmath>

#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

/// How far vertices of a facet are off its plane at most, since it was fused of near-coplanar ones; 0 if that is rounding only.
template <class K>
double bend(const Domain_3<K>& domain, Index facet) {
  constexpr double flatness = 1e-12;  // of the diagonal: how far vertices of a flat facet may be off its plane
  const auto& f = domain.facets[facet];
  const Vec_3 origin = to_vec(f.origin), normal = to_vec(f.normal);
  double most = 0;
  for (const Index v : f.vertices) most = std::max(most, std::abs(dot(to_vec(domain.vertices[v]) - origin, normal)));
  return most > flatness * domain.diagonal ? most : 0;
}

}  // namespace pgdr

#endif
