// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/domain/scale.h>
#include <pgdr/quality/mesh_quality.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include <pgdr/parallel/parallel_for.h>
#include <pgdr/parallel/parallel_reduce.h>
#include <pgdr/quality/compensated_sum.h>
#include <pgdr/quality/measures.h>
#include <pgdr/quality/shape_measures.h>

#include "dihedral_bins.h"

namespace pgdr {

namespace {

using quality_detail::Dihedral_bins;
using quality_detail::P;

template <std::size_t N>
void count(std::array<std::uint64_t, N>& histogram, double value, double width) {
  const double bin = value / width;
  ++histogram[bin < double(N) ? std::size_t(bin) : N - 1];
}

/// What is known of a tetrahedron whose figures doubles yield with the precision that `measures.h` promises.
struct Shape {
  double determinant;
  double squared_radius;
  double squared_shortest;
  std::array<double, 6> cosines;  ///< of the dihedral angles
  Shape_measures measures;
};

/// The worst and the sum of one of the `Shape_measures`; it is better the larger it is, or the smaller.
template <bool larger_is_better>
class Measure_sum {
 public:
  void add(double value) { add(value, value); }
  void add(const Measure_sum& o) { add(o.worst_, o.sum_); }
  Mesh_quality::Measure over(std::size_t count) const { return {worst_, sum_ / double(count)}; }

 private:
  void add(double worst, double sum) {
    worst_ = larger_is_better ? std::min(worst_, worst) : std::max(worst_, worst);
    sum_ += sum;
  }

  double worst_ = larger_is_better ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  double sum_ = 0;  ///< not compensated: chunks are short, and there are few of them
};

/// The shape of a tetrahedron that is far from flat and has no needle of a face; false for all others.
///
/// With det^2 >= 2e-5 |u|^2 |v|^2 |w|^2 the tests of `squared_circumradius` and `orientation_determinant` hold: their
/// error terms are at most 2 |u||v||w| and 2 sqrt(3) |u||v||w| (|u| + |v| + |w|), and the vector that the second one
/// stands for is |det| times the circumsphere's diameter long. The figures are then the same, bit for bit.
bool find_shape(const P& a, const P& b, const P& c, const P& d, Shape& shape) {
  namespace q = quality_detail;
  const auto u = q::difference<double>(b, a), v = q::difference<double>(c, a), w = q::difference<double>(d, a);
  const auto vw = q::cross(v, w);
  const double uu = q::dot(u, u), vv = q::dot(v, v), ww = q::dot(w, w), det = q::dot(u, vw);
  const double squared_det = det * det;
  if (!(squared_det >= 2e-5 * (uu * vv * ww) && squared_det > 1e-200 && squared_det < 1e200)) return false;
  const auto x = q::difference<double>(c, b), y = q::difference<double>(d, b), z = q::difference<double>(d, c);
  const double xx = q::dot(x, x), yy = q::dot(y, y), zz = q::dot(z, z);
  const auto wu = q::cross(w, u), uv = q::cross(u, v), xy = q::cross(x, y);
  const double squared_bcd = q::dot(xy, xy);
  if (!(squared_bcd >= 1e-8 * (xx * yy))) return false;

  double squared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double n = uu * vw[i] + vv * wu[i] + ww * uv[i];
    squared += n * n;
  }
  shape.determinant = det;
  shape.squared_radius = squared / (4 * det * det);
  shape.squared_shortest = std::min(std::min(std::min(uu, vv), std::min(ww, xx)), std::min(yy, zz));
  // Of the normals of the faces: two faces with normals m and n that point to one side meet at acos(-m.n / |m||n|).
  const double abc = std::sqrt(q::dot(uv, uv)), abd = std::sqrt(q::dot(wu, wu)), acd = std::sqrt(q::dot(vw, vw)),
               bcd = std::sqrt(squared_bcd);
  const double front = abc * abd, back = acd * bcd, inverse = 1 / (front * back);
  const double p = back * inverse, r = front * inverse;
  shape.measures = shape_measures({uu, vv, ww, xx, yy, zz}, (abc + abd + acd + bcd) / 2, det);
  shape.cosines = {-q::dot(uv, wu) * p,
                   -q::dot(uv, vw) * (abd * bcd * inverse),
                   -q::dot(wu, vw) * (abc * bcd * inverse),
                   q::dot(uv, xy) * (abd * acd * inverse),
                   q::dot(wu, xy) * (abc * acd * inverse),
                   q::dot(vw, xy) * r};
  return true;
}

/// The figures of a chunk of tetrahedra, and the sum of such.
class Quality_sum {
 public:
  Quality_sum() { q_.min_dihedral_deg = 180; }
  Quality_sum(const Quality_sum&) = delete;
  Quality_sum& operator=(const Quality_sum&) = delete;

  void add(const P& a, const P& b, const P& c, const P& d, std::int32_t region) {
    static const Dihedral_bins bins;
    Shape shape;
    if (find_shape(a, b, c, d, shape)) {
      add_angles(bins, a, b, c, d, shape);
    } else {
      shape.determinant = orientation_determinant(a, b, c, d);
      shape.squared_radius = squared_circumradius(a, b, c, d);
      shape.squared_shortest = squared_shortest_edge(a, b, c, d);
      shape.measures = shape_measures(a, b, c, d, shape.determinant);
      add_exact_angles(a, b, c, d);
    }
    const double squared_ratio = shape.squared_radius / shape.squared_shortest;
    max_squared_radius_ = std::max(max_squared_radius_, shape.squared_radius);
    max_squared_ratio_ = std::max(max_squared_ratio_, squared_ratio);
    min_squared_edge_ = std::min(min_squared_edge_, shape.squared_shortest);
    const double ratio = std::sqrt(squared_ratio);
    ratios_ += ratio;
    edge_ratio_.add(shape.measures.edge_ratio);
    aspect_ratio_.add(shape.measures.aspect_ratio);
    mean_ratio_.add(shape.measures.mean_ratio);
    scaled_jacobian_.add(shape.measures.scaled_jacobian);
    count(q_.ratio_histogram, ratio, Mesh_quality::ratio_bin);
    Region& sum = region_sum(region);
    sum.volume += shape.determinant / 6;
    ++sum.tetrahedra;
  }

  void add(const Quality_sum& o) {
    max_squared_radius_ = std::max(max_squared_radius_, o.max_squared_radius_);
    max_squared_ratio_ = std::max(max_squared_ratio_, o.max_squared_ratio_);
    min_squared_edge_ = std::min(min_squared_edge_, o.min_squared_edge_);
    q_.min_dihedral_deg = std::min(q_.min_dihedral_deg, o.q_.min_dihedral_deg);
    q_.max_dihedral_deg = std::max(q_.max_dihedral_deg, o.q_.max_dihedral_deg);
    for (std::size_t i = 0; i < q_.dihedral_histogram.size(); ++i)
      q_.dihedral_histogram[i] += o.q_.dihedral_histogram[i];
    for (std::size_t i = 0; i < q_.tetrahedra_below.size(); ++i) q_.tetrahedra_below[i] += o.q_.tetrahedra_below[i];
    for (std::size_t i = 0; i < q_.ratio_histogram.size(); ++i) q_.ratio_histogram[i] += o.q_.ratio_histogram[i];
    ratios_ += o.ratios_.value();
    edge_ratio_.add(o.edge_ratio_);
    aspect_ratio_.add(o.aspect_ratio_);
    mean_ratio_.add(o.mean_ratio_);
    scaled_jacobian_.add(o.scaled_jacobian_);
    for (const auto& [region, part] : o.regions_) {
      Region& sum = region_sum(region);
      sum.volume += part.volume.value();
      sum.tetrahedra += part.tetrahedra;
    }
  }

  Mesh_quality quality(const Indexed_mesh_3& mesh) const {
    Mesh_quality q = q_;
    q.vertices = mesh.points.size();
    q.edges = mesh.edges.size();
    q.triangles = mesh.triangles.size();
    q.tetrahedra = mesh.tetrahedra.size();
    const double unit = unit_of(mesh);
    q.max_circumradius = unit * std::sqrt(max_squared_radius_);
    q.max_radius_edge_ratio = std::sqrt(max_squared_ratio_);
    q.mean_radius_edge_ratio = ratios_.value() / double(q.tetrahedra);
    q.edge_ratio = edge_ratio_.over(q.tetrahedra);
    q.aspect_ratio = aspect_ratio_.over(q.tetrahedra);
    q.mean_ratio = mean_ratio_.over(q.tetrahedra);
    q.scaled_jacobian = scaled_jacobian_.over(q.tetrahedra);
    q.shortest_edge = unit * std::sqrt(min_squared_edge_);
    Compensated_sum volume;
    for (const auto& [region, sum] : regions_) {
      volume += sum.volume.value();
      q.region_volumes[region] = std::ldexp(sum.volume.value(), 3 * mesh.exponent);
      q.region_tetrahedra[region] = sum.tetrahedra;
    }
    q.volume = std::ldexp(volume.value(), 3 * mesh.exponent);
    return q;
  }

 private:
  struct Region {
    Compensated_sum volume;
    std::size_t tetrahedra = 0;
  };

  /// Bins by cosines. The angles themselves are computed where one may be a new extreme or is next to a boundary.
  void add_angles(const Dihedral_bins& bins, const P& a, const P& b, const P& c, const P& d, const Shape& shape) {
    std::array<int, 6> found;
    bool exact = false;
    for (std::size_t i = 0; i < 6; ++i) {
      found[i] = bins.find(shape.cosines[i]);
      exact = exact || found[i] == Dihedral_bins::unclear || shape.cosines[i] > max_cosine_ || shape.cosines[i] < min_cosine_;
    }
    if (exact) {
      add_exact_angles(a, b, c, d);
      for (const double cosine : shape.cosines) {
        max_cosine_ = std::max(max_cosine_, cosine);
        min_cosine_ = std::min(min_cosine_, cosine);
      }
      return;
    }
    for (const int bin : found) ++q_.dihedral_histogram[std::size_t(bin)];
    // Below 20 degrees, which of the small angles it is below.
    if (*std::ranges::min_element(found) <= last_small_bin) count_small(smallest_dihedral_angle_deg(a, b, c, d));
  }

  void add_exact_angles(const P& a, const P& b, const P& c, const P& d) {
    const auto angles = dihedral_angles_deg(a, b, c, d);
    count_small(*std::ranges::min_element(angles));
    for (const double angle : angles) {
      q_.min_dihedral_deg = std::min(q_.min_dihedral_deg, angle);
      q_.max_dihedral_deg = std::max(q_.max_dihedral_deg, angle);
      count(q_.dihedral_histogram, angle, Mesh_quality::dihedral_bin_deg);
    }
  }

  void count_small(double smallest) {
    for (std::size_t i = 0; i < q_.tetrahedra_below.size(); ++i) q_.tetrahedra_below[i] += smallest < Mesh_quality::small_angles_deg[i];
  }

  /// Neighbours in the list are mostly of one region.
  Region& region_sum(std::int32_t region) {
    if (last_ == regions_.end() || last_->first != region) last_ = regions_.try_emplace(region).first;
    return last_->second;
  }

  static constexpr int last_small_bin = static_cast<int>(Mesh_quality::small_angles_deg.back() / Mesh_quality::dihedral_bin_deg) - 1;

  Mesh_quality q_;
  double max_squared_radius_ = 0, max_squared_ratio_ = 0;
  double min_squared_edge_ = std::numeric_limits<double>::infinity();
  double max_cosine_ = -2, min_cosine_ = 2;  ///< of the shapes whose angles were computed
  Compensated_sum ratios_;
  Measure_sum<false> edge_ratio_, aspect_ratio_;
  Measure_sum<true> mean_ratio_, scaled_jacobian_;
  std::map<std::int32_t, Region> regions_;
  std::map<std::int32_t, Region>::iterator last_ = regions_.end();
};

}  // namespace

Mesh_quality mesh_quality(const Indexed_mesh_3& mesh) {
  if (mesh.tetrahedra.empty()) {
    Mesh_quality q;
    q.vertices = mesh.points.size();
    q.edges = mesh.edges.size();
    q.triangles = mesh.triangles.size();
    return q;
  }
  const auto measure = [&mesh](std::size_t first, std::size_t last) {
    auto sum = std::make_unique<Quality_sum>();
    for (std::size_t i = first; i < last; ++i) {
      const auto& t = mesh.tetrahedra[i];
      sum->add(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]],
               i < mesh.tetrahedron_references.size() ? mesh.tetrahedron_references[i] : 0);
    }
    return sum;
  };
  const auto sum = parallel_reduce(mesh.tetrahedra.size(), 4 * default_grain, std::make_unique<Quality_sum>(), measure,
                                   [](auto& all, auto&& part) {
                                     all->add(*part);
                                     part.reset();
                                   });
  return sum->quality(mesh);
}

}  // namespace pgdr
