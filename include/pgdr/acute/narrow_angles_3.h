// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_ACUTE_NARROW_ANGLES_3_H
#define PGDR_ACUTE_NARROW_ANGLES_3_H

#include <algorithm>
#include <array>
#include <vector>

#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/feature_id.h>
#include <pgdr/domain/small_angles_3.h>

namespace pgdr {

/// The vertices and segments of a domain with an angle between features so small that no mesh keeps a radius-edge ratio next to it:
/// a triangle between the two features with a corner where they meet has its circumradius over its shortest edge at 1 / (2 sin angle)
/// at least.
class Narrow_angles_3 {
 public:
  template <class K>
  Narrow_angles_3(const Domain_3<K>& domain, const Small_angles& angles)
      : at_vertex_(domain.vertices.size()), at_segment_(domain.segments.size()), segments_of_facet_(domain.facets.size()),
        vertex_deg_(angles.vertex_deg), segment_deg_(angles.segment_deg) {
    for (Index s = 0; s < domain.segments.size(); ++s) {
      at_segment_[s].push_back({1, s});
      for (const Index f : domain.segments[s].facets) at_segment_[s].push_back({2, f});
      for (const Index v : domain.segments[s].vertices) at_vertex_[v].push_back({1, s});
      ends_.push_back(domain.segments[s].vertices);
    }
    for (Index f = 0; f < domain.facets.size(); ++f) {
      for (const Index v : domain.facets[f].vertices) at_vertex_[v].push_back({2, f});
      segments_of_facet_[f] = domain.facets[f].segments;
    }
  }

  /// Whether `p` is part of the other feature, a segment or facet, or is the same. \pre no dimension is above 2
  bool lies_on(const Feature_id& p, const Feature_id& feature) const {
    return any_at(p, [&](const Feature_id& f) { return f == feature; });
  }

  /// Asks about the segments and facets that a point is on.
  template <class Predicate>
  bool any_at(const Feature_id& p, const Predicate& predicate) const {
    if (p.dimension == 2) return predicate(p);
    return std::ranges::any_of(p.dimension == 1 ? at_segment_[p.index] : at_vertex_[p.index], predicate);
  }

  /// Of these, about the facets.
  template <class Predicate>
  bool any_facet(const Feature_id& p, const Predicate& predicate) const {
    return any_at(p, [&](const Feature_id& f) { return f.dimension == 2 && predicate(f); });
  }

  /// Whether a point at `u`, a domain vertex or on a segment, is where two features meet at less than `limit` degrees, of which the
  /// points at `p` and `q` are on one each. \pre dimensions are 2 at most
  bool are_narrow(const Feature_id& u, const Feature_id& p, const Feature_id& q, double limit) const {
    if (u.dimension > 1) return false;
    return any_at(p, [&](const Feature_id& a) {
      return lies_on(u, a) && !lies_on(q, a) && any_at(q, [&](const Feature_id& b) {
        return lies_on(u, b) && !lies_on(p, b) && meet_narrowly(a, b, u, limit);
      });
    });
  }

 private:
  bool meet_narrowly(const Feature_id& a, const Feature_id& b, const Feature_id& u, double limit) const {
    bool in_segment = false, in_narrow_segment = false;
    if (a.dimension == 2 && b.dimension == 2)
      for (const Index s : segments_of_facet_[a.index]) {
        const bool holds_u = u.dimension == 1 ? s == u.index : ends_[s][0] == u.index || ends_[s][1] == u.index;
        if (!holds_u || !lies_on({1, s}, b)) continue;
        in_segment = true;
        in_narrow_segment |= segment_deg_[s] < limit;
      }
    return in_segment ? in_narrow_segment : u.dimension == 0 && vertex_deg_[u.index] < limit;
  }

  std::vector<std::vector<Feature_id>> at_vertex_, at_segment_;  ///< the segments and facets there
  std::vector<std::vector<Index>> segments_of_facet_;
  std::vector<std::array<Index, 2>> ends_;
  std::vector<double> vertex_deg_, segment_deg_;
};

}  // namespace pgdr

#endif
