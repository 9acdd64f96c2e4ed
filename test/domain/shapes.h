// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_DOMAIN_SHAPES_H
#define PGDR_TEST_DOMAIN_SHAPES_H

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/input_error.h>

namespace pgdr_test {

using pgdr::Index;
using pgdr::Plc;
using Facet = pgdr::Plc_facet<pgdr::Default_kernel>;

/// The eight corners of a box and its six quadrilaterals, appended to `plc`.
inline void add_box(Plc& plc, std::array<double, 3> lower, std::array<double, 3> upper, int marker = 0) {
  const Index o = static_cast<Index>(plc.vertices.size());
  for (int i = 0; i < 8; ++i)
    plc.vertices.emplace_back(i & 1 ? upper[0] : lower[0], i & 2 ? upper[1] : lower[1],
                              i & 4 ? upper[2] : lower[2]);
  for (const std::vector<Index>& q :
       {std::vector<Index>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    plc.facets.push_back({{{o + q[0], o + q[1], o + q[2], o + q[3]}}, {}, marker});
}

inline Plc box(std::array<double, 3> lower = {0, 0, 0}, std::array<double, 3> upper = {1, 1, 1}) {
  Plc plc;
  add_box(plc, lower, upper);
  return plc;
}

/// Two prisms whose lids are valleys along their longer diagonals, 5e-7 deep: fused, they are divided along the shorter one, and are ridges. Above the first valley stands a box.
inline Plc box_above_valley(double gap) {
  constexpr double depth = 5e-7;
  Plc plc;
  for (const double shift : {0.0, 4.0}) {
    const Index o = static_cast<Index>(plc.vertices.size());
    for (const double lid : {0.0, 1.0})
      for (const auto& [x, y] : {std::pair{-1.0, 0.0}, {0.0, -0.5}, {1.0, 0.0}, {0.0, 0.5}}) plc.vertices.emplace_back(shift + x, y, lid * (y == 0 ? 1 - depth : 1.0));
    for (const auto& t : {std::array<Index, 3>{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}}) plc.facets.push_back({{{o + t[0], o + t[1], o + t[2]}}, {}, 0});
    for (Index a = 0; a < 4; ++a) plc.facets.push_back({{{o + a, o + (a + 1) % 4, o + (a + 1) % 4 + 4, o + a + 4}}, {}, 0});
  }
  add_box(plc, {-0.02, -0.02, 1 - depth + gap}, {0.02, 0.02, 1.5});
  return plc;
}

/// A prism over a triangle with an angle, in degrees, at vertex 0; the edge from 0 to 3 is the wedge's.
inline Plc triangular_prism(double degrees, double height = 1) {
  const double phi = degrees * std::numbers::pi / 180;
  Plc plc;
  for (const double z : {0.0, height}) {
    plc.vertices.emplace_back(0, 0, z);
    plc.vertices.emplace_back(1, 0, z);
    plc.vertices.emplace_back(std::cos(phi), std::sin(phi), z);
  }
  for (const std::vector<Index>& face : {std::vector<Index>{0, 1, 4, 3}, {0, 2, 5, 3}, {1, 2, 5, 4}, {0, 1, 2}, {3, 4, 5}}) plc.facets.push_back({{face}, {}, 0});
  return plc;
}

/// Cuts every polygon into a fan of triangles.
inline Plc triangulated(const Plc& plc) {
  Plc result = plc;
  result.facets.clear();
  for (const Facet& f : plc.facets)
    for (std::size_t i = 1; i + 1 < f.polygons[0].size(); ++i)
      result.facets.push_back({{{f.polygons[0][0], f.polygons[0][i], f.polygons[0][i + 1]}}, {}, f.marker});
  return result;
}

/// Rotates a PLC about an axis in general position, so that nothing stays parallel to the axes.
inline Plc tilted(Plc plc) {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(0.4), t = std::sin(0.4);
  const auto turn = [&](const auto& p) {
    const double x = c * p.x() - s * p.y(), y = s * p.x() + c * p.y(), z = p.z();
    return pgdr::Default_kernel::Point_3(x, d * y - t * z, t * y + d * z);
  };
  for (auto& p : plc.vertices) p = turn(p);
  for (auto& p : plc.holes) p = turn(p);
  for (auto& r : plc.regions) r.point = turn(r.point);
  for (auto& f : plc.facets)
    for (auto& h : f.holes) h = turn(h);
  return plc;
}

/// A triangulated cylinder with `n` sides, each cut into two triangles, caps as polygons.
inline Plc cylinder(Index n) {
  Plc plc;
  for (int z : {0, 1})
    for (Index i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n;
      plc.vertices.emplace_back(std::cos(angle), std::sin(angle), z);
    }
  std::vector<Index> bottom, top;
  for (Index i = 0; i < n; ++i) {
    const Index j = (i + 1) % n;
    bottom.push_back(n - 1 - i);
    top.push_back(n + i);
    plc.facets.push_back({{{i, j, n + j}}, {}, 0});
    plc.facets.push_back({{{i, n + j, n + i}}, {}, 0});
  }
  plc.facets.push_back({{bottom}, {}, 0});
  plc.facets.push_back({{top}, {}, 0});
  return plc;
}

/// A square frame: the unit square [0,3]^2 at z = 0 with the hole [1,2]^2.
inline Facet frame(Plc& plc) {
  const Index o = static_cast<Index>(plc.vertices.size());
  for (double a : {0.0, 1.0}) {
    const double b = 3 - a;
    plc.vertices.emplace_back(a, a, 0);
    plc.vertices.emplace_back(b, a, 0);
    plc.vertices.emplace_back(b, b, 0);
    plc.vertices.emplace_back(a, b, 0);
  }
  return {{{o, o + 1, o + 2, o + 3}, {o + 4, o + 5, o + 6, o + 7}}, {{1.5, 1.5, 0}}, 0};
}

template <class K>
double facet_area(const pgdr::Domain_3<K>& domain, std::size_t f) {
  double area = 0;
  for (const auto& t : domain.facets[f].triangles)
    area += std::sqrt(CGAL::to_double(
        CGAL::squared_area(domain.vertices[t[0]], domain.vertices[t[1]], domain.vertices[t[2]])));
  return area;
}

inline std::size_t count(const std::vector<pgdr::Input_problem>& problems, pgdr::Input_problem::Kind kind) {
  std::size_t n = 0;
  for (const auto& p : problems) n += p.kind == kind;
  return n;
}

}  // namespace pgdr_test

#endif
