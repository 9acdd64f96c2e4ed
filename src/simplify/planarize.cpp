// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/simplify/planarize.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <pgdr/domain/input_error.h>
#include <pgdr/domain/make_domain_3.h>
#include <pgdr/domain/plc_from_domain_3.h>
#include <pgdr/domain/validate_domain_3.h>

#include "dihedral_guard.h"
#include "plane_system.h"
#include "remove_vertices.h"

namespace pgdr {

namespace {

using Domain = Domain_3<Default_kernel>;

/// In units of the bounding box's diagonal: a facet that is bent by less is as plane as the points that refinement puts on it.
constexpr double bent = 1e-13;
/// What a solution may leave; above that the facet has none.
constexpr double unsolved = 1e-10;
/// Of the tolerance: what makes a facet plane may not bring its vertices as close to each other as that.
constexpr double lowest = 1.0 / 64;
/// How much farther vertices may move along their facets than away from them.
constexpr double sideways = 16;
/// Where vertices move too far, one facet of each that moves at least half as far as the farthest is given up: mostly the others are only its
/// neighbors. After this many rounds, all of them.
constexpr int careful_rounds = 16;
/// Of the diagonal: what files of single precision are off by, with room to spare.
constexpr double noise = 1e-6;
/// Of Newton's method: three reach double precision from a thousandth of the size of a facet.
constexpr int most_steps = 8, rough_steps = 2;
/// How often triangles are fused: others may lie within the tolerance of one plane once their vertices have moved. Once is enough for planes, but leaves
/// needles beside them (a30: 49,326 exempt tetrahedra instead of 5,244; a29 has 3 % more of all). Not until there are no others, since a smooth surface
/// would become ever larger facets.
constexpr int fusings = 2;
/// How often facets that would intersect others are given up.
constexpr int most_rounds = 8;

/// Whether more than noise is made plane.
bool is_wide(double tolerance, double diagonal) { return tolerance > 2 * noise * diagonal; }

class Planarizer {
 public:
  /// \param input where the vertices have been before anything was moved: what limits count from there
  Planarizer(const Domain& domain, const Plc& input) : domain_(domain), is_on_(domain.facets.size(), false) {
    for (const auto& p : domain.vertices) points_.push_back(to_vec(p));
    for (const Index v : domain.input_vertex) input_.push_back(to_vec(input.vertices[v]));
    for (Index f = 0; f < domain.facets.size(); ++f) {
      facets_.push_back(domain.facets[f].vertices);
      for (const Index i : domain.facets[f].input_facets) {
        if (i >= facet_of_input_.size()) facet_of_input_.resize(i + 1);
        facet_of_input_[i] = f;
      }
    }
    choose_facets();
  }

  /// Whether these are where the vertices of the domain are.
  bool is_at(const std::vector<Vec_3>& points) const {
    return std::equal(points.begin(), points.end(), points_.begin(),
                      [](const Vec_3& a, const Vec_3& b) { return squared_distance(a, b) == 0; });
  }

  /// Where the points should be.
  std::vector<Vec_3> solution() {
    const Plane_system system(facets_, fixed_, bent * domain_.diagonal);
    // Who moves too far is seen after a step or two. With the tolerance of noise there are few rounds, and the result stays what it always was.
    for (int round = 0; is_wide(domain_.tolerance, domain_.diagonal) && round < careful_rounds; ++round)
      if (!give_up_what_is_far(solve(system, rough_steps), true, false)) break;
    for (int round = 0;; ++round) {
      std::vector<Vec_3> points = solve(system, most_steps);
      if (!give_up_what_is_far(points, round < careful_rounds, true)) return points;
    }
  }

  /// For the next solution, nothing is asked of the facets that these input facets are part of; the second time, of those around them neither.
  void give_up(const std::vector<Index>& input_facets) {
    std::vector<bool> is_concerned(facets_.size(), false), is_near(points_.size(), false);
    for (const Index i : input_facets) is_concerned[facet_of_input_[i]] = true;
    for (Index f = 0; f < facets_.size(); ++f) {
      if (!is_concerned[f]) continue;
      if (!is_on_[f])
        for (const Index v : facets_[f]) is_near[v] = true;
      is_on_[f] = false;
    }
    for (Index f = 0; f < facets_.size(); ++f)
      if (std::any_of(facets_[f].begin(), facets_[f].end(), [&](Index v) { return is_near[v]; })) is_on_[f] = false;
  }

  Planarization report(const std::vector<Vec_3>& points) const {
    Planarization done;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      const double bend = Plane_system::bend(facets_[f], points);
      const bool is_bent = bend > bent * domain_.diagonal;
      const bool was_bent = Plane_system::bend(facets_[f], input_) > bent * domain_.diagonal;
      done.bent_facets += is_bent;
      done.flattened_facets += was_bent && !is_bent;
    }
    for (std::size_t v = 0; v < points.size(); ++v) done.moved_vertices += squared_distance(points[v], input_[v]) > 0;
    for (const auto& f : domain_.facets)
      for (const Index v : f.vertices) done.largest_change = std::max(done.largest_change, off_plane(f, v, points));
    done.largest_change *= unit_of(domain_);
    return done;
  }

 private:
  /// Those that hang together with one that is bent: no other can change.
  void choose_facets() {
    std::vector<std::vector<Index>> facets_of(points_.size());
    std::vector<Index> next;
    const auto choose = [&](Index f) {
      if (!is_on_[f]) next.push_back(f);
      is_on_[f] = true;
    };
    for (Index f = 0; f < facets_.size(); ++f) {
      if (facets_[f].size() < 4) continue;
      for (const Index v : facets_[f]) facets_of[v].push_back(f);
      if (Plane_system::bend(facets_[f], points_) > bent * domain_.diagonal) choose(f);
    }
    while (!next.empty()) {
      const Index f = next.back();
      next.pop_back();
      for (const Index v : facets_[f])
        for (const Index g : facets_of[v]) choose(g);
    }
  }

  /// Vertices of facets whose plane is axis-aligned go there first, and stay.
  void fix_axes() {
    start_ = points_;
    fixed_.assign(points_.size(), {});
    for (Index i = 0; i < facets_.size(); ++i) {
      if (!is_on_[i]) continue;
      const auto& facet = domain_.facets[i];
      for (int d = 0; d < 3; ++d) {
        if (std::abs(facet.normal[d]) != 1) continue;
        const double level = facet.origin[d];
        const bool is_free = std::all_of(facet.vertices.begin(), facet.vertices.end(),
                                         [&](Index v) { return !fixed_[v][d] || start_[v][d] == level; });
        if (!is_free) continue;
        for (const Index v : facet.vertices) {
          fixed_[v][d] = true;
          start_[v][d] = level;
        }
      }
    }
  }

  std::vector<Vec_3> solve(const Plane_system& system, int steps) {
    fix_axes();
    std::vector<Vec_3> points = start_;
    system.solve(points, is_on_, steps);
    return points;
  }

  double off_plane(const Domain::Facet& facet, Index v, const std::vector<Vec_3>& points) const {
    return std::abs(dot(to_vec(facet.normal), points[v] - input_[v]));
  }

  /// How far the vertices have moved, in units of what they may.
  std::vector<double> moves(const std::vector<Vec_3>& points) const {
    std::vector<double> result(points.size());
    for (Index v = 0; v < points.size(); ++v) result[v] = length(points[v] - input_[v]) / (sideways * domain_.tolerance);
    for (const auto& f : domain_.facets)
      for (const Index v : f.vertices) result[v] = std::max(result[v], off_plane(f, v, points) / domain_.tolerance);
    return result;
  }

  /// \return whether there is something to give up.
  bool give_up_what_is_far(const std::vector<Vec_3>& points, bool is_careful, bool is_solved) {
    const std::vector<double> moved = moves(points);
    const double too_far = std::max(1.0, is_careful ? *std::max_element(moved.begin(), moved.end()) / 2 : 0.0);
    // Of the facets at a vertex, the one that needs the fewest triangles if it is not fused.
    std::vector<Index> smallest(points.size(), static_cast<Index>(facets_.size()));
    for (Index f = 0; f < facets_.size(); ++f)
      if (is_on_[f])
        for (const Index v : facets_[f])
          if (smallest[v] == facets_.size() || facets_[f].size() < facets_[smallest[v]].size()) smallest[v] = f;
    bool some = false;
    for (Index f = 0; f < facets_.size(); ++f) {
      if (!is_on_[f]) continue;
      const bool is_far = std::any_of(facets_[f].begin(), facets_[f].end(),
                                      [&](Index v) { return moved[v] > too_far && (!is_careful || smallest[v] == f); });
      if (!is_far && (!is_solved || Plane_system::bend(facets_[f], points) <= unsolved * domain_.diagonal)) continue;
      is_on_[f] = false;
      some = true;
    }
    return some;
  }

  const Domain& domain_;
  std::vector<Vec_3> points_;  ///< as they are in the domain
  std::vector<Vec_3> input_;   ///< as they were before
  std::vector<Vec_3> start_;
  std::vector<std::vector<Index>> facets_;
  std::vector<Index> facet_of_input_;
  std::vector<Plane_system::Fixed_axes> fixed_;
  std::vector<bool> is_on_;
};

/// `plc` with its facets grouped as they are fused in `domain`, which was made from it: where vertices move, others might be fused the next time.
Plc grouped(Plc plc, const Domain& domain) {
  for (std::size_t f = 0; f < domain.facets.size(); ++f)
    for (const Index i : domain.facets[f].input_facets) plc.facets[i].group = static_cast<Index>(f + 1);
  return plc;
}

/// With facets to be fused with whatever lies in their planes.
Plc ungrouped(Plc plc) {
  for (auto& facet : plc.facets) facet.group = 0;
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

/// `plc`, which `domain` was made from, without some of the domain's vertices inside its facets: those facets become polygons.
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
  plc.facets.insert(plc.facets.end(), new_facets.begin(), new_facets.end());

  std::vector<bool> vertex_goes(plc.vertices.size(), false);
  for (std::size_t v = 0; v < goes.size(); ++v)
    if (goes[v]) vertex_goes[domain.input_vertex[v]] = true;
  simplify_detail::remove_vertices(plc, vertex_goes);
  return plc;
}

/// What is too close to the rest of its facet.
struct Low_corners {
  std::vector<bool> inside;    ///< vertices that no segment ends at: no feature, they may go
  std::vector<Index> facets;  ///< input facets of those with others, ascending
  bool some_inside() const { return std::ranges::find(inside, true) != inside.end(); }
};

/// Corners of triangles that are lower than `height`; those that segments end at only if they have been twice as high in the input: there a
/// needle stood upright on its facet, and has fallen over.
Low_corners low_corners(const Domain& domain, const Plc& input, double height) {
  Low_corners low{std::vector<bool>(domain.vertices.size(), true), {}};
  for (const auto& s : domain.segments)
    for (const Index v : s.vertices) low.inside[v] = false;
  for (Index v = 0; v < domain.vertex_markers.size(); ++v)
    if (domain.vertex_markers[v] != 0) low.inside[v] = false;
  std::vector<bool> is_low(domain.vertices.size(), false);
  const auto now = [&](Index v) { return to_vec(domain.vertices[v]); };
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

Plc without_low_vertices(Plc plc, const Domain& domain, const Low_corners& low) {
  return low.some_inside() ? without_vertices(std::move(plc), domain, low.inside) : plc;
}

/// What one fusing comes to.
struct Flattened {
  Plc plc;
  Planarization done;
  bool is_final;  ///< no other triangles are fused the next time
};

/// Makes the facets plane that are fused now; none where that is not valid, whatever is given up.
/// \param input where the vertices have been before anything was moved
/// \param is_guarded whether facets may not fall onto each other
std::optional<Flattened> flattened(Plc plc, const Plc& input, double coplanar_tolerance, bool triangulate, bool is_guarded) {
  const Domain domain = make_domain_3(plc, coplanar_tolerance, triangulate);
  plc = grouped(std::move(plc), domain);
  Planarizer planarizer(domain, input);
  std::optional<simplify_detail::Dihedral_guard> guard;  // made when the first vertex is about to move
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<Vec_3> points = planarizer.solution();
    if (planarizer.is_at(points)) {
      Planarization done = planarizer.report(points);
      if (done.is_none()) return Flattened{ungrouped(std::move(plc)), done, true};
      return Flattened{without_low_vertices(std::move(plc), domain, low_corners(domain, input, lowest * domain.tolerance)), done, true};
    }
    if (!guard && is_guarded) guard.emplace(domain);
    Plc result = moved(plc, domain, points);
    std::vector<Index> concerned;
    try {
      const Domain plane = make_domain_3(result, coplanar_tolerance, triangulate);
      const Low_corners low = low_corners(plane, input, lowest * plane.tolerance);
      concerned = low.facets;
      if (guard) guard->add_sharpened(plane, concerned);
      for (const Input_problem& problem : validate_domain_3(plane, input.facets.size()))
        concerned.insert(concerned.end(), problem.facets.begin(), problem.facets.end());
      if (concerned.empty()) return Flattened{without_low_vertices(std::move(result), plane, low), planarizer.report(points), low.some_inside()};
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

Plc planarize(const Plc& plc, double coplanar_tolerance, bool triangulate, Planarization* done) {
  if (exponent_for(plc) != 0) return planarize(normalized(plc), coplanar_tolerance, triangulate, done);
  Flattened best{ungrouped(plc), {}, false};
  for (int fusing = 0; fusing < fusings && !best.is_final; ++fusing) {
    std::optional<Flattened> next = flattened(ungrouped(best.plc), plc, coplanar_tolerance, triangulate, true);
    // As fused, facets may intersect that do not once they are plane: within noise, a small angle is better than none.
    if (!next && fusing == 0 && !is_wide(coplanar_tolerance, 1)) next = flattened(best.plc, plc, coplanar_tolerance, triangulate, false);
    if (!next) break;
    best = std::move(*next);
  }
  if (done && !best.done.is_none()) *done = best.done;
  return std::move(best.plc);
}

}  // namespace pgdr
