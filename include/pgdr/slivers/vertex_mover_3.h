// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_VERTEX_MOVER_3_H
#define PGDR_SLIVERS_VERTEX_MOVER_3_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <pgdr/conforming/cavity_features_3.h>
#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/conforming/torn_features_3.h>
#include <pgdr/mesh/cavity_3.h>
#include <pgdr/mesh/vertex_hole_3.h>
#include <pgdr/slivers/average_shape.h>
#include <pgdr/slivers/directions.h>
#include <pgdr/slivers/exempt_tetrahedra_3.h>
#include <pgdr/slivers/tetrahedron_judge.h>

namespace pgdr {

/// Moves vertices inside of volumes to where the smallest dihedral angle of all tetrahedra that change is larger.
///
/// A place is looked at without a change of the triangulation: of the tetrahedra that would fill the vertex's hole (`Vertex_hole_3`), and of
/// those around it, the place's ball holds some no more, and the star replaces these.
template <class Tr, class Criteria>
class Vertex_mover_3 {
 public:
  using Complex = Constraint_complex_3<Tr>;
  using Cell_handle = typename Tr::Cell_handle;
  using Vertex_handle = typename Tr::Vertex_handle;
  using Point = typename Tr::Point;

  enum class Outcome { moved, stays, foreign };

  Vertex_mover_3(Tr& tr, Complex& complex, Tetrahedron_judge<Criteria> judge, const Territory_3<Tr>& territory)
      : tr_(tr), complex_(complex), judge_(judge), territory_(territory), hole_(tr), cavity_(tr), gone_(judge.acute()) {
    hole_.set_territory(territory);
    cavity_.set_territory(territory);
  }

  /// Moves v if that makes the largest cosine of a dihedral angle in its star smaller; unless it is at most `wanted` already.
  /// `foreign`: it stays, but might not with other borders.
  Outcome improve(Vertex_handle v, double wanted) {
    is_foreign_ = false;
    if (!territory_.leads_on(v)) return Outcome::foreign;
    if (v->in_dimension() != 3 || v->cell()->subdomain() == 0) return Outcome::stays;
    if (!hole_.find(v)) return hole_.is_foreign() ? Outcome::foreign : Outcome::stays;
    const double now = measure_star();
    if (now <= wanted || !hole_.fill()) return Outcome::stays;
    note_exempt();
    if (!search(position(v), now, wanted)) return is_foreign_ ? Outcome::foreign : Outcome::stays;
    return move(v) ? Outcome::moved : Outcome::stays;
  }

  /// Moves v towards the place that optimal Delaunay triangulation has for it (Chen and Holst, Comput. Methods Appl. Mech. Engrg. 200, 2011,
  /// with the density of the mesh itself), if the tetrahedra that change are better on average afterwards, and none has a smaller dihedral
  /// angle than the wanted one unless one had that before. `foreign`: as above.
  /// \pre v is inside of a volume
  Outcome smooth(Vertex_handle v, double wanted) {
    constexpr double least_way = 0.02;  // of the shortest edge at the vertex: less changes no average that anybody sees
    constexpr double parts[] = {1, 0.5};
    is_foreign_ = false;
    if (!territory_.leads_on(v)) return Outcome::foreign;
    if (!hole_.find(v)) return hole_.is_foreign() ? Outcome::foreign : Outcome::stays;
    const double limit = std::max(measure_star(), wanted) + rounding;
    gone_.clear();
    const Vec_3 from = position(v), way = middle_of_circumcenters() - from;
    if (!(length(way) > least_way * shortest_) || !hole_.fill()) return Outcome::stays;
    refused_at_ = 0;
    is_averaging_ = true;
    measured_filling_.assign(hole_.filling().size(), {});
    for (const double part : parts) {
      place_ = from + part * way;
      if (worst_at(place_, limit) < limit && is_better_at_place()) return move(v) ? Outcome::moved : Outcome::stays;
    }
    return is_foreign_ ? Outcome::foreign : Outcome::stays;
  }

  /// Whether the last move left no tetrahedron at the vertex above the wanted cosine.
  bool is_cured() const { return is_cured_; }

  /// The tetrahedra made by the last move.
  template <class F>
  void for_made(const F& f) const {
    for (const Cell_handle c : filling_made_) f(c);
    for (const Cell_handle c : cavity_.star()) f(c);
  }

 private:
  static constexpr double refused = Tetrahedron_judge<Criteria>::refused;
  static constexpr double unmeasured = -2;  ///< less than any cosine
  struct Measured {
    double cosine = unmeasured;
    std::uint8_t exempt = 0;  ///< whether it would be
  };
  /// The tetrahedra that are made have their corners in another order, which is rounded differently.
  static constexpr double rounding = 1e-12;

  double measure_star() {
    double worst = -1;
    shortest_ = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < hole_.star().size(); ++k) {
      const Tetrahedron_points corners = tetrahedron_points(hole_.star()[k]);
      if (const double cosine = largest_dihedral_cosine(corners); cosine > worst) {
        worst = cosine;
        steepest_ = gradient(corners, static_cast<std::size_t>(hole_.apex(k)));
      }
    }
    const Vec_3 at = position(vertex());
    for (const Vec_3& p : hole_.points()) shortest_ = std::min(shortest_, squared_distance(at, p));
    shortest_ = std::sqrt(shortest_);
    return worst;
  }

  /// Exempt tetrahedra of the star may be replaced by as many, with ratios up to theirs.
  void note_exempt() {
    gone_.clear();
    for (const Cell_handle c : hole_.star()) {
      if (c->state() == Cell_state::exempt) gone_.add(c);
      if (c->state() == Cell_state::good || c->state() == Cell_state::exempt) continue;
      gone_.clear();
      return;
    }
  }

  /// Of a tetrahedron that would be made, as the judge.
  double judged(const Tetrahedron_points& corners, double limit, std::uint8_t& exempt) const {
    const std::int32_t subdomain = hole_.star().front()->subdomain();
    exempt = 0;
    if (gone_.count() == 0) return judge_(corners, subdomain, limit);
    double squared_ratio;
    const double cosine = judge_.instead_of_exempt(corners, subdomain, limit, squared_ratio);
    exempt = squared_ratio > 0;
    return squared_ratio <= gone_.squared_ratio() ? cosine : refused;
  }

  Vertex_handle vertex() const { return hole_.star().front()->vertex(hole_.apex(0)); }

  /// The direction in which a corner leaves the plane of the others.
  static Vec_3 gradient(const Tetrahedron_points& p, std::size_t apex) {
    const Vec_3 a = p[(apex + 1) & 3], n = cross(p[(apex + 2) & 3] - a, p[(apex + 3) & 3] - a);
    const double l = length(n);
    if (!(l > 0)) return {};
    return ((dot(p[apex] - a, n) < 0 ? -1 : 1) / l) * n;
  }

  Vec_3 middle_of_circumcenters() const {
    Vec_3 sum;
    for (const Cell_handle c : hole_.star()) sum = sum + tetrahedron_ball(tetrahedron_points(c)).center;
    return (1 / static_cast<double>(hole_.star().size())) * sum;
  }

  /// Whether the tetrahedra that `worst_at` made at the place are better on average than those that would go.
  bool is_better_at_place() const {
    Average_shape before;
    for (const Cell_handle c : hole_.star()) before.add(tetrahedron_points(c));
    for (const Cell_handle c : outside_) before.add(tetrahedron_points(c));
    return made_.value() > before.value();
  }

  /// Looks for a place: the first that is good enough, else the best that is better than what there is.
  bool search(const Vec_3& from, double now, double wanted) {
    refused_at_ = 0;
    is_averaging_ = false;
    measured_filling_.assign(hole_.filling().size(), {});
    is_cured_ = try_all(from, wanted - rounding, true);
    if (is_cured_) return true;
    measured_filling_.assign(hole_.filling().size(), {});
    return try_all(from, now, false);
  }

  /// Tries places near `from`; true if at one of them no cosine reaches the limit. Ends at the first, or looks for the best one.
  bool try_all(const Vec_3& from, double limit, bool ends_at_first) {
    // Relative to the shortest edge at the vertex.
    constexpr double steps[] = {0.25, 0.12, 0.05, 0.4};
    bool is_any = false;
    const auto attempt = [&](const Vec_3& direction, double step) {
      const Vec_3 at = from + (step * shortest_) * direction;
      const double cosine = worst_at(at, limit);
      if (cosine >= limit) return false;
      limit = cosine;
      place_ = at;
      is_any = true;
      return ends_at_first;
    };
    for (const double step : steps)
      for (const double sign : {1.0, -1.0})
        if (attempt(sign * steepest_, step)) return true;
    for (const double step : steps) {
      for (const Vec_3& d : directions)
        if (attempt((1 / length(d)) * d, step)) return true;
      // Where exempt tetrahedra are, hardly any place is better. Seconds on a13, and tetrahedra below 12 degrees left: all steps 2.5, 3,867; one
      // 2.1, 3,943; none 1.5, 4,234. Without it a04 keeps 665 exempt ones instead of 592.
      if (!ends_at_first && gone_.count() > 0) break;
    }
    return is_any;
  }

  /// The cosine in the filling, `refused` if the refinement would not leave it or it reaches the limit, which may only become less.
  double measured_filling(std::size_t k, double limit) {
    Measured& m = measured_filling_[k];
    if (m.cosine == unmeasured) m.cosine = judged(hole_.points_of(hole_.filling()[k]), limit, m.exempt);
    return m.cosine;
  }

  /// The largest cosine of a dihedral angle of what is new with the vertex there; `refused` if that is not below the limit, or one of them
  /// would not do, or a piece of the input would be lost.
  double worst_at(const Vec_3& at, double limit) {
    const Point p(at.x, at.y, at.z);
    const auto& filling = hole_.filling();
    in_conflict_.resize(filling.size());
    bool is_any = false;
    double worst = -1;
    for (std::size_t k = 0; k < filling.size(); ++k) {
      in_conflict_[k] = hole_.in_conflict(filling[k], p);
      if (!in_conflict_[k] && measured_filling_[k].cosine >= limit) return refused;  // not measured yet: less than any limit
      is_any |= in_conflict_[k];
    }
    if (!is_any) return refused;
    exempt_made_.clear();
    made_ = {};
    for (std::size_t k = 0; k < filling.size(); ++k)
      if (!in_conflict_[k]) {
        worst = std::max(worst, measured_filling(k, limit));
        if (measured_filling_[k].exempt) exempt_made_.push_back(hole_.points_of(filling[k]));
        if (worst >= limit || exempt_made_.size() > gone_.count()) return refused;
        if (is_averaging_) made_.add(hole_.points_of(filling[k]));
      }
    const auto face = [&](Tetrahedron_points corners, std::size_t i) {
      corners[i] = at;
      std::uint8_t is_exempt;
      worst = std::max(worst, judged(corners, limit, is_exempt));
      if (is_exempt) exempt_made_.push_back(corners);
      if (is_averaging_) made_.add(corners);
      return worst < limit && exempt_made_.size() <= gone_.count();
    };
    for (std::size_t k = 0; k < filling.size(); ++k)
      if (in_conflict_[k])
        for (std::size_t i = 0; i < 4; ++i) {
          const std::int32_t n = filling[k].neighbors[i];
          if (!hole_.is_beyond(n) && !in_conflict_[static_cast<std::size_t>(n)] && !face(hole_.points_of(filling[k]), i)) return refused;
        }
    outside_.clear();
    const auto& star = hole_.star();
    for (std::size_t m = 0; m < star.size(); ++m) {
      const std::size_t k = (refused_at_ + m) % star.size();
      if (!in_conflict_[static_cast<std::size_t>(hole_.filling_behind(k))]) continue;
      const int i = hole_.apex(k);
      switch (look_at(star[k], i, p)) {
        case Beyond::in_conflict: break;
        case Beyond::refused: return refused;
        case Beyond::boundary:
          if (face(tetrahedron_points(star[k]), static_cast<std::size_t>(i))) break;
          refused_at_ = k;
          return refused;
      }
    }
    for (std::size_t m = 0; m < outside_.size(); ++m) {
      const Cell_handle c = outside_[m];
      for (int i = 0; i < 4; ++i) {
        const Cell_handle n = c->neighbor(i);
        bool is_boundary;
        if (const auto k = static_cast<std::size_t>(std::ranges::find(star, n) - star.begin()); k < star.size()) {
          is_boundary = !in_conflict_[static_cast<std::size_t>(hole_.filling_behind(k))];
        } else {
          const Beyond b = look_at(c, i, p);
          if (b == Beyond::refused) return refused;
          is_boundary = b == Beyond::boundary;
        }
        if (is_boundary && !face(tetrahedron_points(c), static_cast<std::size_t>(i))) return refused;
      }
    }
    const auto is_explained = [this](const Tetrahedron_points& t) { return gone_.explain(t); };
    return std::ranges::all_of(exempt_made_, is_explained) ? worst : refused;
  }

  enum class Beyond { boundary, in_conflict, refused };

  /// Whether the ball of the tetrahedron beyond a triangle holds p.
  Beyond look_at(Cell_handle c, int i, const Point& p) {
    const Cell_handle n = c->neighbor(i);
    if (std::ranges::find(outside_, n) == outside_.end()) {
      if (!tr_.in_conflict(n, p)) return Beyond::boundary;
      if (!territory_.owns(n)) {
        is_foreign_ = true;
        return Beyond::refused;
      }
      if (tr_.is_infinite(n)) return Beyond::refused;
      outside_.push_back(n);
    }
    return c->subfacet(i) == Complex::none && n->subdomain() == c->subdomain() ? Beyond::in_conflict : Beyond::refused;
  }

  /// To the place that was found; back again if that would lose a subsegment, or encroach what is protected.
  bool move(Vertex_handle v) {
    const Point before = v->point(), at(place_.x, place_.y, place_.z);
    filling_made_ = hole_.commit();
    bool is_kept = find(at);
    if (is_kept && encroaches_protected(complex_, features_, judge_.acute(), at)) {
      cavity_.abandon();
      is_kept = false;
    }
    if (!is_kept) find(before);
    std::erase_if(filling_made_, [](Cell_handle c) { return Cavity_3<Tr>::contains(c); });
    cavity_.commit(is_kept ? at : before, v);
    if (gone_.count() > 0)
      for_made([this](Cell_handle c) { judge_.mark_exempt(c); });
    if (is_kept) v->set_insertion_radius(nearest_);
    return is_kept;
  }

  bool find(const Point& p) {
    for (const Cell_handle c : filling_made_)
      if (tr_.in_conflict(c, p)) {
        if (!cavity_.find(p, c)) return false;
        features_.gather(complex_, cavity_);
        if (features_.deletes_any()) {
          cavity_.abandon();
          return false;
        }
        nearest_ = std::sqrt(cavity_.squared_insertion_radius(to_vec(p)));
        return true;
      }
    return false;
  }

  Tr& tr_;
  Complex& complex_;
  Tetrahedron_judge<Criteria> judge_;
  Territory_3<Tr> territory_;
  Vertex_hole_3<Tr> hole_;
  Cavity_3<Tr> cavity_;
  Cavity_features_3<Tr> features_;
  double shortest_ = 0;
  Vec_3 steepest_;
  std::size_t refused_at_ = 0;  ///< in the star, where the last place was: likely the next one, too
  bool is_averaging_ = false;   ///< whether `made_` is asked for
  Average_shape made_;          ///< of what is new at the last place
  Vec_3 place_;
  double nearest_ = 0;
  bool is_foreign_ = false, is_cured_ = false;
  Exempt_tetrahedra_3<Tr> gone_;  ///< of the star, where others may take their places
  std::vector<Tetrahedron_points> exempt_made_;  ///< in their places, at the last place
  std::vector<Measured> measured_filling_;
  std::vector<std::uint8_t> in_conflict_;
  std::vector<Cell_handle> outside_;
  std::vector<Cell_handle> filling_made_;
};

}  // namespace pgdr

#endif
