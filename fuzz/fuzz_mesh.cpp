// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as a small PLC, meshed with at most 2,000 vertices on two threads and checked. What is valid is meshed, or a limit says why not.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include <pgdr/domain/input_error.h>
#include <pgdr/domain/scale.h>
#include <pgdr/quality/check_mesh.h>
#include <pgdr/refine_mesh_3.h>

#include "plc_of_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pgdr_fuzz::Bytes bytes(data, size);
  pgdr::Parameters parameters;
  parameters.max_vertices = 2000;
  parameters.threads = 2;
  parameters.time_limit = 1;  // a box of 1 by 2^40 is all exact arithmetic: slow, but it stops when it is told to
  parameters.verify = true;
  parameters.triangulate_facets = bytes.byte() & 1u;
  const unsigned size_code = bytes.byte();
  parameters.optimization_rounds = size_code >> 6u;
  pgdr::Plc plc = pgdr_fuzz::plc_of(bytes);
  const double radius = size_code & 3u ? std::numeric_limits<double>::infinity() : 0.5 + size_code / 16.0;
  try {
    const auto mesh = pgdr::refine_mesh_3(plc, pgdr::Uniform_sizing_field(radius), parameters);
    const auto indexed = pgdr::indexed_mesh_3(mesh);
    const bool is_done = mesh.statistics().stop == pgdr::Stop_reason::finished;
    if (is_done && mesh.statistics().unrecovered > 0) std::abort();
    if (!is_done || indexed.tetrahedra.empty()) return 0;
    for (const auto& line : pgdr::check_mesh(indexed, &mesh.domain()))
      if (!line.passed) {
        std::fprintf(stderr, "%s: %s\n", line.property.c_str(), line.detail.c_str());
        std::abort();
      }
  } catch (const pgdr::Input_error&) {
  }
  return 0;
}
