// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SIZING_FACET_SIZES_H
#define PGDR_SIZING_FACET_SIZES_H

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/domain_3.h>
#include <pgdr/sizing/distance_sizing_field.h>

namespace pgdr {

/// A triangle of a facet, in the user's unit of length.
Distance_sizing_field::Triangle facet_triangle_of(const Domain_3<Default_kernel>& domain, const std::array<Index, 3>& corners);

/// The triangles of the facets with one of some markers, or of all where there are none, in the user's unit of length.
std::vector<Distance_sizing_field::Triangle> facet_triangles_of(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers = {});

/// The segments with one of some markers, or all where there are none, in the user's unit of length.
std::vector<Distance_sizing_field::Segment> segments_of(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers = {});

/// The markers that a text means: all with that name, else the number that it is.
std::vector<int> markers_named(const Domain_3<Default_kernel>& domain, const std::string& text);

/// A bound for what touches some triangles on facets: tetrahedra with a vertex on them have circumradii of at most `radius`.
///
/// At the distance d from the triangles the field is (1 - g) `radius` + g d, with the gradation g. A circumcenter is no farther from the triangles than a
/// vertex there, so d <= r for the circumradius r, and r <= (1 - g) `radius` + g r, which is r <= `radius`.
/// \param gradation g, above 0 and below 1
/// \param largest no bound above this one is needed: a bound everywhere
/// Throws `std::invalid_argument` for sizes without sense.
Distance_sizing_field sizes_around(const Domain_3<Default_kernel>& domain, const std::vector<Distance_sizing_field::Triangle>& triangles, double radius,
                                   double gradation = 0.5, double largest = std::numeric_limits<double>::infinity());

/// The same for the facets with one of some markers. Throws `std::invalid_argument` where there are none, too.
Distance_sizing_field facet_sizes(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers, double radius, double gradation = 0.5,
                                  double largest = std::numeric_limits<double>::infinity());

/// The same for the segments with one of some markers, or all of them where there are none. Throws `std::invalid_argument` where there is no segment, too.
Distance_sizing_field segment_sizes(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers, double radius, double gradation = 0.5,
                                    double largest = std::numeric_limits<double>::infinity());

}  // namespace pgdr

#endif
