// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_CURVATURE_SIZES_H
#define PGDR_SIZING_CURVATURE_SIZES_H

#include <limits>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/sizing/distance_sizing_field.h>

namespace pgdr {

/// Edges at which a surface turns by more, in degrees, are features, not the trace of a curved surface.
constexpr double feature_angle_deg = 40;

/// Bounds in proportion to the radius of curvature of the surface that a tessellated input stands for, all of which hold.
///
/// Where two facets meet, and no others, with an angle t < `feature_angle_deg` between their normals, the radius is h / t, with h the mean height of their
/// triangles over the common segment: chords of a circle turn by half of the sum of their angles, so that this is right for a cylinder of strips, equal or not, and
/// two thirds to one and a half times as much on a sphere of nearly equal triangles. Tetrahedra that touch these triangles have edges so short that `edges_per_turn` of them make a full turn: circumradii of at most the length of the turn
/// over that number and `mean_edge`. Around them the bound grows as
/// around `facet_sizes`. Radii within a factor of sqrt(2) make one field, with the smallest of them.
/// \param gradation above 0 and below 1
/// \param largest no bound above this one is needed
/// Throws `std::invalid_argument` for numbers without sense. Empty where nothing is curved.
std::vector<Distance_sizing_field> curvature_sizes(const Domain_3<Default_kernel>& domain, double edges_per_turn, double gradation = 0.5,
                                                   double largest = std::numeric_limits<double>::infinity());

}  // namespace pgdr

#endif
