// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/simplify/simplify_within.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/input_error.h>
#include <pgdr/domain/scale.h>
#include <pgdr/domain/valid_domain.h>
#include <pgdr/domain/validate_domain_3.h>
#include <pgdr/simplify/narrowness.h>

#include "simplify_in_stages.h"

namespace pgdr {

namespace {

using simplify_detail::Stage;

/// None if the PLC is not valid.
std::optional<Understood> valid(const Plc& plc, double coplanar_tolerance, bool triangulate) {
  try {
    Understood understood = understand(plc, coplanar_tolerance, triangulate);
    if (understood.is_valid()) return understood;
  } catch (const Input_error&) {  // not even understood
  }
  return std::nullopt;
}

/// The same for its PLC, and takes its domain.
std::optional<Understood> valid(Stage& stage, double coplanar_tolerance, bool triangulate) {
  Planarized known = std::exchange(stage.known, {});
  if (!known.domain) return valid(stage.plc, coplanar_tolerance, triangulate);
  if (!known.problems) known.problems = validate_domain_3(*known.domain);
  Understood understood{std::move(*known.domain), std::move(*known.problems)};
  if (!understood.is_valid()) return std::nullopt;
  return understood;
}

/// How much more than without is as good, of what tetrahedra are expected.
constexpr double as_good = 0.01;

/// What a domain is expected to cost, beside one `without` anything done. New needles count for more than the most that those of an input have cost: there may be no
/// end next to them (a30 with 1e-4d, 57 halvings more).
double cost(const Narrowness& n, const std::optional<Narrowness>& without) {
  constexpr double for_new_halving = 2000;
  return n.tetrahedra() + (without ? for_new_halving * std::max(0.0, n.halvings - without->halvings) : 0);
}

/// For taking vertices away from what is enough without.
constexpr int few_rounds = 4;

/// Whether nothing needs to be taken away from what was made plane: it has no needles, and half the tetrahedra at most.
bool is_enough(const Stage& planes, const std::optional<Narrowness>& without) {
  if (!planes.known.domain || !without) return false;
  const Narrowness n = narrowness(*planes.known.domain);
  return n.halvings == 0 && n.tetrahedra() < without->tetrahedra() / 2;
}

/// What may come of it.
struct Candidate {
  Candidate(Stage s, Understood u, bool all) : stage(std::move(s)), understood(std::move(u)), narrow(narrowness(understood.domain)), is_all(all) {}
  Stage stage;
  Understood understood;
  Narrowness narrow;
  bool is_all;  ///< that can be done, not planes alone
  double within = 0;
  std::optional<Surface_distance> distance;
};

}  // namespace

Plc simplify_within(const Plc& plc, double tolerance, double coplanar_tolerance, bool triangulate, Simplification_within* done) {
  Simplification_within ignored;
  Simplification_within& report = done ? *done : ignored;
  report = {};
  report.used = tolerance;
  if (!(tolerance > 0)) return plc;
  if (exponent_for(plc) != 0) return simplify_within(normalized(plc), tolerance, coplanar_tolerance, triangulate, done);
  const double diagonal = bounding_diagonal(plc), fused = coplanar_tolerance * diagonal, limit = tolerance + fused, unit = unit_of(plc);
  if (!(diagonal > 0)) return plc;
  const bool is_wide = fused > 0 && tolerance > fused;
  const auto stages_within = [&](double t) { return simplify_detail::Simplification_stages(t, diagonal, coplanar_tolerance, triangulate); };
  const simplify_detail::Simplification_stages of_noise = stages_within(is_wide ? fused : tolerance);
  Stage noise = of_noise.make_plane(plc);
  of_noise.take_away(noise);
  of_noise.finish(noise);
  // What moves vertices looks itself whether the result is valid, so that it is not understood for that; what takes them away does not know what is fused.
  std::optional<Understood> before;
  if (is_wide || noise.known.domain || !noise.done.simplification.is_none()) before = valid(noise, coplanar_tolerance, triangulate);
  if (is_wide) {
    std::optional<Narrowness> narrow;
    if (before) narrow = narrowness(before->domain);
    // What each step may do adds up to the tolerance, but mostly they use a third of it; so twice as much is tried first, and measured.
    double within = 2 * tolerance;
    std::optional<Candidate> best;
    for (int attempt = 0; within > fused; ++attempt) {
      const simplify_detail::Simplification_stages stages = stages_within(within);
      Stage planes = stages.make_plane(plc, &noise);
      std::vector<Candidate> candidates;
      const auto look_at = [&](Stage& stage, bool is_all) {
        stages.finish(stage);
        if (auto now = valid(stage, coplanar_tolerance, triangulate)) candidates.emplace_back(std::move(stage), std::move(*now), is_all);
      };
      // Where planes are enough, no time is spent on what cannot be taken away without leaving needles.
      Stage others{planes.plc, planes.done, {}};
      const std::optional<int> most_rounds = is_enough(planes, narrow) ? std::optional(few_rounds) : std::nullopt;
      const bool is_taken = stages.take_away(others, most_rounds), is_all = !is_taken && !most_rounds;
      if (is_all && planes.done.is_none()) break;
      if (is_taken) look_at(others, true);
      // Taking vertices away can leave needles, above all where strips end.
      if (candidates.empty() || candidates[0].narrow.halvings > 0) look_at(planes, is_all);
      // Less will hardly mend what is not valid as it is, and tries cost seconds.
      if (candidates.empty() && !before && !valid(plc, coplanar_tolerance, triangulate)) break;
      std::ranges::stable_sort(candidates, {}, [&](const Candidate& c) { return cost(c.narrow, narrow); });
      const double most = best ? cost(best->narrow, narrow) : narrow ? (1 + as_good) * narrow->tetrahedra() : std::numeric_limits<double>::infinity();
      bool is_better = false;
      for (Candidate& c : candidates) {
        if (cost(c.narrow, narrow) > most) break;
        c.distance = surface_distance(plc, c.stage.plc, limit / unit);
        if (!c.distance || !c.distance->is_within) continue;
        is_better = !best || cost(c.narrow, narrow) < most;
        best = std::move(c);
        best->within = std::min(within, tolerance);
        break;
      }
      // Planes alone may be better when they are not sought as widely.
      if (best && (best->is_all || !is_better)) break;
      within *= attempt % 2 == 0 ? 0.5 : 0.2;
    }
    if (best) {
      report = best->stage.done;
      report.used = best->within;
      report.limit = limit;
      report.distance = {unit * best->distance->seen, true, unit * best->distance->at};
      report.understood = std::move(best->understood);
      return std::move(best->stage.plc);
    }
  }
  if (before || noise.done.simplification.is_none()) {
    report = noise.done;
    report.used = std::min(tolerance, fused);
    report.understood = std::move(before);
    return noise.plc;
  }
  try {
    return planarize(plc, coplanar_tolerance, triangulate, &report.planarization);
  } catch (const Input_error&) {
    return plc;  // what is wrong with it is said when it is understood
  }
}

Plc simplify_as_far_as_valid(const Plc& plc, double tolerance, double coplanar_tolerance, bool triangulate, Simplification_within* done) {
  Simplification_within ignored;
  Simplification_within& report = done ? *done : ignored;
  Plc result = simplify_within(plc, tolerance, coplanar_tolerance, triangulate, &report);
  if (!report.planarization.is_none()) return result;  // known to be valid
  if (!report.understood) report.understood = valid(result, coplanar_tolerance, triangulate);
  if (report.understood || !(coplanar_tolerance > 0)) return result;
  const std::optional<Plc> fused = fused_where_valid(plc, coplanar_tolerance, triangulate);
  return fused ? simplify_within(*fused, tolerance, coplanar_tolerance, triangulate, &report) : result;
}

}  // namespace pgdr
