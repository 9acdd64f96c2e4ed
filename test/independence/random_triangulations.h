// SPDX-License-Identifier: GPL-3.0-or-later
// Small random triangulations, from general to degenerate, and pairs of points in them.
#ifndef PGDR_TEST_INDEPENDENCE_RANDOM_TRIANGULATIONS_H
#define PGDR_TEST_INDEPENDENCE_RANDOM_TRIANGULATIONS_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "mesh/random.h"

namespace pgdr_test {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;
using Point = Kernel::Point_3;

enum class Arrangement {
  random,       ///< anywhere in the unit cube
  gridded,      ///< on a coarse grid, so that most spheres have more than four points
  cospherical,  ///< on two concentric spheres, exactly, and around their center
  coplanar,     ///< on three parallel planes
  nearly_flat   ///< on a coarse grid, moved inwards by a few units in the last place
};

constexpr std::array<Arrangement, 5> arrangements{Arrangement::random, Arrangement::gridded,
                                                  Arrangement::cospherical, Arrangement::coplanar,
                                                  Arrangement::nearly_flat};

inline const char* name(Arrangement a) {
  constexpr const char* names[] = {"random", "gridded", "cospherical", "coplanar", "nearly flat"};
  return names[static_cast<int>(a)];
}

/// A point of an arrangement; all are in the cube from -1 to 1.
inline Point random_point(Arrangement a, Random& random) {
  const auto any = [&] { return random.between(-1, 1); };
  const auto grid = [&] { return static_cast<double>(random.below(5)) / 2 - 1; };
  switch (a) {
    case Arrangement::random:
      return Point(any(), any(), any());
    case Arrangement::gridded:
      return Point(grid(), grid(), grid());
    case Arrangement::cospherical: {
      // The points (x, y, z) of x^2 + y^2 + z^2 = 1 from Pythagorean quadruples, and half of them.
      constexpr int quadruples[][4] = {{1, 2, 2, 3}, {2, 3, 6, 7}, {1, 4, 8, 9},
                                       {4, 4, 7, 9}, {0, 3, 4, 5}, {0, 0, 1, 1}};
      const auto& q = quadruples[random.below(6)];
      std::array<std::size_t, 3> order{0, 1, 2};
      std::swap(order[0], order[random.below(3)]);
      std::swap(order[1], order[1 + random.below(2)]);
      // Over the common denominator 315 all of them are whole, so that the spheres have radius 315 exactly.
      std::array<double, 3> p{};
      for (std::size_t i = 0; i < 3; ++i)
        p[i] = (random.below(2) ? 1 : -1) * q[order[i]] * (315.0 / q[3]) / 512;
      const double s = random.below(3) ? 1 : 0.5;
      if (random.below(20) == 0) return Point(0.1 * any(), 0.1 * any(), 0.1 * any());
      return Point(s * p[0], s * p[1], s * p[2]);
    }
    case Arrangement::coplanar:
      return Point(any(), any(), static_cast<double>(random.below(3)) - 1);
    case Arrangement::nearly_flat: {
      const auto jitter = [&] { return grid() * (1 - 0x1p-52 * static_cast<double>(random.below(5))); };
      return Point(jitter(), jitter(), jitter());
    }
  }
  return {};
}

/// About forty vertices, the corners of the cube among them.
inline Delaunay random_triangulation(Arrangement a, Random& random) {
  Delaunay t;
  for (int k = 0; k < 8; ++k) t.insert(Point(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
  for (int k = 0; k < 32; ++k) t.insert(random_point(a, random));
  return t;
}

/// Two points of the cube, half of the time of the same arrangement, often close to each other, now and then on the hull.
inline std::pair<Point, Point> random_pair(Arrangement a, Random& random) {
  const auto any = [&] {
    if (random.below(2)) return random_point(a, random);
    const auto x = [&] { return random.below(16) ? random.between(-1, 1) : random.below(2) ? 1.0 : -1.0; };
    return Point(x(), x(), x());
  };
  const Point p = any();
  if (random.below(2)) return {p, any()};
  const auto near = [&](double x) { return std::min(1.0, std::max(-1.0, x + random.between(-0.7, 0.7))); };
  return {p, Point(near(p.x()), near(p.y()), near(p.z()))};
}

inline bool is_vertex(const Delaunay& t, const Point& p) {
  Delaunay::Vertex_handle v;
  return t.is_vertex(p, v);
}

/// The cavity of a point and the triangles of its boundary, as seen from inside.
struct Cavity {
  Cavity(const Delaunay& t, const Point& p) {
    t.find_conflicts(p, t.locate(p), std::back_inserter(boundary), std::back_inserter(cells));
  }
  bool contains(Delaunay::Cell_handle c) const {
    return std::find(cells.begin(), cells.end(), c) != cells.end();
  }
  bool meets(const Cavity& other) const {
    return std::any_of(cells.begin(), cells.end(),
                       [&](Delaunay::Cell_handle c) { return other.contains(c); });
  }
  bool shares_triangle(const Cavity& other) const {
    return std::any_of(boundary.begin(), boundary.end(),
                       [&](const Delaunay::Facet& f) { return other.contains(f.first->neighbor(f.second)); });
  }
  std::vector<Delaunay::Cell_handle> cells;
  std::vector<Delaunay::Facet> boundary;
};

}  // namespace pgdr_test

#endif
