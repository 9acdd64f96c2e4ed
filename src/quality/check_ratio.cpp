// SPDX-License-Identifier: GPL-3.0-or-later
// The radius-edge bound, and what excuses a tetrahedron from it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>

#include <pgdr/domain/small_angles_3.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_reduce.h>
#include <pgdr/quality/measures.h>

#include "aabb_tree.h"
#include "check_parts.h"

namespace pgdr::quality_detail {

namespace {

constexpr std::array<double, 3> class_bounds_deg{Small_angles::critical_plane_angle_deg, 30, 60};
constexpr std::array<const char*, 3> class_names{"< 14.48", "< 30", "< 60"};

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

std::unique_ptr<Sharp_classes> sharp_features(const Epick_domain& domain) {
  auto classes = std::make_unique<Sharp_classes>();
  const auto class_of = [](double deg) {
    return std::size_t(std::upper_bound(class_bounds_deg.begin(), class_bounds_deg.end(), deg) -
                       class_bounds_deg.begin());
  };
  const auto plain = [&](Index v) {
    const auto& p = domain.vertices[v];
    return Plain::Point_3(p.x(), p.y(), p.z());
  };
  const Small_angles angles = small_angles_3(domain);
  for (std::size_t v = 0; v < angles.vertex_deg.size(); ++v)
    if (const std::size_t c = class_of(angles.vertex_deg[v]); c < classes->size())
      (*classes)[c].add(plain(Index(v)));
  for (std::size_t s = 0; s < angles.segment_deg.size(); ++s)
    if (const std::size_t c = class_of(angles.segment_deg[s]); c < classes->size())
      (*classes)[c].add(plain(domain.segments[s].vertices[0]), plain(domain.segments[s].vertices[1]));
  for (auto& c : *classes) c.build();
  return classes;
}

/// Squares of the circumradius and of the shortest edge of tetrahedron i.
std::pair<double, double> squared_radius_and_edge(const Indexed_mesh_3& mesh, std::size_t i) {
  const auto& t = mesh.tetrahedra[i];
  const P &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]], &d = mesh.points[t[3]];
  return {squared_circumradius(a, b, c, d), squared_shortest_edge(a, b, c, d)};
}

}  // namespace

Check_line check_ratio(const Indexed_mesh_3& mesh, const Epick_domain* domain, double bound) {
  const double limit = bound * bound * (1 + 2e-9);
  Failures failures;
  std::array<std::size_t, class_bounds_deg.size()> excused{};
  std::unique_ptr<Sharp_classes> sharp;
  struct Found {
    double worst = 0;
    std::vector<std::size_t> over;
  };
  const Found found = parallel_reduce(
      mesh.tetrahedra.size(), default_grain, Found{},
      [&](std::size_t first, std::size_t last) {
        Found part;
        for (std::size_t i = first; i < last; ++i) {
          const auto [rr, ll] = squared_radius_and_edge(mesh, i);
          part.worst = std::max(part.worst, rr / ll);
          if (!(rr <= limit * ll)) part.over.push_back(i);
        }
        return part;
      },
      [](Found& all, const Found& part) {
        all.worst = std::max(all.worst, part.worst);
        all.over.insert(all.over.end(), part.over.begin(), part.over.end());
      });
  for (const std::size_t i : found.over) {
    const auto& t = mesh.tetrahedra[i];
    const P &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]], &d = mesh.points[t[3]];
    const auto [rr, ll] = squared_radius_and_edge(mesh, i);
    if (domain != nullptr && !sharp) sharp = sharp_features(*domain);
    std::size_t nearest_class = class_bounds_deg.size();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; sharp && k < sharp->size(); ++k) {
      if ((*sharp)[k].size() == 0) continue;
      double distance = std::numeric_limits<double>::infinity();
      for (const P& p : {a, b, c, d,
                         P{(a[0] + b[0] + c[0] + d[0]) / 4, (a[1] + b[1] + c[1] + d[1]) / 4,
                           (a[2] + b[2] + c[2] + d[2]) / 4}})
        distance = std::min(distance, (*sharp)[k].squared_distance(Plain::Point_3(p[0], p[1], p[2])));
      if (distance < nearest) nearest = distance, nearest_class = k;
    }
    if (nearest_class < excused.size() && nearest <= 16 * rr)
      ++excused[nearest_class];
    else
      failures.add("tetrahedron ", i, " has ratio ", std::sqrt(rr / ll), " and no small angle nearby");
  }
  std::string figures =
      text("worst ", std::sqrt(found.worst), ", bound ", bound, ", ", found.over.size(), " tetrahedra over it");
  if (domain != nullptr) {
    figures += "; near angles";
    for (std::size_t k = 0; k < excused.size(); ++k)
      figures += text(k > 0 ? ", " : " ", class_names[k], ": ", excused[k]);
  }
  return failures.line("ratio", figures);
}

}  // namespace pgdr::quality_detail
