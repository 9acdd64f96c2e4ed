// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_TORN_FEATURES_3_H
#define PGDR_CONFORMING_TORN_FEATURES_3_H

#include <algorithm>
#include <cstdint>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/acute/split_spacing_3.h>
#include <pgdr/conforming/cavity_features_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/conforming/split_points_3.h>

namespace pgdr {

/// Whether the point m on a feature would delete pieces of another feature so near to a small angle between the two that
/// these are protected: no piece that is there is deleted for the sake of quality. Of features that keep deleting each
/// other's pieces, ever closer to where they meet, one has to give in. `split` is the subsegment that the point splits, or none.
template <class Tr>
bool tears_protected(const Constraint_complex_3<Tr>& complex, const Cavity_features_3<Tr>& features,
                     const Acute_neighborhood_3& acute, const Vec_3& m, const Feature_id& on, std::uint32_t split) {
  const auto is_split = [&](Index facet) {
    if (on.dimension == 2) return facet == on.index;
    const auto& sheets = complex.subsegment(split).subfacets;
    return std::ranges::any_of(sheets, [&](std::uint32_t t) { return complex.subfacet(t).facet == facet; });
  };
  const auto is_protected = [&](const Feature_id& torn) { return acute.protects(m, on, torn); };
  return std::ranges::any_of(features.subsegments(),
                             [&](const auto& f) {
                               return f.deleted && f.slot != split && is_protected({1, complex.subsegment(f.slot).segment});
                             }) ||
         std::ranges::any_of(features.subfacets(), [&](const auto& f) {
           const Index facet = complex.subfacet(f.slot).facet;
           return f.deleted && !is_split(facet) && is_protected({2, facet});
         });
}

/// Whether p, whose cavity is found, encroaches a piece in a protected ball, where there are any (`acute`). Once such a piece is missing, it does not come back: subsegments are
/// not split there, subfacets on the sphere only, and half of an arc is encroached like all of it (docs/theory.md, section 12).
template <class Tr>
bool encroaches_protected(const Constraint_complex_3<Tr>& complex, const Cavity_features_3<Tr>& features, const Acute_neighborhood_3* acute,
                          const typename Tr::Point& p) {
  if (!acute) return false;
  const Split_points_3<Tr> pieces(complex, *acute);
  return std::ranges::any_of(features.subsegments(),
                             [&](const auto& f) { return pieces.is_subsegment_protected(f.slot) && is_encroached(complex.subsegment(f.slot), p); }) ||
         std::ranges::any_of(features.subfacets(),
                             [&](const auto& f) { return pieces.is_subfacet_protected(f.slot) && is_encroached(complex.subfacet(f.slot), p); });
}

}  // namespace pgdr

#endif
