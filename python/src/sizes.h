// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_PYTHON_SIZES_H
#define PGDR_PYTHON_SIZES_H

#include <exception>
#include <memory>
#include <mutex>
#include <optional>

#include <pybind11/pybind11.h>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/sizing/combined_sizing_field.h>

namespace pgdr_python {

/// The first exception of a Python function that the refinement called, kept until a Python thread can raise it.
class First_error {
 public:
  /// Keeps an exception, if it is the first. \pre holds the GIL
  void keep(std::exception_ptr error);
  /// \pre holds the GIL
  void rethrow();

 private:
  std::mutex mutex_;
  std::exception_ptr error_;
};

/// The sizing field of the arguments `size` (None, a number, a function of x, y and z, or a Grid) and `facet_sizes` (None, or a dictionary from
/// markers, numbers or names, to sizes), `curvature` (edges around a full turn) and `cells_across` (edges
/// across what is narrow) of `mesh`. Functions are called with the GIL held. \pre holds the GIL
pgdr::Combined_sizing_field sizing_of(const pybind11::object& size, const pybind11::object& facet_sizes, const std::optional<double>& curvature, const std::optional<double>& cells_across, double gradation,
                                    const pgdr::Domain_3<pgdr::Default_kernel>& domain, const std::shared_ptr<First_error>& errors);

/// Adds the classes Grid and Nodes.
void add_fields(pybind11::module_& module);

}  // namespace pgdr_python

#endif
