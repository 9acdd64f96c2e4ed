// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_SIMPLIFY_IN_STAGES_H
#define PGDR_SIMPLIFY_SIMPLIFY_IN_STAGES_H

#include <optional>

#include <pgdr/simplify/simplify_within.h>

namespace pgdr::simplify_detail {

/// A PLC and what was done to get there.
struct Stage {
  Plc plc;
  Simplification_within done;
  std::optional<Domain_3<Default_kernel>> domain;  ///< as `planarize` gives it
};

/// What `simplify_within` does with one tolerance, without looking at what came of it: it may be invalid where features are closer to each other
/// than the tolerance, or worse than before.
/// \param noise_only what this did to the same PLC for a tolerance of noise: where nothing was simplified then, it is the first stage of any other
Stage simplify_in_stages(const Plc& plc, double tolerance, double coplanar_tolerance, bool triangulate, const Stage* noise_only = nullptr);

}  // namespace pgdr::simplify_detail

#endif
