// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/simplify/planarize.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <pgdr/domain/input_error.h>
#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/plc_from_domain_3.h>
#include <pgdr/domain/validate_domain_3.h>

#include "dihedral_guard.h"
#include "planarizer.h"
#include "remove_vertices.h"

namespace pgdr {

namespace {

using simplify_detail::is_wide;
using simplify_detail::Planarizer;
using Domain = Planarizer::Domain;

/// Of the tolerance: what makes a facet plane may not bring its vertices as close to each other as that.
constexpr double lowest = 1.0 / 64;
/// How often facets that would intersect others are given up.
constexpr int most_rounds = 8;

/// Sets a facet's group, unless it is to be fused with none.
void set_group(Plc_facet<Default_kernel>& facet, Index group) {
  if (facet.group != fused_with_none) facet.group = group;
}

/// `plc` with its facets grouped as they are fused in `domain`, which was made from it: where vertices move, others might be fused the next time.
Plc grouped(Plc plc, const Domain& domain) {
  for (std::size_t f = 0; f < domain.facets.size(); ++f)
    for (const Index i : domain.facets[f].input_facets) set_group(plc.facets[i], static_cast<Index>(f + 1));
  return plc;
}

/// With facets to be fused with whatever lies in their planes.
Plc ungrouped(Plc plc) {
  for (auto& facet : plc.facets) set_group(facet, 0);
  return plc;
}

/// `plc`, which `domain` was made from, with the domain's vertices at `points`.
Plc moved(const Plc& plc, const Domain& domain, const std::vector<Vec_3>& points) {
  std::vector<Vec_3> before;
  for (const auto& p : plc.vertices) before.push_back(to_vec(p));
  const std::vector<Index> first = domain_detail::first_equal_vertex(before, std::vector<char>(before.size(), 0));
  Plc result = plc;
  for (std::size_t v = 0; v < points.size(); ++v)
    result.vertices[domain.input_vertex[v]] = {points[v].x, points[v].y, points[v].z};
  for (std::size_t v = 0; v < first.size(); ++v) result.vertices[v] = result.vertices[first[v]];
  return result;
}

/// Plane facets as triangles, which stay plane when their vertices are moved apart, and have no holes any more; those with segments inside stay as they are.
std::vector<Plc_facet<Default_kernel>> as_triangles(const Plc& plc, const std::vector<Plc_facet<Default_kernel>>& facets, double coplanar_tolerance) {
  Plc alone;
  alone.vertices = plc.vertices;
  alone.facets = facets;
  for (auto& facet : alone.facets) facet.group = fused_with_none;
  const Domain domain = make_domain_3(alone, coplanar_tolerance, false);
  std::vector<Plc_facet<Default_kernel>> result;
  for (const auto& facet : domain.facets) {
    const auto& from = facets[facet.input_facets[0]];
    if (std::ranges::any_of(from.polygons, [](const auto& polygon) { return polygon.size() == 2; })) {
      result.push_back(from);
      continue;
    }
    for (const auto& t : facet.triangles)
      result.push_back({{{domain.input_vertex[t[0]], domain.input_vertex[t[1]], domain.input_vertex[t[2]]}}, {}, from.marker, from.group});
  }
  return result;
}

/// `plc`, which `domain` was made from, without some of the domain's vertices inside its plane facets: those get other triangles.
Plc without_vertices(Plc plc, const Domain& domain, const std::vector<bool>& goes) {
  std::vector<Vec_3> points;
  for (const auto& p : domain.vertices) points.push_back(to_vec(p));
  std::vector<bool> facet_goes(plc.facets.size(), false);
  std::vector<Plc_facet<Default_kernel>> new_facets;
  for (std::size_t f = 0; f < domain.facets.size(); ++f) {
    const auto& facet = domain.facets[f];
    if (std::none_of(facet.vertices.begin(), facet.vertices.end(), [&](Index v) { return goes[v]; })) continue;
    for (const Index i : facet.input_facets) facet_goes[i] = true;
    new_facets.push_back(domain_detail::facet_polygons(domain, f, points));
    new_facets.back().group = plc.facets[facet.input_facets[0]].group;
    std::erase_if(new_facets.back().polygons, [&](const auto& polygon) { return polygon.size() == 1 && goes[polygon[0]]; });
    for (auto& polygon : new_facets.back().polygons)
      for (Index& v : polygon) v = domain.input_vertex[v];
  }
  std::size_t left = 0;
  for (std::size_t i = 0; i < facet_goes.size(); ++i)
    if (!facet_goes[i]) std::swap(plc.facets[left++], plc.facets[i]);
  plc.facets.resize(left);
  new_facets = as_triangles(plc, new_facets, domain.tolerance / domain.diagonal);
  plc.facets.insert(plc.facets.end(), new_facets.begin(), new_facets.end());

  std::vector<bool> vertex_goes(plc.vertices.size(), false);
  for (std::size_t v = 0; v < goes.size(); ++v)
    if (goes[v]) vertex_goes[domain.input_vertex[v]] = true;
  simplify_detail::remove_vertices(plc, vertex_goes);
  return plc;
}

/// What is too close to the rest of its facet.
struct Low_corners {
  std::vector<bool> inside;   ///< vertices that no segment ends at, of plane facets: no feature, they may go
  std::vector<Index> facets;  ///< input facets of those with others, ascending
  bool some_inside() const { return std::ranges::find(inside, true) != inside.end(); }
};

/// Corners of triangles that are lower than `height`; those that segments end at only if they have been twice as high in the input: there a
/// needle stood upright on its facet, and has fallen over.
Low_corners low_corners(const Domain& domain, const Plc& input, double height) {
  Low_corners low{std::vector<bool>(domain.vertices.size(), true), {}};
  for (const auto& s : domain.segments)
    for (const Index v : s.vertices) low.inside[v] = false;
  std::vector<Vec_3> points;
  for (const auto& p : domain.vertices) points.push_back(to_vec(p));
  for (const auto& f : domain.facets)
    if (!simplify_detail::is_plane(f.vertices, points, domain.diagonal))
      for (const Index v : f.vertices) low.inside[v] = false;
  for (Index v = 0; v < domain.vertex_markers.size(); ++v)
    if (domain.vertex_markers[v] != 0) low.inside[v] = false;
  std::vector<bool> is_low(domain.vertices.size(), false);
  const auto now = [&](Index v) { return points[v]; };
  const auto before = [&](Index v) { return to_vec(input.vertices[domain.input_vertex[v]]); };
  for (const auto& f : domain.facets)
    for (const auto& t : f.triangles)
      for (int i = 0; i < 3; ++i) {
        const Index p = t[i], a = t[(i + 1) % 3], b = t[(i + 2) % 3];
        const double squared_height = squared_distance_to_line(now(p), now(a), now(b));
        if (squared_height >= height * height) continue;
        is_low[p] = true;
        const bool is_above_edge = dot(now(p) - now(a), now(b) - now(a)) > 0 && dot(now(p) - now(b), now(a) - now(b)) > 0;
        if (is_above_edge && !low.inside[p] && squared_height < squared_distance_to_line(before(p), before(a), before(b)) / 4)
          low.facets.insert(low.facets.end(), f.input_facets.begin(), f.input_facets.end());
      }
  for (std::size_t v = 0; v < is_low.size(); ++v)
    if (!is_low[v]) low.inside[v] = false;
  domain_detail::sort_unique(low.facets);
  return low;
}

/// What one fusing comes to.
struct Flattened {
  Plc plc;
  Planarization done;
  bool is_final;  ///< no other triangles are fused the next time
  Planarized known;  ///< of `plc`
};

/// A PLC, whose domain is `known`, without its low vertices that may go, where it has some.
Flattened without_low_vertices(Plc plc, Planarized known, const Low_corners& low, const Planarization& done, bool is_final) {
  if (low.some_inside()) return {without_vertices(std::move(plc), *known.domain, low.inside), done, true, {}};
  return {std::move(plc), done, is_final, std::move(known)};
}

/// Makes the facets plane that are fused now; none where that is not valid, whatever is given up.
/// \param plc with facets that are not grouped
/// \param input where the vertices have been before anything was moved
/// \param is_guarded whether facets may not fall onto each other
std::optional<Flattened> flattened(Plc plc, const Plc& input, double coplanar_tolerance, bool triangulate, bool is_guarded) {
  Domain domain = make_domain_3(plc, coplanar_tolerance, triangulate);
  plc = grouped(std::move(plc), domain);
  Planarizer planarizer(domain, input);
  std::optional<simplify_detail::Dihedral_guard> guard;  // made when the first vertex is about to move
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<Vec_3> points = planarizer.solution();
    if (planarizer.is_at(points)) {
      Planarization done = planarizer.report(points);
      if (done.is_none()) return Flattened{ungrouped(std::move(plc)), done, true, {std::move(domain), std::nullopt}};
      const Low_corners low = low_corners(domain, input, lowest * domain.tolerance);
      return without_low_vertices(std::move(plc), {std::move(domain), std::nullopt}, low, done, true);
    }
    if (!guard && is_guarded) guard.emplace(domain);
    Plc result = moved(plc, domain, points);
    std::vector<Index> concerned;
    try {
      Domain plane = make_domain_3(result, coplanar_tolerance, triangulate);
      const Low_corners low = low_corners(plane, input, lowest * plane.tolerance);
      concerned = low.facets;
      if (guard) guard->add_sharpened(plane, concerned);
      std::vector<Input_problem> problems = validate_domain_3(plane, input.facets.size());
      for (const Input_problem& problem : problems) {
        // Where nothing has moved that stays, whatever else is given up: dirty files have thousands of these.
        if (!problem.facets.empty() && planarizer.leaves(problem.facets, points)) return std::nullopt;
        concerned.insert(concerned.end(), problem.facets.begin(), problem.facets.end());
      }
      if (concerned.empty()) return without_low_vertices(std::move(result), {std::move(plane), std::move(problems)}, low, planarizer.report(points), false);
    } catch (const Input_error& error) {
      for (const Input_problem& problem : error.problems())
        concerned.insert(concerned.end(), problem.facets.begin(), problem.facets.end());
      if (concerned.empty()) break;
    }
    planarizer.give_up(concerned);
  }
  return std::nullopt;
}

}  // namespace

Plc planarize(const Plc& plc, double coplanar_tolerance, bool triangulate, Planarization* done, Planarized* result, int fusings) {
  if (exponent_for(plc) != 0) return planarize(normalized(plc), coplanar_tolerance, triangulate, done, result, fusings);
  Flattened best{ungrouped(plc), {}, false, {}};
  for (int fusing = 0; fusing < fusings && !best.is_final; ++fusing) {
    std::optional<Flattened> next = flattened(ungrouped(best.plc), plc, coplanar_tolerance, triangulate, true);
    // As fused, facets may intersect that do not once they are plane: within noise, a small angle is better than none.
    if (!next && fusing == 0 && !is_wide(coplanar_tolerance, 1)) next = flattened(best.plc, plc, coplanar_tolerance, triangulate, false);
    if (!next) break;
    best = std::move(*next);
  }
  if (done && !best.done.is_none()) *done = best.done;
  if (result) *result = std::move(best.known);
  return std::move(best.plc);
}

}  // namespace pgdr
