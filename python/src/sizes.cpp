// SPDX-License-Identifier: GPL-3.0-or-later
#include "sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <pgdr/sizing/curvature_sizes.h>
#include <pgdr/sizing/facet_sizes.h>
#include <pgdr/sizing/local_feature_sizes.h>
#include <pgdr/sizing/grid_sizing_field.h>
#include <pgdr/sizing/nodal_sizing_field.h>

namespace py = pybind11;

namespace pgdr_python {

void First_error::keep(std::exception_ptr error) {
  const std::lock_guard lock(mutex_);
  if (!error_) error_ = std::move(error);
}

void First_error::rethrow() {
  std::exception_ptr error;
  {
    const std::lock_guard lock(mutex_);
    error = std::exchange(error_, nullptr);
  }
  if (error) std::rethrow_exception(error);
}

namespace {

struct Point {
  std::array<double, 3> c;
  double x() const { return c[0]; }
  double y() const { return c[1]; }
  double z() const { return c[2]; }
};

/// A Python object that may go where nobody holds the GIL.
std::shared_ptr<py::object> shared(const py::object& object) {
  return {new py::object(object), [](py::object* o) {
            const py::gil_scoped_acquire gil;
            delete o;
          }};
}

pgdr::Combined_sizing_field::Function function_of(const py::object& object, const std::shared_ptr<First_error>& errors) {
  return [function = shared(object), errors](const std::array<double, 3>& p) {
    const py::gil_scoped_acquire gil;
    try {
      return (*function)(p[0], p[1], p[2]).cast<double>();
    } catch (const py::error_already_set&) {
      errors->keep(std::current_exception());
    } catch (const py::cast_error&) {
      errors->keep(std::make_exception_ptr(py::type_error("a size function has to return a number")));
    }
    throw std::runtime_error("a size function has failed");  // ends the refinement; what is raised is what was kept
  };
}

pgdr::Sizing_grid grid_of(const std::array<double, 3>& lower, const std::array<double, 3>& upper, const std::array<std::size_t, 3>& shape) {
  pgdr::Sizing_grid grid;
  grid.origin = lower;
  grid.nodes = shape;
  for (std::size_t k = 0; k < 3; ++k) grid.spacing[k] = shape[k] > 1 ? (upper[k] - lower[k]) / static_cast<double>(shape[k] - 1) : 0;
  return grid;
}

}  // namespace

pgdr::Combined_sizing_field sizing_of(const py::object& size, const py::object& facet_sizes, const std::optional<double>& curvature, const std::optional<double>& cells_across, double gradation,
                                    const pgdr::Domain_3<pgdr::Default_kernel>& domain, const std::shared_ptr<First_error>& errors) {
  pgdr::Uniform_sizing_field everywhere;
  std::vector<pgdr::Combined_sizing_field::Function> functions;
  if (size.is_none()) {
  } else if (py::isinstance<pgdr::Grid_sizing_field>(size)) {
    functions.emplace_back([grid = size.cast<pgdr::Grid_sizing_field>()](const std::array<double, 3>& p) { return grid(Point{p}); });
  } else if (py::isinstance<pgdr::Nodal_sizing_field>(size)) {
    functions.emplace_back([nodes = size.cast<pgdr::Nodal_sizing_field>()](const std::array<double, 3>& p) { return nodes.size_at(p); });
  } else if (PyCallable_Check(size.ptr())) {
    functions.push_back(function_of(size, errors));
  } else {
    const double radius = size.cast<double>();
    if (!(radius > 0)) throw py::value_error("size has to be positive");
    everywhere = pgdr::Uniform_sizing_field(radius);
  }
  std::vector<pgdr::Distance_sizing_field> by_distance;
  if (!facet_sizes.is_none())
    for (const auto& [marker, radius] : facet_sizes.cast<py::dict>()) {
      const std::string name = py::str(marker);
      try {
        by_distance.push_back(pgdr::facet_sizes(domain, pgdr::markers_named(domain, name), radius.cast<double>(), gradation, everywhere.radius()));
      } catch (const std::invalid_argument& error) {
        throw py::value_error("facet_sizes, '" + name + "': " + error.what());
      }
    }
  const auto add = [&](const char* name, const std::optional<double>& number, const auto& fields_for) {
    try {
      if (number) std::ranges::move(fields_for(domain, *number, gradation, everywhere.radius()), std::back_inserter(by_distance));
    } catch (const std::invalid_argument& error) {
      throw py::value_error(std::string(name) + ": " + error.what());
    }
  };
  add("curvature", curvature, pgdr::curvature_sizes);
  add("cells_across", cells_across, pgdr::local_feature_sizes);
  return pgdr::Combined_sizing_field(pgdr::Combined_sizing_field::Local(everywhere, {}, {}, pgdr::Combined_sizing_field::Local::no_gradation), std::move(by_distance),
                                   std::move(functions));
}

void add_fields(py::module_& module) {
  using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;
  py::class_<pgdr::Nodal_sizing_field>(module, "Nodes", R"(Sizes at any points, such as the nodes of a mesh: linear in between, in their Delaunay triangulation; outside of it, that of the nearest point.

Parameters
----------
points : array of shape (n, 3)
values : array of shape (n,)
    Upper bounds of the circumradius there, positive and finite.)")
      .def(py::init([](const Values& points, const std::vector<double>& values) {
             if (points.ndim() != 2 || points.shape(1) != 3) throw py::value_error("points has to have the shape (n, 3)");
             std::vector<std::array<double, 3>> nodes;
             const auto at = points.unchecked<2>();
             for (py::ssize_t i = 0; i < points.shape(0); ++i) nodes.push_back({at(i, 0), at(i, 1), at(i, 2)});
             return pgdr::Nodal_sizing_field(nodes, values);
           }),
           py::arg("points"), py::arg("values"))
      .def(
          "__call__", [](const pgdr::Nodal_sizing_field& nodes, double x, double y, double z) { return nodes.size_at({x, y, z}); }, py::arg("x"), py::arg("y"),
          py::arg("z"));
  py::class_<pgdr::Grid_sizing_field>(module, "Grid", R"(Sizes at the nodes of a regular grid, trilinear in between and, outside of it, those of its nearest point.

Parameters
----------
lower, upper : three floats each
    First and last node.
values : array of shape (nx, ny, nz), at least 2 in each direction
    Upper bounds of the circumradius there, positive and finite.
gradation : float, optional
    Lets sizes grow by no more than this for each unit of distance.)")
      .def(py::init([](const std::array<double, 3>& lower, const std::array<double, 3>& upper, const Values& values, std::optional<double> gradation) {
             if (values.ndim() != 3) throw py::value_error("values has to have the shape (nx, ny, nz)");
             const auto n = [&](int k) { return static_cast<std::size_t>(values.shape(k)); };
             const pgdr::Sizing_grid grid = grid_of(lower, upper, {n(0), n(1), n(2)});
             std::vector<double> in_order;  // x runs fastest
             in_order.reserve(grid.size());
             const auto at = values.unchecked<3>();
             for (py::ssize_t k = 0; k < values.shape(2); ++k)
               for (py::ssize_t j = 0; j < values.shape(1); ++j)
                 for (py::ssize_t i = 0; i < values.shape(0); ++i) in_order.push_back(at(i, j, k));
             const pgdr::Grid_sizing_field field(grid, std::move(in_order));
             return gradation ? field.graded(*gradation) : field;
           }),
           py::arg("lower"), py::arg("upper"), py::arg("values"), py::kw_only(), py::arg("gradation") = py::none())
      .def(
          "__call__", [](const pgdr::Grid_sizing_field& grid, double x, double y, double z) { return grid(Point{{x, y, z}}); }, py::arg("x"), py::arg("y"),
          py::arg("z"));
}

}  // namespace pgdr_python
