// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_SIZE_ESTIMATE_H
#define PGDR_APPS_SIZE_ESTIMATE_H

#include <pgdr/sizing/combined_sizing_field.h>

#include "read_domain.h"

namespace pgdr::app {

/// Roughly how many vertices the sizes ask for, those of regions included, unless they are to be ignored: the volume by the cube of the size. Of a
/// box, only the part that is material counts, by a few hundred samples. What the ratio bound asks for comes on top of it.
double expected_vertices(const Domain& domain, const Combined_sizing_field& sizing, bool ignore_region_sizes);

/// Refuses what would not fit into `limit` bytes by far. Throws `Size_error`.
void require_memory(double vertices, std::size_t limit);

/// A mesh too large for the memory; `what()` is one sentence with the figures.
class Size_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pgdr::app

#endif
