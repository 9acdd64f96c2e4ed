// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/facet_sizes.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <pgdr/domain/scale.h>

namespace pgdr {

namespace {

/// What `sizes_around` says, as a `Distance_sizing_field` takes it.
struct Growth {
  Growth(const Domain_3<Default_kernel>& domain, double radius, double gradation, double largest, double margin = 0) {
    if (!(0 < gradation && gradation < 1)) throw std::invalid_argument("the gradation must be above 0 and below 1");
    near = radius - gradation * std::max(0.0, radius - margin);
    // No circumcenter that counts is farther away than that.
    far = std::max(near, std::min(largest, near + 2 * gradation * unit_of(domain) * domain.diagonal));
    reach = far > near ? (far - near) / gradation : 1;
  }

  double near, far, reach;
};

bool is_among(int marker, const std::vector<int>& markers) { return markers.empty() || std::ranges::find(markers, marker) != markers.end(); }

std::array<double, 3> in_users_unit(const Domain_3<Default_kernel>& domain, Index vertex) {
  const double unit = unit_of(domain);
  const auto& p = domain.vertices[vertex];
  return {unit * p.x(), unit * p.y(), unit * p.z()};
}

}  // namespace

Distance_sizing_field::Triangle facet_triangle_of(const Domain_3<Default_kernel>& domain, const std::array<Index, 3>& corners) {
  return {in_users_unit(domain, corners[0]), in_users_unit(domain, corners[1]), in_users_unit(domain, corners[2])};
}

std::vector<Distance_sizing_field::Triangle> facet_triangles_of(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers) {
  std::vector<Distance_sizing_field::Triangle> triangles;
  for (const auto& facet : domain.facets) {
    if (!is_among(facet.marker, markers)) continue;
    for (const auto& t : facet.triangles) triangles.push_back(facet_triangle_of(domain, t));
  }
  return triangles;
}

std::vector<Distance_sizing_field::Segment> segments_of(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers) {
  std::vector<Distance_sizing_field::Segment> segments;
  for (const auto& s : domain.segments)
    if (is_among(s.marker, markers)) segments.push_back({in_users_unit(domain, s.vertices[0]), in_users_unit(domain, s.vertices[1])});
  return segments;
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
                                   double gradation, double largest, double margin) {
  const Growth growth(domain, radius, gradation, largest, margin);
  return Distance_sizing_field(triangles, growth.near, growth.far, growth.reach, margin);
}

std::vector<Distance_sizing_field> sizes_around_each(const Domain_3<Default_kernel>& domain, std::vector<Sized_triangle> triangles, double gradation, double largest,
                                                     double margin_per_radius) {
  std::erase_if(triangles, [](const Sized_triangle& t) { return !Distance_sizing_field::has_area(t.triangle); });
  std::ranges::stable_sort(triangles, {}, &Sized_triangle::radius);
  std::vector<Distance_sizing_field> fields;
  std::vector<Distance_sizing_field::Triangle> alike;
  for (std::size_t first = 0, end = 0; first < triangles.size() && triangles[first].radius < largest; first = end) {
    alike.clear();
    for (; end < triangles.size() && triangles[end].radius <= std::numbers::sqrt2 * triangles[first].radius; ++end) alike.push_back(triangles[end].triangle);
    fields.push_back(sizes_around(domain, alike, triangles[first].radius, gradation, largest, margin_per_radius * triangles[end - 1].radius));
  }
  return fields;
}

Distance_sizing_field facet_sizes(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers, double radius, double gradation, double largest) {
  const auto triangles = markers.empty() ? std::vector<Distance_sizing_field::Triangle>{} : facet_triangles_of(domain, markers);
  if (triangles.empty()) throw std::invalid_argument("no facet has the marker");
  return sizes_around(domain, triangles, radius, gradation, largest);
}

Distance_sizing_field segment_sizes(const Domain_3<Default_kernel>& domain, const std::vector<int>& markers, double radius, double gradation, double largest) {
  const auto segments = segments_of(domain, markers);
  if (segments.empty()) throw std::invalid_argument(markers.empty() ? "there are no segments" : "no segment has the marker");
  const Growth growth(domain, radius, gradation, largest);
  return Distance_sizing_field::from_segments(segments, growth.near, growth.far, growth.reach);
}

}  // namespace pgdr
