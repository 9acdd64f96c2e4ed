// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/property_map.h>

#include <pgdr/domain/detail/facet_edges.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/quality/exempt_angles.h>

#include "aabb_tree.h"

namespace pgdr {

namespace {

using Domain = Domain_3<Default_kernel>;
using quality_detail::Plain;

constexpr double limit_deg = 60;

/// A small angle at a vertex or, `is_segment`, along a segment.
struct Place {
  bool is_segment;
  Index index;
  auto operator<=>(const Place&) const = default;
};

/// Finds the small angle that is nearest to a point.
class Nearest_angle {
  using Vertex = std::pair<Plain::Point_3, Index>;
  using Search = CGAL::Orthogonal_k_neighbor_search<
      CGAL::Search_traits_adapter<Vertex, CGAL::First_of_pair_property_map<Vertex>, CGAL::Search_traits_3<Plain>>>;

 public:
  Nearest_angle(const Domain& domain, const Small_angles& angles) {
    const auto point = [&](Index v) {
      const Vec_3 p = to_vec(domain.vertices[v]);
      return Plain::Point_3(p.x, p.y, p.z);
    };
    for (Index v = 0; v < domain.vertices.size(); ++v)
      if (angles.vertex_deg[v] < limit_deg) vertices_.insert({point(v), v});
    for (Index s = 0; s < domain.segments.size(); ++s)
      if (const auto [a, b] = domain.segments[s].vertices; angles.segment_deg[s] < limit_deg)
        items_.push_back({Plain::Segment_3(point(a), point(b)), s});
    if (vertices_.size() > 0) vertices_.build();
    segments_.insert(items_.begin(), items_.end());
    segments_.build();
  }

  bool empty() const { return vertices_.size() == 0 && items_.empty(); }

  /// The place with its squared distance; of a segment and its end, the end. \pre there is one
  std::pair<double, Place> operator()(const Plain::Point_3& p) const {
    std::pair<double, Place> nearest{std::numeric_limits<double>::infinity(), {}};
    if (!items_.empty()) {
      const auto [q, item] = segments_.closest_point_and_primitive(p);
      nearest = {CGAL::squared_distance(p, q), {true, item->tag}};
    }
    if (vertices_.size() > 0) {
      const auto found = *Search(vertices_, p, 1).begin();
      if (found.second <= nearest.first) nearest = {found.second, {false, found.first.second}};
    }
    return nearest;
  }

 private:
  Search::Tree vertices_;
  std::vector<quality_detail::Tagged<Plain::Segment_3>> items_;
  quality_detail::Aabb_tree<Plain::Segment_3> segments_;
};

/// Names what meets in a small angle.
class Angle_names {
 public:
  explicit Angle_names(const Domain& domain) : domain_(domain), write_(domain), edges_(domain), features_(domain) {}

  /// What meets at the smallest angle of a place.
  std::string operator()(const Place& place) const { return place.is_segment ? at_segment(place.index) : at_vertex(place.index); }

 private:
  std::string at_segment(Index s) const {
    using namespace domain_detail;
    const auto [a, b] = domain_.segments[s].vertices;
    const Vec_3 axis = vector(a, b);
    const auto sheets = edges_.sheets(s);
    double smallest = std::numeric_limits<double>::infinity();
    std::string names;
    for (std::size_t i = 0; i < sheets.size(); ++i)
      for (std::size_t j = i + 1; j < sheets.size(); ++j) {
        const double degrees = angle_deg(inward(domain_, sheets[i], axis), inward(domain_, sheets[j], axis));
        if (degrees >= smallest) continue;
        smallest = degrees;
        names = "facets " + write_.facet_number(sheets[i].facet) + " and " + write_.facet_number(sheets[j].facet);
      }
    return names;
  }

  std::string at_vertex(Index v) const {
    using namespace domain_detail;
    double smallest = std::numeric_limits<double>::infinity();
    std::string names;
    const auto segments = features_.segments(v);
    const auto other_end = [&](Index s) {
      const auto& ends = domain_.segments[s].vertices;
      return ends[0] == v ? ends[1] : ends[0];
    };
    const auto keep = [&](double degrees, Index s, const std::string& other) {
      if (degrees >= smallest) return;
      smallest = degrees;
      names = "the segment from vertex " + write_.vertex_number(v) + " to " + write_.vertex_number(other_end(s)) + " and " + other;
    };
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const Vec_3 d = vector(v, other_end(segments[i]));
      for (std::size_t j = i + 1; j < segments.size(); ++j)
        keep(angle_deg(d, vector(v, other_end(segments[j]))), segments[i], "the one to " + write_.vertex_number(other_end(segments[j])));
      for (const auto& [facet, triangle] : features_.triangles(v)) {
        if (std::ranges::binary_search(domain_.segments[segments[i]].facets, facet)) continue;
        const auto& t = domain_.facets[facet].triangles[triangle];
        const std::size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        keep(angle_to_sector_deg(d, vector(v, t[(k + 1) % 3]), vector(v, t[(k + 2) % 3])), segments[i], write_.facet_name(facet));
      }
    }
    return names;
  }

  Vec_3 vector(Index a, Index b) const { return to_vec(domain_.vertices[b]) - to_vec(domain_.vertices[a]); }

  const Domain& domain_;
  domain_detail::Problem_writer<Default_kernel> write_;
  domain_detail::Facet_edges edges_;
  domain_detail::Vertex_features features_;
};

}  // namespace

std::vector<Exempt_angle> exempt_angles(const Indexed_mesh_3& mesh, const Domain& domain) {
  if (mesh.exempt.empty()) return {};
  const Small_angles angles = small_angles_3(domain);
  const Nearest_angle nearest(domain, angles);
  if (nearest.empty()) return {};
  std::map<Place, std::size_t> count;
  for (const std::uint32_t t : mesh.exempt) {
    std::pair<double, Place> best{std::numeric_limits<double>::infinity(), {}};
    for (const auto v : mesh.tetrahedra[t]) {
      const auto& p = mesh.points[v];
      best = std::min(best, nearest(Plain::Point_3(p[0], p[1], p[2])));
    }
    ++count[best.second];
  }
  std::vector<std::pair<std::size_t, Place>> order;
  for (const auto& [place, n] : count) order.emplace_back(n, place);
  std::ranges::stable_sort(order, std::ranges::greater{}, [](const auto& o) { return o.first; });
  const Angle_names names(domain);
  std::vector<Exempt_angle> result;
  for (const auto& [n, place] : order)
    result.push_back({(place.is_segment ? angles.segment_deg : angles.vertex_deg)[place.index], names(place), n});
  return result;
}

}  // namespace pgdr
