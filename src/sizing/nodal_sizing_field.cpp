// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/nodal_sizing_field.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

namespace pgdr {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Data_structure = CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_with_info_3<double, Kernel>, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Data_structure, CGAL::Fast_location>;

}  // namespace

struct Nodal_sizing_field::Nodes {
  Triangulation triangulation;
};

Nodal_sizing_field::Nodal_sizing_field(const std::vector<Point>& points, const std::vector<double>& values) {
  if (points.size() != values.size() || points.empty())
    throw std::invalid_argument("there are " + std::to_string(points.size()) + " points with sizes and " + std::to_string(values.size()) + " values");
  if (!std::ranges::all_of(values, [](double v) { return v > 0 && std::isfinite(v); })) throw std::invalid_argument("the sizes at points have to be positive and finite");
  for (const Point& p : points)
    if (!std::ranges::all_of(p, [](double x) { return std::isfinite(x); })) throw std::invalid_argument("the coordinates of points with sizes have to be finite");
  std::vector<std::pair<Kernel::Point_3, double>> nodes;
  nodes.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) nodes.emplace_back(Kernel::Point_3(points[i][0], points[i][1], points[i][2]), values[i]);
  // Of equal points the first one: insertion goes along a curve, not in order.
  std::ranges::stable_sort(nodes, [](const auto& a, const auto& b) { return a.first < b.first; });
  // Not std::ranges::unique, which Clang 14 cannot compile.
  nodes.erase(std::unique(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.first == b.first; }), nodes.end());
  const auto made = std::make_shared<Nodes>();
  made->triangulation.insert(nodes.begin(), nodes.end());
  nodes_ = made;
}

double Nodal_sizing_field::size_at(const Point& point) const {
  const Triangulation& tr = nodes_->triangulation;
  const Kernel::Point_3 p(point[0], point[1], point[2]);
  if (tr.dimension() == 3) {
    const Triangulation::Cell_handle c = tr.locate(p);
    if (!tr.is_infinite(c)) {
      double volume = 0, sum = 0;
      for (int k = 0; k < 4; ++k) {
        const auto corner = [&](int i) -> const Kernel::Point_3& { return i == k ? p : c->vertex(i)->point(); };
        const double part = std::max(0.0, CGAL::volume(corner(0), corner(1), corner(2), corner(3)));
        volume += part;
        sum += part * c->vertex(k)->info();
      }
      if (volume > 0) return sum / volume;
    }
  }
  return tr.nearest_vertex(p)->info();
}

}  // namespace pgdr
