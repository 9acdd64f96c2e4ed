// SPDX-License-Identifier: GPL-3.0-or-later
#include "simplify_in_stages.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <pgdr/domain/input_error.h>

namespace pgdr::simplify_detail {

namespace {

// What the parts of the whole may change, each, so that all together stay within the tolerance: two simplifications, and two passes whose
// stages add up to 10/9 of the last: 2 * 1/4 + 2 * 10/9 * 1/5 < 1.
constexpr double for_simplification = 0.25;
constexpr double for_planarization = 0.2;
constexpr double step = 10;  ///< how much wider each pass is than the one before
/// How often the widest pass fuses triangles, and that of noise where it is the only one. Once is enough for planes, but leaves needles beside them (a30:
/// 49,326 exempt tetrahedra instead of 5,244; a29 has 3 % more of all). Passes before it fuse once, since the next one fuses anew, and so does what finishes:
/// of 145 models, beside twice for all, within 1e-4 of the diagonal 4 % fewer tetrahedra, 9 % fewer exempt ones and 15 % less time to read and simplify,
/// within 1e-3 5 % more, 2 % fewer and 38 % less.
constexpr int fusings = 2;

}  // namespace

Simplification_stages::Simplification_stages(double tolerance, double diagonal, double coplanar_tolerance, bool triangulate)
    : tolerance_(tolerance), coplanar_tolerance_(coplanar_tolerance), triangulate_(triangulate) {
  // From narrow to wide: facets that are nearly plane are plane before they are seen as parts of wider ones. All at once, a wing section
  // of 900 strips has 707 facets that cannot be made plane at 1e-4 of its diagonal; in stages it has 2.
  double pass = for_planarization * tolerance / diagonal;
  if (!(coplanar_tolerance > 0 && pass > coplanar_tolerance)) return;
  while (pass > coplanar_tolerance) {
    passes_.push_back(pass);
    pass /= step;
  }
  passes_.push_back(coplanar_tolerance);
  std::ranges::reverse(passes_);
}

Stage Simplification_stages::make_plane(const Plc& plc, const Stage* noise_only) const {
  const bool is_first_known = noise_only && !passes_.empty() && noise_only->done.simplification.is_none();
  Stage stage{is_first_known ? noise_only->plc : plc, {}, {}};
  if (is_first_known) stage.done.planarization = noise_only->done.planarization;
  for (std::size_t i = is_first_known ? 1 : 0; i < passes_.size(); ++i)
    planarize_within(stage, passes_[i], i + 1 < passes_.size() ? 1 : fusings);
  return stage;
}

bool Simplification_stages::take_away(Stage& stage, std::optional<int> most_rounds) const {
  if (!take_away_once(stage, most_rounds)) return false;
  if (passes_.empty()) return true;
  planarize_within(stage, passes_.back(), fusings);
  take_away_once(stage, most_rounds);  // where two planes became one, what was between them is left as edges a thousandth as long
  return true;
}

void Simplification_stages::finish(Stage& stage) const { planarize_within(stage, coplanar_tolerance_, passes_.empty() ? fusings : 1); }

bool Simplification_stages::take_away_once(Stage& stage, std::optional<int> most_rounds) const {
  Simplification now;
  stage.plc = simplify(stage.plc, passes_.empty() ? tolerance_ : for_simplification * tolerance_, &now, most_rounds);
  if (now.is_none()) return false;
  stage.known = {};
  auto& done = stage.done.simplification;
  done.facets = now.facets;
  done.collapsed_edges += now.collapsed_edges;
  done.removed_needles += now.removed_needles;
  done.largest_change += now.largest_change;
  return true;
}

void Simplification_stages::planarize_within(Stage& stage, double coplanar_tolerance, int fusings_at_most) const {
  try {
    Planarization now;
    stage.plc = planarize(stage.plc, coplanar_tolerance, triangulate_, &now, &stage.known, fusings_at_most);
    auto& done = stage.done.planarization;
    done.flattened_facets += now.flattened_facets;
    done.bent_facets = now.bent_facets;
    done.moved_vertices += now.moved_vertices;
    done.largest_change += now.largest_change;
  } catch (const Input_error&) {
    // Fused this wide, facets are not valid; what is wrong with the input itself is said when that is understood.
    stage.known = {};
  }
}

}  // namespace pgdr::simplify_detail
