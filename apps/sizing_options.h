// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_SIZING_OPTIONS_H
#define PGDR_APPS_SIZING_OPTIONS_H

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <pgdr/sizing/combined_sizing_field.h>

#include "read_domain.h"

namespace pgdr::app {

/// How fine a mesh is, as typed. All options are upper bounds of circumradii: where several hold, the smallest wins.
struct Sizing_options {
  std::string size;
  std::string edge_length;
  std::string max_volume;
  std::vector<std::string> refine_boxes;
  std::vector<std::string> size_balls;
  std::string near_surface;
  std::vector<std::string> facet_sizes;
  std::string cells_across;
  std::string curvature;
  std::string expression;
  std::string field_file;
  std::string gradation;

  /// Adds them; the object must outlive the parsing.
  void add_to(CLI::App& parser);

  /// Refuses nonsense before anything is read. Throws `Usage_error`.
  void check() const;

  /// Warns of places outside of the domain on stderr. Throws `Usage_error` for markers that no facet has.
  Combined_sizing_field field(const Domain& domain) const;

 private:
  Combined_sizing_field::Local local() const;
};

}  // namespace pgdr::app

#endif
