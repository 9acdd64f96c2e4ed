// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>

#include "file_text.h"
#include "readers.h"

namespace pgdr::io_detail {
namespace {

using Kind = Input_problem::Kind;
using Point_3 = Plc::Point_3;
using Polygons = std::vector<std::vector<std::size_t>>;

Checked_surface check(std::string_view text, const std::filesystem::path& path, Surface_format format, Markers_from markers) {
  switch (format) {
    case Surface_format::off:
      return check_off(text, path, markers);
    case Surface_format::stl:
      return check_stl(text, path, markers);
    case Surface_format::ply:
      return check_ply(text, path, markers);
    case Surface_format::obj:
      break;
  }
  return check_obj(text, path, markers);
}

bool read_with_cgal(std::istream& in, Surface_format format, std::vector<Point_3>& points,
                    Polygons& polygons) {
  const auto quiet = CGAL::parameters::verbose(false);
  switch (format) {
    case Surface_format::off:
      return CGAL::IO::read_OFF(in, points, polygons, quiet);
    case Surface_format::stl:
      return CGAL::IO::read_STL(in, points, polygons, quiet);
    case Surface_format::ply:
      return CGAL::IO::read_PLY(in, points, polygons, quiet);
    case Surface_format::obj:
      break;
  }
  return CGAL::IO::read_OBJ(in, points, polygons, quiet);
}

}  // namespace

Plc read_surface(const std::filesystem::path& path, Surface_format format, Markers_from markers) {
  Checked_surface checked = [&] {
    const File_text text(path);
    return check(text.view(), path, format, markers);
  }();
  if (checked.facets == 0) fail_at(path, 0, Kind::empty, "the surface is empty");

  std::vector<Point_3> points;
  Polygons polygons;
  bool good = false;
  try {
    std::istringstream in(std::move(checked.text), std::ios::binary);
    good = read_with_cgal(in, format, points, polygons);
  } catch (const std::exception&) {
    good = false;
  }
  if (!good || polygons.size() != checked.facets ||
      (checked.vertices > 0 && points.size() != checked.vertices)) {
    fail_at(path, 0, Kind::unreadable, "it is not a surface that CGAL can read");
  }

  Plc plc;
  plc.nesting = Nesting::alternate;
  plc.first_index = format == Surface_format::obj ? 1 : 0;
  if (points.size() > std::numeric_limits<Index>::max())
    fail_at(path, 0, Kind::unreadable, "there are too many vertices");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isfinite(points[i].x()) && std::isfinite(points[i].y()) && std::isfinite(points[i].z()))
      continue;
    fail_at(path, 0, Kind::bad_coordinate,
            "vertex " + std::to_string(plc.first_index + i) + " has a coordinate that is not finite");
  }
  plc.facets.resize(polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    auto& polygon = polygons[i];
    if (polygon.size() > 3 && polygon.front() == polygon.back()) polygon.pop_back();
    std::vector<Index> loop;
    loop.reserve(polygon.size());
    for (const std::size_t vertex : polygon) {
      if (vertex >= points.size()) {
        fail_at(path, 0, Kind::bad_index,
                "facet " + std::to_string(plc.first_index + i) + " names a vertex that is not there");
      }
      loop.push_back(static_cast<Index>(vertex));
    }
    plc.facets[i].polygons.push_back(std::move(loop));
  }
  plc.vertices = std::move(points);
  checked.groups.mark(plc);
  return plc;
}

}  // namespace pgdr::io_detail
