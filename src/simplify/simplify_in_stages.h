// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIMPLIFY_SIMPLIFY_IN_STAGES_H
#define PGDR_SIMPLIFY_SIMPLIFY_IN_STAGES_H

#include <optional>
#include <vector>

#include <pgdr/simplify/simplify_within.h>

namespace pgdr::simplify_detail {

/// A PLC and what was done to get there.
struct Stage {
  Plc plc;
  Simplification_within done;
  Planarized known;  ///< of `plc`
};

/// What `simplify_within` does with one tolerance, step by step, without looking at what comes of it: it may be invalid where features are closer to each
/// other than the tolerance, or worse than before.
class Simplification_stages {
 public:
  Simplification_stages(double tolerance, double diagonal, double coplanar_tolerance, bool triangulate);

  /// Makes plane what is nearly so.
  /// \param noise_only what all of this did to the same PLC for a tolerance of noise, if that is known: where nothing was taken away then, it is the first pass of any other
  Stage make_plane(const Plc& plc, const Stage* noise_only = nullptr) const;
  /// Takes needles and short edges away, and makes plane what is nearly so after that. Whether there were any.
  /// \param most_rounds as `simplify`
  bool take_away(Stage& stage, std::optional<int> most_rounds = std::nullopt) const;
  /// Fuses what is to be fused in the end.
  void finish(Stage& stage) const;

 private:
  bool take_away_once(Stage& stage, std::optional<int> most_rounds) const;
  void planarize_within(Stage& stage, double coplanar_tolerance, int fusings_at_most) const;

  double tolerance_, coplanar_tolerance_;
  bool triangulate_;
  std::vector<double> passes_;  ///< from narrow to wide; none where nothing is fused, so that planes are of no use
};

}  // namespace pgdr::simplify_detail

#endif
