// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_MIRRORS_TURN_3_H
#define PGDR_MIRRORS_TURN_3_H

#include <algorithm>
#include <optional>

#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/vec_3.h>
#include <pgdr/mirrors/mirror_image.h>

namespace pgdr {

/// A half-plane, turned onto another one about the line that bounds both.
///
/// A vertex of one of two such facets may lie in the equatorial ball of a subfacet of the other, however small that is, unless both have
/// their vertices at like places. Then none does: let q be a vertex at height h over the line, q' its image, c the
/// center of the ball at height k, and phi the angle; |q - c|^2 = |q' - c|^2 + 2 h k (1 - cos phi), and |q' - c| is at least
/// the radius if the subfacet is Delaunay in its facet. (The argument of the collars of A. Rand and N. Walkington, *Collars
/// and intestines: practical conforming Delaunay refinement*, IMR 2009, here for whatever points there are.)
///
/// Two vertices and their exact images are cocircular. So images are beside the like places (`aslant`), by e, say. Then |q' - c| >= r - e, with r the
/// radius, and the lemma holds while e r <= h k (1 - cos phi). A vertex is g from its image, g^2 = 2 h^2 (1 - cos phi), and e is g^2 / (8 R) at most, with R
/// its insertion radius: enough where k / r >= h / (4 R), that is, for all balls but those whose centers are close to the line. These may be encroached,
/// by a millionth of g at most.
class Turn_3 {
 public:
  /// \param along the direction of the line, of any length
  /// \param inward, other_inward unit vectors from the line into the two half-planes
  Turn_3(const Vec_3& origin, const Vec_3& along, const Vec_3& inward, const Vec_3& other_inward)
      : origin_(origin), along_(along), inward_(inward), other_inward_(other_inward),
        // Neither along the line nor away from it: two vertices at a right angle to it would be cocircular with their images.
        beside_((dot(along, aslant) < 0 ? -0.85 : 0.85) * domain_detail::normalized(along) + 0.53 * other_inward),
        off_(share * dot(other_inward - inward, aslant)), chord_(length(inward - other_inward)) {}

  /// Where m, a point of the first plane with this insertion radius, comes to lie. None if it is not in the half-plane, or farther away from there than `distance`.
  std::optional<Vec_3> image(const Vec_3& m, double radius, double distance) const {
    const double t = dot(m - origin_, along_) / dot(along_, along_);
    const Vec_3 foot = origin_ + t * along_;
    const double h = dot(m - foot, inward_);
    const double gap = chord_ * h;
    if (h <= 0 || gap > distance) return std::nullopt;
    return foot + h * other_inward_ + std::clamp(off_ * h, -gap * gap / (8 * radius), gap * gap / (8 * radius)) * beside_;
  }

 private:
  /// How much images are off like places at most, of their distance from what they are images of: as much as that is along `aslant`. So it adds up
  /// from facet to facet, and images of one vertex in two of them are not at like places either. Table in docs/robustness.md.
  static constexpr double share = 1e-6;

  Vec_3 origin_, along_;
  Vec_3 inward_, other_inward_;
  Vec_3 beside_;  ///< a unit vector from like places to images
  double off_;    ///< how far along that, in units of their height
  double chord_;  ///< distance between a point and its image, in units of their height
};

}  // namespace pgdr

#endif
