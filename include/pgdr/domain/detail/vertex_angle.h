// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_VERTEX_ANGLE_H
#define PGDR_DOMAIN_DETAIL_VERTEX_ANGLE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <vector>

#include <CGAL/box_intersection_d.h>

#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/plc.h>

namespace pgdr::domain_detail {

/// Angle between direction `d` and the part of a plane between the directions `p` and `q`.
inline double angle_to_sector_deg(const Vec_3& d, const Vec_3& p, const Vec_3& q) {
  const Vec_3 n = cross(p, q);
  const double to_sides = std::min(angle_deg(d, p), angle_deg(d, q));
  // The projection of d into the plane lies between p and q.
  if (dot(cross(p, d), n) <= 0 || dot(cross(d, q), n) <= 0) return to_sides;
  const double height = std::abs(dot(d, n));
  const double to_plane = to_degrees(arc_tangent(height, length(cross(d, n))));
  return std::min(to_sides, to_plane);
}

/// The smallest angle at a vertex, between two segments or a segment and a triangle of a facet that it does not belong to. Thousands of segments
/// may meet in the tip of a cone, so that not all pairs are looked at: as points and arcs on the unit sphere, only those that are near.
class Vertex_angle {
 public:
  /// `along`: from the vertex to the other end.
  void add_segment(const Vec_3& along, const std::vector<Index>& facets) { segments_.push_back({along, normalized(along), &facets}); }
  /// `p`, `q`: from the vertex to the other corners.
  void add_triangle(Index facet, const Vec_3& p, const Vec_3& q) { sectors_.push_back({facet, p, q}); }
  void clear() {
    segments_.clear();
    sectors_.clear();
  }

  /// In degrees; 180 if there is none.
  double smallest() const {
    const double between_segments = smallest_between_segments();
    return segments_.size() * sectors_.size() <= all_pairs ? smallest_to_all_sectors(between_segments)
                                                           : smallest_to_near_sectors(between_segments);
  }

 private:
  struct Segment {
    Vec_3 along, unit;
    const std::vector<Index>* facets;
  };
  struct Sector {
    Index facet;
    Vec_3 p, q;
  };
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const std::size_t*>;

  /// Nearly all vertices have fewer pairs, and boxes cost as much as a few hundred of them.
  static constexpr std::size_t all_pairs = 1024;

  /// A little more than the distance on the unit sphere of directions at this angle.
  static double reach(double degrees) { return degrees * (std::numbers::pi / 180) * (1 + 1e-9) + 1e-12; }

  /// Along one axis, whose window gets smaller as angles do.
  double smallest_between_segments() const {
    std::vector<std::size_t> order(segments_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [this](std::size_t a, std::size_t b) {
      return segments_[a].unit.x != segments_[b].unit.x ? segments_[a].unit.x < segments_[b].unit.x : a < b;
    });
    double smallest = 180;
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i; j-- > 0;) {
        const Segment &a = segments_[order[i]], &b = segments_[order[j]];
        if (a.unit.x - b.unit.x > reach(smallest)) break;
        if (std::abs(a.unit.y - b.unit.y) > reach(smallest)) continue;
        smallest = std::min(smallest, angle_deg(a.along, b.along));
      }
    return smallest;
  }

  double angle_to(const Segment& s, const Sector& t) const {
    return std::ranges::binary_search(*s.facets, t.facet) ? 180 : angle_to_sector_deg(s.along, t.p, t.q);
  }

  double smallest_to_all_sectors(double smallest) const {
    for (const Segment& s : segments_)
      for (const Sector& t : sectors_) smallest = std::min(smallest, angle_to(s, t));
    return smallest;
  }

  double smallest_to_near_sectors(double smallest) const {
    std::vector<Box> points, arcs;
    const double r = reach(smallest);
    // A box goes by the address of its number: no point may share it with an arc.
    std::vector<std::size_t> numbers(segments_.size() + sectors_.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    const std::size_t* const arc_numbers = numbers.data() + segments_.size();
    for (std::size_t i = 0; i < segments_.size(); ++i) points.push_back(box(segments_[i].unit, segments_[i].unit, r, &numbers[i]));
    for (std::size_t i = 0; i < sectors_.size(); ++i) {
      const Vec_3 p = normalized(sectors_[i].p), q = normalized(sectors_[i].q);
      // An arc is less than a quarter of its squared chord away from the chord: 1 - sqrt(1 - c^2 / 4) <= c^2 / 4.
      arcs.push_back(box(p, q, squared_distance(p, q) / 4 + 1e-12, arc_numbers + i));
    }
    CGAL::box_intersection_d(points.begin(), points.end(), arcs.begin(), arcs.end(), [&](const Box& point, const Box& arc) {
      smallest = std::min(smallest, angle_to(segments_[*point.handle()], sectors_[*arc.handle() - segments_.size()]));
    });
    return smallest;
  }

  static Box box(const Vec_3& p, const Vec_3& q, double margin, const std::size_t* number) {
    std::array<double, 3> lower{}, upper{};
    for (int k = 0; k < 3; ++k) {
      lower[static_cast<std::size_t>(k)] = std::min(p[k], q[k]) - margin;
      upper[static_cast<std::size_t>(k)] = std::max(p[k], q[k]) + margin;
    }
    return {lower.data(), upper.data(), number};
  }

  std::vector<Segment> segments_;
  std::vector<Sector> sectors_;
};

}  // namespace pgdr::domain_detail

#endif
