// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CGAL_PLC_FROM_POLYGON_SOUP_H
#define PGDR_CGAL_PLC_FROM_POLYGON_SOUP_H

#include <cstddef>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pgdr/domain/default_kernel.h>

namespace pgdr {

/// The PLC of a polygon soup, as CGAL's `Polygon_mesh_processing` takes it: points that occur several times are one, edges may have any number
/// of polygons, orientation does not matter.
///
/// \param points a range of points with `x()`, `y()`, `z()` in floating point
/// \param polygons a range of ranges of positions in `points`, each of at least three
/// \param marker optional: gives for the position of a polygon an `int`, the facet's marker. Polygons with different ones are never fused.
/// Every enclosed volume is material and a region of its own, unless the seed of a hole lies in it (`holes`, `regions` of the result) or `nesting` is changed.
/// Throws `std::out_of_range` for a position that is none, `std::length_error` for more than 2^32 - 2 points.
template <class Points, class Polygons, class Marker>
Plc plc_from_polygon_soup(const Points& points, const Polygons& polygons, const Marker& marker) {
  Plc plc;
  const auto size = static_cast<std::size_t>(std::distance(std::begin(points), std::end(points)));
  if (size > std::numeric_limits<Index>::max() - 1) throw std::length_error("the soup has more than 2^32 - 2 points");
  plc.vertices.reserve(size);
  for (const auto& p : points) {
    static_assert(std::is_floating_point_v<std::decay_t<decltype(p.x())>>,
                  "pgdr takes coordinates in floating point: round exact numbers first, where you see what that does to the soup");
    plc.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto& polygon : polygons) {
    std::vector<Index> loop;
    for (const auto v : polygon) {
      if (std::cmp_less(v, 0) || std::cmp_greater_equal(v, size))
        throw std::out_of_range("polygon " + std::to_string(plc.facets.size()) + " has vertex " + std::to_string(v) + " of " + std::to_string(size) + " points");
      loop.push_back(static_cast<Index>(v));
    }
    const int m = marker(plc.facets.size());
    plc.facets.push_back({{std::move(loop)}, {}, m});
  }
  return plc;
}

template <class Points, class Polygons>
Plc plc_from_polygon_soup(const Points& points, const Polygons& polygons) {
  return plc_from_polygon_soup(points, polygons, [](std::size_t) { return 0; });
}

}  // namespace pgdr

#endif
