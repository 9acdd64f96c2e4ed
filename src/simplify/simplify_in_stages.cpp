// SPDX-License-Identifier: GPL-3.0-or-later
#include "simplify_in_stages.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <pgdr/domain/input_error.h>

namespace pgdr::simplify_detail {

namespace {

// What the parts of the whole may change, each, so that all together stay within the tolerance: two simplifications, and two passes whose
// stages add up to 10/9 of the last: 2 * 1/4 + 2 * 10/9 * 1/5 < 1.
constexpr double for_simplification = 0.25;
constexpr double for_planarization = 0.2;
constexpr double stage = 10;  ///< how much wider each stage of a pass is than the one before

/// From narrow to wide: facets that are nearly plane are plane before they are seen as parts of wider ones. All at once, a wing section
/// of 900 strips has 707 facets that cannot be made plane at 1e-4 of its diagonal; in stages it has 2.
class Planarization_passes {
 public:
  Planarization_passes(double last, double coplanar_tolerance, bool triangulate) : triangulate_(triangulate) {
    double t = last;
    while (t > coplanar_tolerance) {
      stages_.push_back(t);
      t /= stage;
    }
    stages_.push_back(coplanar_tolerance);
    std::ranges::reverse(stages_);
  }

  /// \param first what the narrowest does
  void run(Plc& plc, Planarization& done, const Stage* first) const {
    if (first) {
      plc = first->plc;
      done = first->done.planarization;
    }
    for (std::size_t i = first ? 1 : 0; i < stages_.size(); ++i) one(plc, stages_[i], done);
  }
  /// Where something was taken away since.
  void repeat_widest(Plc& plc, Planarization& done) const { one(plc, stages_.back(), done); }
  /// What is fused in the end.
  void finish(Stage& stage) const { one(stage.plc, stages_.front(), stage.done.planarization, &stage.domain); }

 private:
  void one(Plc& plc, double tolerance, Planarization& done, std::optional<Domain_3<Default_kernel>>* domain = nullptr) const {
    try {
      Planarization now;
      plc = planarize(plc, tolerance, triangulate_, &now, domain);
      done.flattened_facets += now.flattened_facets;
      done.bent_facets = now.bent_facets;
      done.moved_vertices += now.moved_vertices;
      done.largest_change += now.largest_change;
    } catch (const Input_error&) {
      // Fused this wide, facets are not valid; what is wrong with the input itself is said when that is understood.
    }
  }

  bool triangulate_;
  std::vector<double> stages_;
};

}  // namespace

Stage simplify_in_stages(const Plc& plc, double tolerance, double coplanar_tolerance, bool triangulate, const Stage* noise_only) {
  Stage result{plc, {}, std::nullopt};
  Simplification_within& report = result.done;
  const double diagonal = bounding_diagonal(plc);
  if (!(tolerance > 0) || !(diagonal > 0)) return result;
  const double last = for_planarization * tolerance / diagonal;
  const bool is_wide = coplanar_tolerance > 0 && last > coplanar_tolerance;  // where nothing is fused, planes are of no use
  const Planarization_passes passes(is_wide ? last : coplanar_tolerance, coplanar_tolerance, triangulate);
  const auto take_away = [&] {
    Simplification now;
    result.plc = simplify(result.plc, is_wide ? for_simplification * tolerance : tolerance, &now);
    if (now.is_none()) return false;
    report.simplification.facets = now.facets;
    report.simplification.collapsed_edges += now.collapsed_edges;
    report.simplification.removed_needles += now.removed_needles;
    report.simplification.largest_change += now.largest_change;
    return true;
  };
  if (is_wide) passes.run(result.plc, report.planarization, noise_only && noise_only->done.simplification.is_none() ? noise_only : nullptr);
  if (take_away() && is_wide) {
    passes.repeat_widest(result.plc, report.planarization);
    take_away();  // where two planes became one, what was between them is left as edges a thousandth as long
  }
  passes.finish(result);
  return result;
}

}  // namespace pgdr::simplify_detail
