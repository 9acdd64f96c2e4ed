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
/// At the distance d from the triangles the field is `radius` - g (`radius` - d), with the gradation g. A circumcenter is no farther from the triangles than a
/// vertex there, so d <= r for the circumradius r, and r <= (1 - g) `radius` + g r, which is r <= `radius`. With a margin the field stays at what it is on the
/// triangles up to that distance, and that is `radius` - g (`radius` - `margin`), if this is less than `radius`.
/// \param gradation g, above 0 and below 1
/// \param largest no bound above this one is needed: a bound everywhere
/// \param margin not negative and finite
/// Throws `std::invalid_argument` for sizes without sense.
Distance_sizing_field sizes_around(const Domain_3<Default_kernel>& domain, const std::vector<Distance_sizing_field::Triangle>& triangles, double radius,
                                   double gradation = 0.5, double largest = std::numeric_limits<double>::infinity(), double margin = 0);

/// A triangle and the circumradius of what touches it.
struct Sized_triangle {
  Distance_sizing_field::Triangle triangle;
  double radius;
};

/// The same where each triangle has a bound of its own, and a margin of `margin_per_radius` times as much: those within a factor of sqrt(2) make one field, with the
/// smallest bound and the largest margin of them. Bounds that are not below `largest` are left out, and triangles
/// without an area.
std::vector<Distance_sizing_field> sizes_around_each(const Domain_3<Default_kernel>& domain, std::vector<Sized_triangle> triangles, double gradation = 0.5,
                                                     double largest = std::numeric_limits<double>::infinity(), double margin_per_radius = 0);

/// `sizes_around` for the facets with one of some markers. Throws `std::invalid_argument` where there are none, too.
Distance_sizing_field facet_sizes(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers, double radius, double gradation = 0.5,
                                  double largest = std::numeric_limits<double>::infinity());

/// The same for the segments with one of some markers, or all of them where there are none. Throws `std::invalid_argument` where there is no segment, too.
Distance_sizing_field segment_sizes(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers, double radius, double gradation = 0.5,
                                    double largest = std::numeric_limits<double>::infinity());

}  // namespace pgdr

#endif
