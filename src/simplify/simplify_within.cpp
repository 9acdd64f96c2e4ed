// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/simplify/simplify_within.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <pgdr/domain/domain_3.h>
#include <pgdr/domain/input_error.h>
#include <pgdr/domain/scale.h>
#include <pgdr/domain/small_angles_3.h>
#include <pgdr/domain/valid_domain.h>
#include <pgdr/domain/validate_domain_3.h>

#include "simplify_in_stages.h"

namespace pgdr {

namespace {

/// How often a corner of a facet would have to be halved to get from the angle above which the bound on the ratio can hold to its own, with fractions.
/// Tetrahedra that needles cost go by it, about a thousand for each: a knob (a26) has 7,546 of them, all together, and 7.0 million, after 1e-4d 385 and 0.5; cones17 710
/// and 0.6, or 1,145 and 0.9.
double halvings(double angle_deg) {
  constexpr double least = 1e-9;
  double n = 0;
  for (double angle = Small_angles::critical_plane_angle_deg; angle_deg < angle && angle > least; angle /= 2) n += std::min(1.0, angle / std::max(angle_deg, least) - 1);
  return n;
}

/// What makes elements small in a domain.
struct Narrowness {
  double lowest = std::numeric_limits<double>::infinity();  ///< height of the lowest triangle of the facets
  double corners = 0;  ///< `halvings` of all corners of facets
  double facets = 0;   ///< how many, fused
};

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
std::optional<Understood> valid(simplify_detail::Stage& stage, double coplanar_tolerance, bool triangulate) {
  if (!stage.domain) return valid(stage.plc, coplanar_tolerance, triangulate);
  Understood understood{std::move(*std::exchange(stage.domain, std::nullopt)), {}};
  understood.problems = validate_domain_3(understood.domain);
  if (!understood.is_valid()) return std::nullopt;
  return understood;
}

Narrowness narrowness(const Domain_3<Default_kernel>& domain) {
  std::vector<Vec_3> points;
  for (const auto& p : domain.vertices) points.push_back(to_vec(p));
  Narrowness n;
  for (const auto& facet : domain.facets)
    for (const auto& t : facet.triangles)
      for (int i = 0; i < 3; ++i)
        n.lowest = std::min(n.lowest, std::sqrt(squared_distance_to_line(points[t[i]], points[t[(i + 1) % 3]], points[t[(i + 2) % 3]])));
  n.facets = static_cast<double>(domain.facets.size());
  for (const auto& corner : domain_detail::Facet_edges(domain).corners(points)) n.corners += halvings(corner.angle_deg);
  return n;
}

/// Whether a wider tolerance has made matters worse: a vertex that came next to an edge, or narrower corners altogether, that are not outweighed by facets
/// that are gone.
bool is_worse(const Narrowness& now, const Narrowness& noise_only, double tolerance) {
  constexpr double much_lower = 0.01;  // of the tolerance, and below half of what there was
  // A facet of a scan gets about five tetrahedra (a05 5.3, a14 5.1, a11 7), a halving about a thousand.
  constexpr double facets_of_halving = 200;
  return (now.lowest < much_lower * tolerance && now.lowest < noise_only.lowest / 2) || now.corners - noise_only.corners > (noise_only.facets - now.facets) / facets_of_halving;
}

}  // namespace

Plc simplify_within(const Plc& plc, double tolerance, double coplanar_tolerance, bool triangulate, Simplification_within* done) {
  Simplification_within ignored;
  Simplification_within& report = done ? *done : ignored;
  report = {};
  if (!(tolerance > 0)) return plc;
  if (exponent_for(plc) != 0) return simplify_within(normalized(plc), tolerance, coplanar_tolerance, triangulate, done);
  const double fused = coplanar_tolerance * bounding_diagonal(plc), limit = tolerance + fused, unit = unit_of(plc);
  const bool is_wide = fused > 0 && tolerance > fused;
  simplify_detail::Stage noise = simplify_detail::simplify_in_stages(plc, is_wide ? fused : tolerance, coplanar_tolerance, triangulate);
  // What moves vertices looks itself whether the result is valid, so that it is not understood for that; what takes them away does not know what is fused.
  std::optional<Understood> before;
  if (is_wide || noise.domain || !noise.done.simplification.is_none()) before = valid(noise, coplanar_tolerance, triangulate);
  if (is_wide) {
    std::optional<Narrowness> narrow;
    if (before) narrow = narrowness(before->domain);
    // What each step may do adds up to the tolerance, but mostly they use a third of it; so twice as much is tried first, and measured.
    for (int attempt = 0;; ++attempt) {
      const double within = std::ldexp(tolerance, attempt == 0 ? 1 : 2 - 2 * attempt);
      if (!(within > fused)) break;
      simplify_detail::Stage wide = simplify_detail::simplify_in_stages(plc, within, coplanar_tolerance, triangulate, &noise);
      if (wide.done.is_none()) break;
      auto now = valid(wide, coplanar_tolerance, triangulate);
      // Less will hardly mend what is not valid as it is, and tries cost seconds.
      if (!now && !before && !valid(plc, coplanar_tolerance, triangulate)) break;
      if (!now || (narrow && is_worse(narrowness(now->domain), *narrow, std::min(within, tolerance) / unit))) continue;
      const auto distance = surface_distance(plc, wide.plc, limit / unit);
      if (!distance || !distance->is_within) continue;
      report = wide.done;
      report.limit = limit;
      report.distance = {unit * distance->seen, true, unit * distance->at};
      report.understood = std::move(now);
      return std::move(wide.plc);
    }
  }
  if (before || noise.done.simplification.is_none()) {
    report = noise.done;
    report.understood = std::move(before);
    return noise.plc;
  }
  try {
    return planarize(plc, coplanar_tolerance, triangulate, &report.planarization);
  } catch (const Input_error&) {
    return plc;  // what is wrong with it is said when it is understood
  }
}

Plc simplify_as_far_as_valid(const Plc& plc, double tolerance, double& coplanar_tolerance, bool triangulate, Simplification_within* done) {
  constexpr double narrower = 0.1, narrowest = 1e-9;
  Simplification_within ignored;
  Simplification_within& report = done ? *done : ignored;
  Plc result = simplify_within(plc, tolerance, coplanar_tolerance, triangulate, &report);
  const auto is_valid = [&] {  // what was made plane is known to be
    if (report.planarization.is_none() && !report.understood) report.understood = valid(result, coplanar_tolerance, triangulate);
    return !report.planarization.is_none() || report.understood;
  };
  if (!(coplanar_tolerance > 0) || is_valid() || !valid(plc, 0, triangulate)) return result;
  do {
    coplanar_tolerance = coplanar_tolerance > narrowest ? narrower * coplanar_tolerance : 0;
    result = simplify_within(plc, tolerance, coplanar_tolerance, triangulate, &report);
  } while (coplanar_tolerance > 0 && !is_valid());
  return result;
}

}  // namespace pgdr
