// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SLIVERS_AVERAGE_SHAPE_H
#define PGDR_SLIVERS_AVERAGE_SHAPE_H

#include <cstddef>

#include <pgdr/mesh/tetrahedron_ball.h>

namespace pgdr {

/// The third power of the mean ratio of a tetrahedron (`Shape_measures`), which takes no root: from 0 to 1, where it is regular.
inline double cubed_mean_ratio(const Tetrahedron_points& p) {
  const Vec_3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  const double six_volumes = dot(a, cross(b, c));
  const double edges = squared_length(a) + squared_length(b) + squared_length(c) + squared_distance(p[1], p[2]) + squared_distance(p[1], p[3]) +
                       squared_distance(p[2], p[3]);
  return 432 * six_volumes * six_volumes / (edges * edges * edges);  // (12 / edges)^3 (3 volumes)^2
}

/// The average of the above over some tetrahedra.
class Average_shape {
 public:
  void add(const Tetrahedron_points& p) {
    sum_ += cubed_mean_ratio(p);
    ++count_;
  }
  double value() const { return sum_ / static_cast<double>(count_); }

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

}  // namespace pgdr

#endif
