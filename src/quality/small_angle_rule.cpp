// SPDX-License-Identifier: GPL-3.0-or-later
#include "small_angle_rule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>

#include <pgdr/domain/bend.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/quality/measures.h>

#include "aabb_tree.h"
#include "check_parts.h"

namespace pgdr::quality_detail {

namespace {

constexpr std::array<double, Small_angle_rule::classes> class_bounds_deg{Small_angles::critical_plane_angle_deg, 30, 60};
constexpr std::array<const char*, Small_angle_rule::classes> class_names{"< 14.48", "< 30", "< 60"};
constexpr double no_angle = std::numeric_limits<double>::infinity();

/// The class of an angle in degrees; the number of classes for 60 and above.
std::size_t class_of(double degrees) {
  return std::size_t(std::ranges::upper_bound(class_bounds_deg, degrees) - class_bounds_deg.begin());
}

Plain::Point_3 plain(const Epick_domain& domain, Index v) {
  const auto& p = domain.vertices[v];
  return Plain::Point_3(p.x(), p.y(), p.z());
}

/// The vertices and segments of a domain whose smallest angle is in one class.
class Sharp_features {
 public:
  void add(const Plain::Point_3& p) { vertices_.insert(p); }
  void add(const Plain::Point_3& p, const Plain::Point_3& q) {
    items_.push_back({Plain::Segment_3(p, q), 0});
  }
  void build() {
    if (vertices_.size() > 0) vertices_.build();
    if (!items_.empty()) segments_.emplace(items_.begin(), items_.end());
  }
  std::size_t size() const { return vertices_.size() + items_.size(); }

  double squared_distance(const Plain::Point_3& p) const {
    double result = std::numeric_limits<double>::infinity();
    if (vertices_.size() > 0) result = Search(vertices_, p, 1).begin()->second;
    if (segments_) result = std::min(result, segments_->squared_distance(p));
    return result;
  }

 private:
  using Search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Plain>>;
  Search::Tree vertices_;
  std::vector<Tagged<Plain::Segment_3>> items_;
  std::optional<Aabb_tree<Plain::Segment_3>> segments_;
};

using Sharp_classes = std::array<Sharp_features, class_bounds_deg.size()>;

std::unique_ptr<Sharp_classes> sharp_features(const Epick_domain& domain, const Small_angles& angles) {
  auto classes = std::make_unique<Sharp_classes>();
  for (std::size_t v = 0; v < angles.vertex_deg.size(); ++v)
    if (const std::size_t c = class_of(angles.vertex_deg[v]); c < classes->size())
      (*classes)[c].add(plain(domain, Index(v)));
  for (std::size_t s = 0; s < angles.segment_deg.size(); ++s)
    if (const std::size_t c = class_of(angles.segment_deg[s]); c < classes->size())
      (*classes)[c].add(plain(domain, domain.segments[s].vertices[0]),
                        plain(domain, domain.segments[s].vertices[1]));
  for (auto& c : *classes) c.build();
  return classes;
}

/// What small angles explain: short edges between points of two segments or facets that meet in one, no closer to each other
/// than half of what the angle makes them; and all that is next to one.
class Explained_edges {
 public:
  Explained_edges(const Epick_domain& domain, const Small_angles& angles) : domain_(domain), angles_(angles) {
    shortest_at_.assign(domain.vertices.size(), std::numeric_limits<double>::infinity());
    tolerance_ = std::max(domain.tolerance, 1e-9 * domain.diagonal);
    for (std::size_t s = 0; s < domain.segments.size(); ++s) {
      const auto& ends = domain.segments[s].vertices;
      segment_items_.push_back(
          {Plain::Segment_3(plain(domain, ends[0]), plain(domain, ends[1])), std::uint32_t(s)});
      const double length = std::sqrt(segment_items_.back().shape.squared_length());
      farthest_protected_ = std::max(farthest_protected_, protected_at_segment * length);
      for (const Index v : ends) shortest_at_[v] = std::min(shortest_at_[v], length);
    }
    for (std::size_t v = 0; v < shortest_at_.size(); ++v)
      if (angles.vertex_deg[v] < class_bounds_deg.back() && std::isfinite(shortest_at_[v]))
        farthest_protected_ = std::max(farthest_protected_, protected_at_vertex * shortest_at_[v]);
    for (std::size_t f = 0; f < domain.facets.size(); ++f) {
      bends_.push_back(bend(domain, Index(f)));
      for (const auto& t : domain.facets[f].triangles)
        triangle_items_.push_back(
            {Plain::Triangle_3(plain(domain, t[0]), plain(domain, t[1]), plain(domain, t[2])),
             std::uint32_t(f)});
    }
    segments_.emplace(segment_items_.begin(), segment_items_.end());
    triangles_.emplace(triangle_items_.begin(), triangle_items_.end());
  }

  /// Whether p is within `reach` of what is protected around a small angle: the ball around a vertex, a quarter of the shortest
  /// segment there at most, which has no vertices inside, and pieces whose split point is within a thousandth of the length of the
  /// segment that it is at, which reach up to three times as far.
  bool protects(const P& p, double reach) const {
    const Plain::Point_3 at(p[0], p[1], p[2]);
    const double r = reach + farthest_protected_;
    std::vector<const Tagged<Plain::Segment_3>*> near;
    segments_->all_intersected_primitives(box_around(p, r), std::back_inserter(near));
    const auto is_near = [&](double degrees, double squared_distance, double length) {
      return degrees < class_bounds_deg.back() && std::sqrt(squared_distance) <= reach + length;
    };
    return std::ranges::any_of(near, [&](const auto* s) {
      const auto& segment = s->shape;
      if (is_near(angles_.segment_deg[s->tag], CGAL::squared_distance(at, segment),
                  protected_at_segment * std::sqrt(segment.squared_length())))
        return true;
      const auto& ends = domain_.segments[s->tag].vertices;
      return std::ranges::any_of(ends, [&](Index v) {
        return is_near(angles_.vertex_deg[v], CGAL::squared_distance(at, plain(domain_, v)), protected_at_vertex * shortest_at_[v]);
      });
    });
  }

  /// How far a facet at p is off its plane at most: closer than that, what is on it may lie on either side of others.
  double bend_at(const P& p) const {
    double result = 0;
    for (const Feature& f : features_at(p))
      if (f.dimension == 2) result = std::max(result, bends_[f.index]);
    return result;
  }

  /// The smallest angle, in degrees, that explains how close p and q are; `no_angle` if none does.
  double explanation(const P& p, const P& q) const {
    const std::vector<Feature> at_p = features_at(p), at_q = features_at(q);
    double smallest = no_angle;
    for (const Feature& a : at_p)
      for (const Feature& b : at_q) smallest = std::min(smallest, explanation(a, p, b, q));
    return smallest;
  }

 private:
  struct Feature {
    int dimension;
    std::uint32_t index;
  };

  static CGAL::Bbox_3 box_around(const P& p, double r) {
    return {p[0] - r, p[1] - r, p[2] - r, p[0] + r, p[1] + r, p[2] + r};
  }

  std::vector<Feature> features_at(const P& p) const {
    const CGAL::Bbox_3 box = box_around(p, tolerance_);
    std::vector<Feature> result;
    std::vector<const Tagged<Plain::Segment_3>*> on_segments;
    segments_->all_intersected_primitives(box, std::back_inserter(on_segments));
    for (const auto* s : on_segments) result.push_back({1, s->tag});
    std::vector<const Tagged<Plain::Triangle_3>*> on_triangles;
    triangles_->all_intersected_primitives(box, std::back_inserter(on_triangles));
    for (const auto* t : on_triangles) result.push_back({2, t->tag});
    return result;
  }

  double explanation(const Feature& a, const P& p, const Feature& b, const P& q) const {
    if (a.dimension == b.dimension && a.index == b.index) return no_angle;
    const auto& facets = domain_.facets;
    const auto bounds = [&](const Feature& s, const Feature& f) {
      return s.dimension == 1 && f.dimension == 2 &&
             std::ranges::binary_search(facets[f.index].segments, s.index);
    };
    if (bounds(a, b) || bounds(b, a)) return no_angle;
    const double length = std::sqrt(squared_distance(p, q));
    double smallest = no_angle;
    const auto consider = [&](double degrees, double squared_distance) {
      if (degrees < class_bounds_deg.back() && length * (1 + 1e-6) >= degrees * std::numbers::pi / 360 * std::sqrt(squared_distance))
        smallest = std::min(smallest, degrees);
    };
    for (const Index v : vertices_of(a))
      if (std::ranges::binary_search(vertices_of(b), v)) {
        const auto& o = domain_.vertices[v];
        const P corner{o.x(), o.y(), o.z()};
        consider(angles_.vertex_deg[v], std::min(squared_distance(p, corner), squared_distance(q, corner)));
      }
    if (a.dimension == 1 || b.dimension == 1) return smallest;
    for (const Index s : facets[a.index].segments)
      if (std::ranges::binary_search(facets[b.index].segments, s)) {
        const auto distance = [&](const P& x) {
          return CGAL::squared_distance(Plain::Point_3(x[0], x[1], x[2]), segment_items_[s].shape);
        };
        consider(angles_.segment_deg[s], std::min(distance(p), distance(q)));
      }
    return smallest;
  }

  /// Ascending.
  std::vector<Index> vertices_of(const Feature& f) const {
    if (f.dimension == 2) return domain_.facets[f.index].vertices;
    const auto& ends = domain_.segments[f.index].vertices;
    return {ends[0], ends[1]};
  }

  const Epick_domain& domain_;
  const Small_angles& angles_;
  static constexpr double protected_at_vertex = 0.25, protected_at_segment = 3 * 1e-3;
  double tolerance_ = 0;
  double farthest_protected_ = 0;  ///< from any small angle
  std::vector<double> shortest_at_;
  std::vector<double> bends_;  ///< of facets
  std::vector<Tagged<Plain::Segment_3>> segment_items_;
  std::vector<Tagged<Plain::Triangle_3>> triangle_items_;
  std::optional<Aabb_tree<Plain::Segment_3>> segments_;
  std::optional<Aabb_tree<Plain::Triangle_3>> triangles_;
};

/// The ends of the shortest edge of a tetrahedron.
std::array<P, 2> shortest_edge(const std::array<P, 4>& corners) {
  std::array<P, 2> shortest{corners[0], corners[1]};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      if (squared_distance(corners[i], corners[j]) < squared_distance(shortest[0], shortest[1]))
        shortest = {corners[i], corners[j]};
  return shortest;
}

/// In circumradii, how far from an angle what is forbidden there may keep a tetrahedron poor. Measured, of 26,332 such tetrahedra on
/// 25 models: 64 % are within 1, 90 % within 2, 97.5 % within 3, all within 4.
constexpr double reach = 4;

}  // namespace

struct Small_angle_rule::Parts {
  explicit Parts(const Epick_domain& domain)
      : angles(small_angles_3(domain)), sharp(sharp_features(domain, angles)), edges(domain, angles) {}

  /// How far the nearest small angle is from the corners and the centroid, and its class.
  std::pair<double, std::size_t> nearest_angle(const std::array<P, 4>& corners) const {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t nearest_class = class_bounds_deg.size();
    P centroid{0, 0, 0};
    for (const P& p : corners)
      for (std::size_t k = 0; k < 3; ++k) centroid[k] += p[k] / 4;
    for (std::size_t k = 0; k < sharp->size(); ++k) {
      if ((*sharp)[k].size() == 0) continue;
      const auto consider = [&](const P& p) {
        const double distance = (*sharp)[k].squared_distance(Plain::Point_3(p[0], p[1], p[2]));
        if (distance < nearest) nearest = distance, nearest_class = k;
      };
      consider(centroid);
      std::ranges::for_each(corners, consider);
    }
    return {std::sqrt(nearest), nearest_class};
  }

  Small_angles angles;
  std::unique_ptr<Sharp_classes> sharp;
  Explained_edges edges;
};

Small_angle_rule::Small_angle_rule(const Epick_domain& domain) : parts_(std::make_unique<Parts>(domain)) {}
Small_angle_rule::~Small_angle_rule() = default;

Small_angle_rule::Verdict Small_angle_rule::operator()(const std::array<P, 4>& corners, double circumradius) const {
  const auto [p, q] = shortest_edge(corners);
  if (const double degrees = parts_->edges.explanation(p, q); degrees < no_angle) return {Case::edge, class_of(degrees)};
  const double within = reach * circumradius;
  if (const auto [distance, angle] = parts_->nearest_angle(corners); distance <= within) return {Case::near, angle};
  if (std::ranges::any_of(corners, [&](const P& corner) { return parts_->edges.protects(corner, within); })) return {Case::protected_place};
  const double shortest = std::sqrt(squared_distance(p, q));
  if (std::ranges::any_of(corners, [&](const P& corner) { return parts_->edges.bend_at(corner) > shortest; })) return {Case::bent_facet};
  return {};
}

bool Excused::add(const Small_angle_rule::Verdict& verdict) {
  using Case = Small_angle_rule::Case;
  if (verdict.excuse == Case::edge) ++between_[verdict.angle];
  if (verdict.excuse == Case::near) ++near_[verdict.angle];
  if (verdict.excuse == Case::protected_place) ++at_protected_;
  if (verdict.excuse == Case::bent_facet) ++at_bent_;
  return verdict.excuse != Case::unexcused;
}

std::string Excused::figures() const {
  const auto by_class = [](const auto& counts) {
    std::string result;
    for (std::size_t k = 0; k < counts.size(); ++k) result += text(k > 0 ? ", " : " ", class_names[k], ": ", counts[k]);
    return result;
  };
  return text("; shortest edge between what meets at an angle", by_class(between_), "; next to an angle", by_class(near_),
              at_protected_ > 0 ? text("; next to what is protected: ", at_protected_) : "",
              at_bent_ > 0 ? text("; shorter than a facet is bent: ", at_bent_) : "");
}

}  // namespace pgdr::quality_detail
