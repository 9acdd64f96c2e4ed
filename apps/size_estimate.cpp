// SPDX-License-Identifier: GPL-3.0-or-later
#include "size_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <pgdr/domain/scale.h>
#include <pgdr/domain/volumes_3.h>
#include <pgdr/report/format.h>

namespace pgdr::app {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The circumradius that a bound on volumes comes to: tetrahedra of a mesh by size have about 0.16 of its cube on average, and those at a bound
/// are twice as large.
double size_of_volume(double volume) { return volume > 0 ? std::cbrt(3 * volume) : infinity; }

double size_of(const Volume& v, bool ignore_region_sizes) {
  const double by_radius = v.max_circumradius > 0 ? v.max_circumradius : infinity;
  return std::min(by_radius, ignore_region_sizes ? infinity : size_of_volume(v.max_volume));
}

double count(double volume, double size) { return volume / size / size / size; }

/// What the k-th box adds, which is finer than the later ones.
double count_in_box(const Domain& domain, const Volumes_3<Default_kernel>& volumes, const std::vector<Sizing_box>& boxes,
                    std::size_t k) {
  constexpr std::size_t samples = 8;  // along each axis
  std::array<double, 3> lower{}, edge{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lower[axis] = std::max(boxes[k].lower[axis], domain.lower[axis]);
    edge[axis] = std::min(boxes[k].upper[axis], domain.upper[axis]) - lower[axis];
    if (!(edge[axis] > 0)) return 0;
  }
  const double part = edge[0] * edge[1] * edge[2] / (samples * samples * samples);
  double sum = 0;
  for (std::size_t i = 0; i < samples * samples * samples; ++i) {
    const std::array<std::size_t, 3> at{i % samples, i / samples % samples, i / (samples * samples)};
    std::array<double, 3> p{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[axis] = lower[axis] + edge[axis] * (static_cast<double>(at[axis]) + 0.5) / samples;
    const auto finer = boxes.begin() + static_cast<std::ptrdiff_t>(k);
    if (std::any_of(boxes.begin(), finer, [&p](const Sizing_box& box) { return box.contains(p); })) continue;
    const Default_kernel::Point_3 point(p[0], p[1], p[2]);
    const std::size_t v = volumes.locate(point);
    if (v != Volumes_3<Default_kernel>::none && volumes.volumes()[v].material) sum += count(part, boxes[k].radius);
  }
  return sum;
}

}  // namespace

double expected_vertices(const Domain& domain, const Command_line_sizing& sizing, bool ignore_region_sizes) {
  const double unit = unit_of(domain), size = sizing.outer()(Default_kernel::Point_3(0, 0, 0)) / unit;
  std::vector<Sizing_box> boxes = sizing.boxes();
  if (size == infinity && boxes.empty() && domain.regions.empty()) return 0;  // nothing asks for a size: the volumes need not be found
  const Volumes_3<Default_kernel> volumes(domain);
  for (Sizing_box& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.lower[axis] /= unit;
      box.upper[axis] /= unit;
    }
    box.radius /= unit;
  }
  double sum = 0;
  for (const Volume& v : volumes.volumes())
    if (v.material) sum += count(v.volume, std::min(size, size_of(v, ignore_region_sizes)));
  for (std::size_t k = 0; k < boxes.size(); ++k) sum += count_in_box(domain, volumes, boxes, k);
  return sum;
}

void require_memory(double vertices, std::size_t limit) {
  // 160 bytes for each of six tetrahedra (docs/performance.md), and the estimate is right within a tenth on real models.
  constexpr double bytes_by_vertex = 970, doubt = 1.25;
  const double bytes = vertices * bytes_by_vertex;
  if (limit == 0 || !(bytes > doubt * static_cast<double>(limit))) return;
  const std::string figures = std::isfinite(bytes) ? "about " + significant(vertices, 2) + " vertices, which take " +
                                                         significant(bytes / std::exp2(30), 2) + " GiB of memory"
                                                   : "more vertices than can be counted";
  throw Size_error("these sizes ask for " + figures + ", and the limit is " + memory_size(limit) +
                   ": nothing was done (--max-vertices stops where it is told to, --max-memory moves the limit)");
}

}  // namespace pgdr::app
