// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/repair/degenerate_facets.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/vec_3.h>

namespace pgdr {

namespace {

using domain_detail::Index_pair;
using domain_detail::sorted_pair;
using Polygon = std::vector<Index>;

/// What lies on some edges, by the ends of each.
using On_edges = std::map<Index_pair, std::vector<Index>>;

/// Whether all corners are on one line.
bool is_degenerate(const Plc_facet<Default_kernel>& facet, const Plc& plc) {
  if (facet.polygons.size() != 1 || facet.polygons[0].size() < 3 || !facet.holes.empty()) return false;
  const Polygon& polygon = facet.polygons[0];
  const auto point = [&](Index v) { return plc.vertices[v]; };
  const auto [a, b] = std::ranges::minmax(polygon, {}, point);
  return std::ranges::all_of(polygon, [&, a = a, b = b](Index v) { return v == a || v == b || CGAL::collinear(point(a), point(b), point(v)); });
}

/// Polygons that are divided where others have vertices.
class Collinear_loops {
 public:
  explicit Collinear_loops(const Plc& plc) {
    for (const auto& p : plc.vertices) points_.push_back(to_vec(p));
    first_ = domain_detail::first_equal_vertex(points_, std::vector<char>(points_.size(), 0));
  }

  /// Adds what lies inside the edges of a degenerate polygon of its own corners.
  void add_on_edges(const Polygon& polygon, On_edges& on) const {
    for_each_edge(polygon, [&](Index a, Index b) {
      for (const Index v : polygon)
        if (is_between(v, a, b)) on[ends(a, b)].push_back(first_[v]);
    });
  }

  /// \param on distinct, from the lower to the upper end of each edge
  void divide(Polygon& polygon, const On_edges& on) const {
    Polygon divided;
    for_each_edge(polygon, [&](Index a, Index b) {
      divided.push_back(a);
      const auto found = on.find(ends(a, b));
      if (found == on.end()) return;
      divided.insert(divided.end(), found->second.begin(), found->second.end());
      if (key(b) < key(a)) std::reverse(divided.end() - static_cast<std::ptrdiff_t>(found->second.size()), divided.end());
    });
    if (divided.size() > polygon.size()) polygon = std::move(divided);
  }

  void sort(std::vector<Index>& vertices) const {
    std::ranges::sort(vertices, {}, [&](Index v) { return key(v); });
    const auto rest = std::ranges::unique(vertices);
    vertices.erase(rest.begin(), rest.end());
  }

 private:
  std::array<double, 3> key(Index v) const { return domain_detail::to_array(points_[v]); }

  Index_pair ends(Index a, Index b) const { return sorted_pair(first_[a], first_[b]); }

  /// Of points on a line, whose lexicographic order is that along the line.
  bool is_between(Index v, Index a, Index b) const { return std::min(key(a), key(b)) < key(v) && key(v) < std::max(key(a), key(b)); }

  template <class F>
  static void for_each_edge(const Polygon& polygon, F f) {
    for (std::size_t i = 0; i < polygon.size(); ++i) f(polygon[i], polygon[(i + 1) % polygon.size()]);
  }

  std::vector<Vec_3> points_;
  std::vector<Index> first_;  ///< of equal vertices
};

}  // namespace

std::size_t take_degenerate_facets_away(Plc& plc) {
  if (!domain_detail::unusable_input(plc).empty()) return 0;  // make_domain_3 says what is wrong
  std::vector<std::vector<Polygon>*> degenerate;
  for (auto& facet : plc.facets)
    if (is_degenerate(facet, plc)) degenerate.push_back(&facet.polygons);
  if (degenerate.empty()) return 0;
  const Collinear_loops loops(plc);
  for (;;) {
    On_edges on;
    for (const auto* polygons : degenerate) loops.add_on_edges(polygons->front(), on);
    if (on.empty()) break;
    for (auto& [edge, vertices] : on) loops.sort(vertices);
    for (auto& facet : plc.facets)
      for (auto& polygon : facet.polygons)
        if (polygon.size() >= 3) loops.divide(polygon, on);
  }
  for (auto* polygons : degenerate) polygons->clear();
  return degenerate.size();
}

}  // namespace pgdr
