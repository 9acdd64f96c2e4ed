// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/sizing/local_feature_sizes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <pgdr/domain/detail/have_common.h>
#include <pgdr/domain/detail/triangle_soup.h>
#include <pgdr/domain/detail/vector_3.h>
#include <pgdr/domain/scale.h>
#include <pgdr/domain/volumes_3.h>
#include <pgdr/parallel/parallel_for.h>
#include <pgdr/sizing/edge_length.h>
#include <pgdr/sizing/facet_sizes.h>

namespace pgdr {

namespace {

using namespace domain_detail;
using Domain = Domain_3<Default_kernel>;
using Corners = std::array<Vec_3, 3>;

/// Part of a triangle of a facet, and how wide what is meshed is there.
struct Piece {
  Corners corners;
  double width;
};

/// How wide the volumes of a domain are between their facets.
class Widths {
 public:
  explicit Widths(const Domain& domain) : domain_(domain), soup_(domain), volumes_(domain) {
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) triangles_.push_back(soup_.triangle(t));
    tree_.insert(triangles_.cbegin(), triangles_.cend());
    tree_.build();
  }

  std::size_t triangles() const { return triangles_.size(); }

  /// On both sides of a triangle, where that is less than `most`.
  std::vector<Piece> pieces(std::size_t triangle, double most) const {
    const auto& c = soup_.triangles[triangle];
    const Index f = soup_.facet[triangle];
    const Vec_3 normal = to_vec(domain_.facets[f].normal);
    std::vector<Piece> result;
    for (const bool is_front : {true, false})
      if (volumes_.volumes()[volumes_.beside(f, triangle - soup_.offset[f], is_front)].material)
        add_pieces(f, is_front ? normal : -1.0 * normal, {soup_.points[c[0]], soup_.points[c[1]], soup_.points[c[2]]}, most, result);
    return result;
  }

 private:
  using Triangles = std::vector<Work_kernel::Triangle_3>;

  /// What a ray into a volume meets first.
  struct Sight {
    double distance = std::numeric_limits<double>::infinity();
    double width = std::numeric_limits<double>::infinity();  ///< from its plane, if it faces where the ray comes from
  };

  Sight sight(Index facet, const Vec_3& from, const Vec_3& inward) const {
    const Work_kernel::Ray_3 ray(to_work_point(from), Work_kernel::Vector_3(inward.x, inward.y, inward.z));
    const auto facet_of = [&](Triangles::const_iterator t) { return soup_.facet[static_cast<std::size_t>(t - triangles_.cbegin())]; };
    const auto hit = tree_.first_intersected_primitive(ray, [&](Triangles::const_iterator t) { return facet_of(t) == facet; });
    if (!hit) return {};
    constexpr double slanted = 0.5;  // the cosine of 60 degrees
    const Index other = facet_of(*hit);
    const Vec_3 normal = to_vec(domain_.facets[other].normal);
    const double steepness = std::abs(dot(normal, inward)), away = std::abs(dot(normal, to_vec(domain_.facets[other].origin) - from));
    const bool faces = steepness >= slanted && !have_common(domain_.facets[facet].vertices, domain_.facets[other].vertices);
    return {steepness > 0 ? away / steepness : 0, faces ? away : std::numeric_limits<double>::infinity()};
  }

  /// Adds the parts of a triangle where the volume is narrow: the triangle itself if it is as narrow everywhere, in which case true is returned.
  bool add_pieces(Index facet, const Vec_3& inward, const Corners& c, double most, std::vector<Piece>& pieces) const {
    const Vec_3 center = (1.0 / 3) * (c[0] + c[1] + c[2]);
    double radius = 0;
    for (const Vec_3& corner : c) radius = std::max(radius, length(corner - center));
    const Sight there = sight(facet, center, inward);
    const bool is_narrow = there.width < most;
    if (radius <= std::max(accuracy * std::min(there.distance, most), (is_narrow ? smallest : step) * domain_.diagonal)) {
      if (is_narrow) pieces.push_back({c, there.width});
      return is_narrow;
    }
    // Where the longest edge is bisected, needles become better.
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (squared_distance(c[(i + 1) % 3], c[(i + 2) % 3]) > squared_distance(c[(k + 1) % 3], c[(k + 2) % 3])) k = i;
    const Vec_3 &a = c[(k + 1) % 3], &b = c[(k + 2) % 3], middle = 0.5 * (a + b);
    const std::size_t first = pieces.size();
    const bool is_first_whole = add_pieces(facet, inward, {c[k], a, middle}, most, pieces);
    const bool is_second_whole = add_pieces(facet, inward, {c[k], middle, b}, most, pieces);
    if (!is_first_whole || !is_second_whole || pieces.size() != first + 2) return false;
    const auto [least, largest] = std::minmax(pieces[first].width, pieces[first + 1].width);
    if (largest > (1 + accuracy) * least) return false;
    pieces[first] = {c, least};
    pieces.pop_back();
    return true;
  }

  static constexpr double accuracy = 1.0 / 3;     // of a width, that is measured once for what is within a third of it
  static constexpr double smallest = 1 / 2048.0;  // piece, in diagonals: a foil as large as the domain is some million of them, and more tetrahedra than fit
  static constexpr double step = 1 / 128.0;       // the same where facets meet: what is narrow next to there has facets of its own

  const Domain& domain_;
  Triangle_soup soup_;
  Volumes_3<Default_kernel> volumes_;
  Triangles triangles_;
  Aabb_triangle_tree<Work_kernel> tree_;
};

}  // namespace

std::vector<Distance_sizing_field> local_feature_sizes(const Domain& domain, double cells_across, double gradation, double largest) {
  if (!(cells_across > 0 && std::isfinite(cells_across))) throw std::invalid_argument("the number of cells across has to be positive and finite");
  const double unit = unit_of(domain), size_per_width = 1 / cells_across / mean_edge;
  const double most = std::min(largest / unit / size_per_width, domain.diagonal);
  const Widths widths(domain);
  std::vector<std::vector<Piece>> pieces(widths.triangles());
  parallel_for(0, pieces.size(), [&](std::size_t t) { pieces[t] = widths.pieces(t, most); });
  std::vector<Sized_triangle> sized;
  for (const auto& of_triangle : pieces)
    for (const auto& [c, width] : of_triangle) sized.push_back({{to_array(unit * c[0]), to_array(unit * c[1]), to_array(unit * c[2])}, unit * width * size_per_width});
  return sizes_around_each(domain, std::move(sized), gradation, largest, 0.5 / size_per_width);
}

}  // namespace pgdr
