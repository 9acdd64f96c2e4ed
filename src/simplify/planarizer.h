// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_PLANARIZER_H
#define PGDR_SIMPLIFY_PLANARIZER_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <boost/pending/disjoint_sets.hpp>

#include <pgdr/domain/make_domain_3.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/simplify/planarize.h>

#include "plane_system.h"

namespace pgdr::simplify_detail {

/// Of the diagonal: what files of single precision are off by, with room to spare.
constexpr double noise = 1e-6;

/// Whether more than noise is made plane.
inline bool is_wide(double tolerance, double diagonal) { return tolerance > 2 * noise * diagonal; }

/// In units of the bounding box's diagonal: a facet that is bent by less is as plane as the points that refinement puts on it.
constexpr double bent = 1e-13;

inline bool is_plane(const std::vector<Index>& facet, const std::vector<Vec_3>& points, double diagonal) {
  return Plane_system::bend(facet, points) <= bent * diagonal;
}

/// Finds out which facets of a domain can be made plane, and where its vertices are then.
class Planarizer {
 public:
  using Domain = Domain_3<Default_kernel>;

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

  /// Whether these leave the facets that some input facets are part of where they are.
  bool leaves(const std::vector<Index>& input_facets, const std::vector<Vec_3>& points) const {
    return std::ranges::all_of(input_facets, [&](Index i) {
      return std::ranges::all_of(facets_[facet_of_input_[i]], [&](Index v) { return squared_distance(points[v], points_[v]) == 0; });
    });
  }

  /// Where the points should be.
  std::vector<Vec_3> solution() {
    // Who moves too far is seen after a step or two. With the tolerance of noise there are few rounds.
    for (int round = 0; is_wide(domain_.tolerance, domain_.diagonal) && round < careful_rounds; ++round) {
      solve(rough_, true);
      if (!give_up_what_is_far(rough_, true, false)) break;
    }
    for (int round = 0;; ++round) {
      solve(full_, false);
      if (!give_up_what_is_far(full_, round < careful_rounds, true)) return full_.points;
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
      const bool is_bent = !is_plane(facets_[f], points, domain_.diagonal);
      const bool was_bent = !is_plane(facets_[f], input_, domain_.diagonal);
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
  /// What a solution may leave; above that the facet has none.
  static constexpr double unsolved = 1e-10;
  /// How much farther vertices may move along their facets than away from them.
  static constexpr double sideways = 16;
  /// Where vertices move too far, one facet of each that moves at least half as far as the farthest is given up: mostly the others are only its
  /// neighbors. The farthest is that of the facets around, which takes a third of the rounds that one for all takes: of 141 surfaces, within noise, 9 are
  /// not the same (a knob, a27, keeps 54 bent facets of 8,500 instead of 38), and a smooth one of a million triangles takes half of the time. After this
  /// many rounds, all of them.
  static constexpr int careful_rounds = 16;
  /// Of Newton's method: three reach double precision from a thousandth of the size of a facet.
  static constexpr int most_steps = 8;

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
      if (!is_plane(facets_[f], points_, domain_.diagonal)) choose(f);
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

  /// Facets that hang together: where their vertices go depends on no others.
  using Group = std::vector<Index>;

  struct Solution {
    std::vector<Group> groups;
    std::vector<Vec_3> points;
    std::vector<double> bends;  ///< of the facets in the groups, if it is not a rough one
  };

  /// All that are on, in order.
  std::vector<Group> groups() const {
    boost::disjoint_sets_with_storage<> sets(points_.size());
    for (Index f = 0; f < facets_.size(); ++f)
      if (is_on_[f])
        for (const Index v : facets_[f]) sets.union_set(facets_[f][0], v);
    std::vector<Group> result;
    std::vector<std::size_t> number(points_.size(), points_.size());
    for (Index f = 0; f < facets_.size(); ++f) {
      if (!is_on_[f]) continue;
      std::size_t& n = number[sets.find_set(facets_[f][0])];
      if (n == points_.size()) n = result.size(), result.emplace_back();
      result[n].push_back(f);
    }
    return result;
  }

  /// Of groups that have lost no facet since the last time nothing is asked anew.
  void solve(Solution& solution, bool is_rough) {
    fix_axes();
    const Plane_system system(facets_, fixed_, bent * domain_.diagonal);
    std::vector<const Group*> last(facets_.size(), nullptr);
    for (const Group& g : solution.groups) last[g[0]] = &g;
    std::vector<Group> now = groups(), changed;
    std::vector<Vec_3> points = start_;
    for (const Group& g : now) {
      if (!last[g[0]] || *last[g[0]] != g) {
        changed.push_back(g);
        continue;
      }
      for (const Index f : g)
        for (const Index v : facets_[f]) points[v] = solution.points[v];
    }
    solution.groups = std::move(now);
    solution.points = std::move(points);
    solution.bends.resize(facets_.size());
    parallel_for(0, changed.size(), [&](std::size_t i) {
      if (is_rough) return system.approach(solution.points, changed[i]);
      system.solve(solution.points, changed[i], most_steps);
      for (const Index f : changed[i]) solution.bends[f] = Plane_system::bend(facets_[f], solution.points);
    });
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

  /// How far the vertices have moved of the facets at each vertex, at most.
  std::vector<double> moves_around(const std::vector<double>& moved) const {
    std::vector<double> around(moved.size(), 0);
    for (Index f = 0; f < facets_.size(); ++f) {
      if (!is_on_[f]) continue;
      double most = 0;
      for (const Index v : facets_[f]) most = std::max(most, moved[v]);
      for (const Index v : facets_[f]) around[v] = std::max(around[v], most);
    }
    return around;
  }

  /// \return whether there is something to give up.
  bool give_up_what_is_far(const Solution& solution, bool is_careful, bool is_solved) {
    const std::vector<double> moved = moves(solution.points);
    std::vector<double> farthest(points_.size(), 0);
    if (is_careful) farthest = moves_around(moved);
    const auto is_too_far = [&](Index v) { return moved[v] > std::max(1.0, farthest[v] / 2); };
    // Of the facets at a vertex, the one that needs the fewest triangles if it is not fused.
    std::vector<Index> smallest(points_.size(), static_cast<Index>(facets_.size()));
    for (Index f = 0; f < facets_.size(); ++f)
      if (is_on_[f])
        for (const Index v : facets_[f])
          if (smallest[v] == facets_.size() || facets_[f].size() < facets_[smallest[v]].size()) smallest[v] = f;
    bool some = false;
    for (Index f = 0; f < facets_.size(); ++f) {
      if (!is_on_[f]) continue;
      const bool is_far = std::ranges::any_of(facets_[f], [&](Index v) { return is_too_far(v) && (!is_careful || smallest[v] == f); });
      if (!is_far && (!is_solved || solution.bends[f] <= unsolved * domain_.diagonal)) continue;
      is_on_[f] = false;
      some = true;
    }
    return some;
  }

  const Domain& domain_;
  std::vector<Vec_3> points_;  ///< as they are in the domain
  std::vector<Vec_3> input_;   ///< as they were before
  std::vector<Vec_3> start_;
  Solution rough_, full_;  ///< the last ones
  std::vector<std::vector<Index>> facets_;
  std::vector<Index> facet_of_input_;
  std::vector<Plane_system::Fixed_axes> fixed_;
  std::vector<bool> is_on_;
};

}  // namespace pgdr::simplify_detail

#endif
