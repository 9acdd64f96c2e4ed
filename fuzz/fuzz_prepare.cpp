// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as a small PLC, or an assembly of two, repaired and simplified: what either returns is valid, and simplifying keeps what is valid so.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <pgdr/domain/input_error.h>
#include <pgdr/domain/valid_domain.h>
#include <pgdr/repair/repair.h>
#include <pgdr/simplify/simplify_within.h>

#include "plc_of_bytes.h"

namespace {

/// Nothing if the PLC is valid, or the first thing that is wrong with it.
std::string what_is_wrong(const pgdr::Plc& plc, double coplanar_tolerance) {
  try {
    pgdr::valid_domain(plc, coplanar_tolerance, true);
    return {};
  } catch (const pgdr::Input_error& error) {
    return error.what();
  }
}

void require_valid(const pgdr::Plc& plc, double coplanar_tolerance, const char* how) {
  const std::string wrong = what_is_wrong(plc, coplanar_tolerance);
  if (wrong.empty()) return;
  std::fprintf(stderr, "not valid %s: %s\n", how, wrong.c_str());
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pgdr_fuzz::Bytes bytes(data, size);
  const unsigned mode = bytes.byte() % 4u, lengths = bytes.byte();
  std::vector<pgdr::Plc> parts{pgdr_fuzz::plc_of(bytes)};
  if (mode == 3) parts.push_back(pgdr_fuzz::plc_of(bytes));
  pgdr::Plc plc = parts[0];
  if (plc.vertices.empty()) return 0;
  const double diagonal = pgdr::bounding_diagonal(plc);
  const double tolerance = std::ldexp(diagonal, -2 - static_cast<int>(2 * (lengths % 16u)));
  const double hole = mode % 2u == 0 ? 0 : std::ldexp(diagonal, -static_cast<int>(lengths / 16u));
  if (mode > 0) {
    // Only surfaces are repaired, and seeds may be anywhere.
    for (pgdr::Plc& part : parts) {
      part.holes.clear();
      part.regions.clear();
      part.segments.clear();
    }
    try {
      pgdr::Repair_report report;
      plc = mode == 3 ? pgdr::assemble(parts, {tolerance, hole}, &report) : pgdr::repair(parts[0], {tolerance, hole}, &report);
      if (!report.is_none()) require_valid(plc, 0, "after repair");
    } catch (const pgdr::Input_error&) {
      return 0;
    }
  }
  double coplanar_tolerance = 1e-6;
  const bool was_valid = what_is_wrong(plc, coplanar_tolerance).empty();
  plc = pgdr::simplify_as_far_as_valid(plc, tolerance, coplanar_tolerance, true);
  if (was_valid) require_valid(plc, coplanar_tolerance, "after simplification");
  return 0;
}
