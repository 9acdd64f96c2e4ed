// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_ACUTE_ACUTE_NEIGHBORHOOD_3_H
#define PGDR_ACUTE_ACUTE_NEIGHBORHOOD_3_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Simple_cartesian.h>

#include <pgdr/acute/narrow_angles_3.h>
#include <pgdr/acute/protected_balls_3.h>
#include <pgdr/domain/detail/aabb_trees.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/feature_id.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mirrors/gaps_3.h>
#include <pgdr/mirrors/shells_3.h>
#include <pgdr/mirrors/vertex_wedges_3.h>
#include <pgdr/mirrors/wedges_3.h>

namespace pgdr {

/// The vertices and segments of a domain where two features meet at less than `limit` degrees, with distances to
/// them: Delaunay refinement cannot keep its promise next to these, and must not go on for ever there.
class Acute_neighborhood_3 {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Segments = std::vector<Kernel::Segment_3>;
  using Segment_tree = domain_detail::Aabb_segment_tree<Kernel>;
  using Vertex_search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;

 public:
  static constexpr double limit = 60;

  template <class K>
  explicit Acute_neighborhood_3(const Domain_3<K>& domain, Size_bounds sizes = {})
      : Acute_neighborhood_3(domain, std::move(sizes), domain_detail::Facet_edges(domain), small_angles_3(domain)) {}
  Acute_neighborhood_3(const Acute_neighborhood_3&) = delete;
  Acute_neighborhood_3& operator=(const Acute_neighborhood_3&) = delete;

  /// Whether two features meet at less than `limit` degrees in this domain vertex.
  bool is_acute_vertex(Index v) const { return is_acute_vertex_[v]; }

  double smallest_dihedral_deg() const { return smallest_dihedral_deg_; }

  const Facet_wedges_3& wedges() const { return wedges_; }
  const Segment_wedges_3& segment_wedges() const { return segment_wedges_; }
  const Vertex_wedges_3& vertex_wedges() const { return vertex_wedges_; }
  const Shells_3& shells() const { return shells_; }
  const Gaps_3& gaps() const { return gaps_; }
  const Protected_balls_3& balls() const { return *balls_; }
  const Narrow_angles_3& narrow() const { return *narrow_; }

  /// Whether p is within `distance` of such a vertex or segment.
  bool contains(const Vec_3& p, double distance) const {
    const Kernel::Point_3 q(p.x, p.y, p.z);
    if (vertices_.size() > 0 && Vertex_search(vertices_, q, 1).begin()->second <= distance * distance)
      return true;
    return !segments_.empty() && segment_tree_.squared_distance(q) <= distance * distance;
  }

  /// Whether two points p and q of different features, segments or facets, may be as close as
  /// they are just because the features meet at less than `limit` degrees, near p; or, if one is a segment, because a facet of it does, with an image of
  /// what is on either on the other. The local feature size, which takes no notice of features that meet, does not know such distances.
  bool explains(const Feature_id& of_p, const Vec_3& p, const Feature_id& of_q, const Vec_3& q) const {
    if (of_p == of_q || !has_angles(of_p) || !has_angles(of_q)) return false;
    if (narrow_->lies_on(of_p, of_q) || narrow_->lies_on(of_q, of_p)) return false;
    const double gap2 = squared_distance(p, q);
    const auto accounts = [&](Place place, const std::vector<Place>& of_other) { return gap2 >= squared_gap(place, p) && std::ranges::binary_search(of_other, place); };
    if (std::ranges::any_of(angles_at(of_p), [&](Place place) { return accounts(place, angles_at(of_q)); })) return true;
    if (of_p.dimension == 2 && of_q.dimension == 2) return false;
    // A segment of a facet is as close to the other facet as the facet is.
    return narrow_->any_facet(of_p, [&](const Feature_id& f) {
      return !narrow_->lies_on(of_q, f) && narrow_->any_facet(of_q, [&](const Feature_id& g) {
        return !narrow_->lies_on(of_p, g) && std::ranges::any_of(angles_at(f), [&](Place place) {
          return ((place & segment_bit) || vertex_wedges_.are_close(f, g)) && accounts(place, angles_at(g));
        });
      });
    });
  }

  /// Whether two features come close to each other at vertices only, none of them the end of a segment with a small dihedral
  /// angle, and neither, nor a facet that it is on, above the other (`Vertex_wedges_3`). Then how far apart they are is bounded from below, but for their pieces at these vertices (`meet_at`).
  bool meet_at_vertices_only(const Feature_id& a, const Feature_id& b) const {
    const auto& of_b = angles_at(b);
    const bool is_above = narrow_->any_at(a, [&](const Feature_id& f) {
      return narrow_->any_at(b, [&](const Feature_id& g) { return vertex_wedges_.are_close(f, g); });
    });
    return !is_above && std::ranges::none_of(angles_at(a), [&](Place place) {
      return ((place & segment_bit) || ends_wedge_[place]) && std::ranges::binary_search(of_b, place);
    });
  }

  /// Whether two features meet at a small angle in this domain vertex.
  bool meet_at(Index vertex, const Feature_id& a, const Feature_id& b) const {
    return std::ranges::binary_search(angles_at(a), Place{vertex}) && std::ranges::binary_search(angles_at(b), Place{vertex});
  }

  /// Whether two features meet at a small angle so near to m that it is protected there: inside the ball of the vertex, or within
  /// `protected_part` of the length of the segment, or the size if that is less, that they meet in. On the sphere is not inside: with its point there a
  /// segment stays as it is, and without, it would be in the way of all that comes near.
  bool protects(const Vec_3& m, const Feature_id& a, const Feature_id& b) const {
    return std::ranges::any_of(angles_at(a), [&](Place place) {
      const double radius = protected_radius(place), distance2 = squared_distance_to(place, m);
      if (!(distance2 < radius * radius) || !std::ranges::binary_search(angles_at(b), place)) return false;
      return !(place & segment_bit) || !sizes_.is_below(m, std::sqrt(distance2));
    });
  }

 private:
  template <class K>
  Acute_neighborhood_3(const Domain_3<K>& domain, Size_bounds sizes, const domain_detail::Facet_edges& edges, const Small_angles& angles)
      : wedges_(domain, edges), shells_(domain, angles), segment_wedges_(domain, edges, shells_), vertex_wedges_(domain, angles), gaps_(domain), sizes_(std::move(sizes)) {
    smallest_dihedral_deg_ = angles.smallest_dihedral_deg;
    is_acute_vertex_.resize(domain.vertices.size(), false);
    list_small_angles(domain, angles);
    const auto point = [&](Index v) {
      const Vec_3 p = to_vec(domain.vertices[v]);
      return Kernel::Point_3(p.x, p.y, p.z);
    };
    for (Index v = 0; v < domain.vertices.size(); ++v) {
      if (angles.vertex_deg[v] >= limit) continue;
      is_acute_vertex_[v] = true;
      vertices_.insert(point(v));
    }
    for (Index s = 0; s < domain.segments.size(); ++s)
      if (angles.segment_deg[s] < limit)
        segments_.emplace_back(point(domain.segments[s].vertices[0]), point(domain.segments[s].vertices[1]));
    balls_.emplace(domain, is_acute_vertex_, sizes_);
    narrow_.emplace(domain, angles);
    segment_tree_.rebuild(segments_.begin(), segments_.end());
    if (!segments_.empty()) segment_tree_.build();
    if (vertices_.size() > 0) vertices_.build();
  }

  /// A small angle: a vertex, or a segment with `segment_bit`.
  using Place = std::uint64_t;
  static constexpr Place segment_bit = Place{1} << 32;
  /// How far around a segment nothing is deleted for the sake of quality, of its length: far below what other features leave to it.
  static constexpr double protected_part = 1e-3;

  template <class K>
  void list_small_angles(const Domain_3<K>& domain, const Small_angles& angles) {
    const auto is_small = [](double degrees) { return degrees < limit; };
    const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
    at_segment_.resize(domain.segments.size());
    ends_wedge_.resize(domain.vertices.size(), false);
    at_facet_.resize(domain.facets.size());
    for (Index s = 0; s < domain.segments.size(); ++s)
      for (const Index v : domain.segments[s].vertices) {
        if (is_small(angles.vertex_deg[v])) at_segment_[s].push_back(v);
        if (is_small(angles.segment_deg[s])) ends_wedge_[v] = true;
      }
    for (auto& list : at_segment_) std::sort(list.begin(), list.end());
    for (Index f = 0; f < domain.facets.size(); ++f) {
      for (const Index v : domain.facets[f].vertices)
        if (is_small(angles.vertex_deg[v])) at_facet_[f].push_back(v);
      for (const Index s : domain.facets[f].segments)
        if (is_small(angles.segment_deg[s])) at_facet_[f].push_back(segment_bit | s);
    }
    position_.reserve(domain.vertices.size());
    for (const auto& p : domain.vertices) position_.push_back(to_vec(p));
    vertex_angle_.reserve(domain.vertices.size());
    for (const double d : angles.vertex_deg) vertex_angle_.push_back(radians(d));
    for (Index s = 0; s < domain.segments.size(); ++s) {
      segment_angle_.push_back(radians(angles.segment_deg[s]));
      ends_.push_back(domain.segments[s].vertices);
    }
  }

  static bool has_angles(const Feature_id& f) { return f.dimension == 1 || f.dimension == 2; }
  const std::vector<Place>& angles_at(const Feature_id& f) const {
    return f.dimension == 1 ? at_segment_[f.index] : at_facet_[f.index];
  }

  double protected_radius(Place place) const {
    const auto i = static_cast<Index>(place & ~segment_bit);
    if (!(place & segment_bit)) return (1 - 1e-9) * balls_->radius(i);
    return protected_part * length(position_[ends_[i][1]] - position_[ends_[i][0]]);
  }

  double squared_distance_to(Place place, const Vec_3& p) const {
    const auto i = static_cast<Index>(place & ~segment_bit);
    if (!(place & segment_bit)) return squared_distance(p, position_[i]);
    const auto point = [](const Vec_3& v) { return Kernel::Point_3(v.x, v.y, v.z); };
    return CGAL::squared_distance(point(p),
                                  Kernel::Segment_3(point(position_[ends_[i][0]]), point(position_[ends_[i][1]])));
  }

  /// How close two features that meet in a small angle are at p at least: half of the distance that the angle makes.
  double squared_gap(Place place, const Vec_3& p) const {
    const auto i = static_cast<Index>(place & ~segment_bit);
    const double angle = place & segment_bit ? segment_angle_[i] : vertex_angle_[i];
    return 0.25 * angle * angle * squared_distance_to(place, p);
  }

  Facet_wedges_3 wedges_;
  Shells_3 shells_;
  Segment_wedges_3 segment_wedges_;
  Vertex_wedges_3 vertex_wedges_;
  Gaps_3 gaps_;
  Size_bounds sizes_;
  std::optional<Protected_balls_3> balls_;
  std::optional<Narrow_angles_3> narrow_;
  double smallest_dihedral_deg_ = 180;
  std::vector<bool> is_acute_vertex_;
  std::vector<bool> ends_wedge_;                           ///< vertices of segments with small dihedral angles
  std::vector<std::vector<Place>> at_segment_, at_facet_;  ///< the small angles there, ascending
  std::vector<std::array<Index, 2>> ends_;
  std::vector<Vec_3> position_;
  std::vector<double> vertex_angle_, segment_angle_;
  Vertex_search::Tree vertices_;
  Segments segments_;
  Segment_tree segment_tree_;
};

}  // namespace pgdr

#endif
