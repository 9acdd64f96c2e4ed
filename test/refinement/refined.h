// SPDX-License-Identifier: GPL-3.0-or-later
// Short names for what most tests of the front door do.
#ifndef PGDR_TEST_REFINEMENT_REFINED_H
#define PGDR_TEST_REFINEMENT_REFINED_H

#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <pgdr/quality/check_mesh.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/refine_mesh_3.h>

#include "mesh/random.h"

namespace pgdr_test {

using Mesh = pgdr::Refined_mesh_3<pgdr::Default_kernel>;

/// `size` bounds the circumradii; by default nothing does.
inline Mesh refined(const pgdr::Plc& plc, double size = std::numeric_limits<double>::infinity(),
                    const pgdr::Parameters& parameters = {}) {
  return pgdr::refine_mesh_3(plc, pgdr::Uniform_sizing_field(size), parameters);
}

/// The lines of the checker that failed, one below the other.
inline std::string failures(const std::vector<pgdr::Check_line>& lines) {
  std::string s;
  for (const auto& line : lines)
    if (!line.passed) s += line.property + ": " + line.detail + "\n";
  return s;
}

inline std::set<std::int32_t> distinct(const std::vector<std::int32_t>& references) {
  return {references.begin(), references.end()};
}

}  // namespace pgdr_test

#endif
