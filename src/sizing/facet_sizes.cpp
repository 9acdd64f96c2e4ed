// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/facet_sizes.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <pgdr/domain/scale.h>

namespace pgdr {

Distance_sizing_field::Triangle facet_triangle_of(const Domain_3<Default_kernel>& domain, const std::array<Index, 3>& corners) {
  const double unit = unit_of(domain);
  Distance_sizing_field::Triangle triangle;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& p = domain.vertices[corners[i]];
    triangle[i] = {unit * p.x(), unit * p.y(), unit * p.z()};
  }
  return triangle;
}

std::vector<Distance_sizing_field::Triangle> facet_triangles_of(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers) {
  std::vector<Distance_sizing_field::Triangle> triangles;
  for (const auto& facet : domain.facets) {
    if (!markers.empty() && std::ranges::find(markers, facet.marker) == markers.end()) continue;
    for (const auto& t : facet.triangles) triangles.push_back(facet_triangle_of(domain, t));
  }
  return triangles;
}

std::vector<int> markers_named(const Domain_3<Default_kernel>& domain, const std::string& text) {
  std::vector<int> markers;
  for (const auto& [marker, name] : domain.names.markers)
    if (name == text) markers.push_back(marker);
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  if (markers.empty() && last == end && error == std::errc()) markers.push_back(number);
  return markers;
}

Distance_sizing_field sizes_around(const Domain_3<Default_kernel>& domain, const std::vector<Distance_sizing_field::Triangle>& triangles, double radius,
                                   double gradation, double largest) {
  if (!(0 < gradation && gradation < 1)) throw std::invalid_argument("the gradation around facets must be above 0 and below 1");
  const double near = (1 - gradation) * radius;
  // No circumcenter that counts is farther away than that.
  const double far = std::max(near, std::min(largest, near + 2 * gradation * unit_of(domain) * domain.diagonal));
  return Distance_sizing_field(triangles, near, far, far > near ? (far - near) / gradation : 1);
}

Distance_sizing_field facet_sizes(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers, double radius, double gradation, double largest) {
  const auto triangles = markers.empty() ? std::vector<Distance_sizing_field::Triangle>{} : facet_triangles_of(domain, markers);
  if (triangles.empty()) throw std::invalid_argument("no facet has the marker");
  return sizes_around(domain, triangles, radius, gradation, largest);
}

}  // namespace pgdr
