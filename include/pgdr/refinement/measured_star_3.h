// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_REFINEMENT_MEASURED_STAR_3_H
#define PGDR_REFINEMENT_MEASURED_STAR_3_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pgdr/mesh/cavity_3.h>
#include <pgdr/mesh/tetrahedron_ball.h>

namespace pgdr {

/// The tetrahedra that a point would have around it, measured when its cavity is found, so that a better point can be looked for; what was
/// measured is needed again once it is inserted.
template <class Tr>
class Measured_star_3 {
 public:
  struct Tetrahedron {
    Tetrahedron_ball ball;  ///< not measured outside of the domain
    bool is_poor = false;
  };

  void clear() {
    tetrahedra_.clear();
    bad_.clear();
  }
  /// Nothing is measured, or not all.
  bool is_empty() const { return tetrahedra_.empty(); }
  /// That of the k-th boundary triangle, `Cavity_3::star()[k]` later.
  const Tetrahedron& operator[](std::size_t k) const { return tetrahedra_[k]; }

  /// Whether none of those that are going to stay, since they are not poor, has a dihedral angle with a cosine above `limit`. At the first
  /// one all is forgotten but that.
  template <class Criteria>
  bool measure(const Cavity_3<Tr>& cavity, const Vec_3& p, const Criteria& criteria, double limit) {
    tetrahedra_.clear();
    for (const auto& [c, i] : cavity.boundary()) {
      tetrahedra_.emplace_back();
      if (c->subdomain() == 0) continue;
      Tetrahedron_points corners;
      for (int j = 0; j < 4; ++j) corners[static_cast<std::size_t>(j)] = j == i ? p : position(c->vertex(j));
      Tetrahedron& t = tetrahedra_.back();
      const Tetrahedron_frame frame(corners);
      t.ball = frame.ball();
      t.is_poor = criteria.is_poor(t.ball, c->subdomain());
      if (t.is_poor || frame.largest_dihedral_cosine() <= limit) continue;
      bad_.push_back({corners, static_cast<std::size_t>(i), c->subdomain()});
      tetrahedra_.clear();
      return false;
    }
    return true;
  }

  /// Whether a point at q would be just as bad over one of the triangles that points before failed at. Those hardly ever leave the
  /// boundary of the cavity, and it need not be searched.
  template <class Criteria>
  bool is_as_bad(const Vec_3& q, const Criteria& criteria, double limit) const {
    for (Bad bad : bad_) {
      bad.corners[bad.apex] = q;
      const Tetrahedron_frame frame(bad.corners);
      if (frame.largest_dihedral_cosine() > limit && !criteria.is_poor(frame.ball(), bad.subdomain)) return true;
    }
    return false;
  }

 private:
  struct Bad {
    Tetrahedron_points corners;
    std::size_t apex;
    std::int32_t subdomain;
  };

  std::vector<Tetrahedron> tetrahedra_;
  std::vector<Bad> bad_;
};

}  // namespace pgdr

#endif
