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

struct Sample {
  double density;
  double size;
};

/// The integral of the density over the part of a box that is in material, by samples: `at(p, volume)` is one, and sizes change by no more than
/// `slope` times the distance.
double integral(const Domain& domain, const Volumes_3<Default_kernel>& volumes, const Sizing_box& box, std::size_t samples, double slope, const auto& at) {
  constexpr std::size_t most_samples = 30'000;
  struct Cell {
    std::array<double, 3> center;
    double scale;  // beside those of the first grid
  };
  std::array<double, 3> lower{}, edge{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lower[axis] = std::max(box.lower[axis], domain.lower[axis]);
    edge[axis] = (std::min(box.upper[axis], domain.upper[axis]) - lower[axis]) / static_cast<double>(samples);
    if (!(edge[axis] > 0)) return 0;
  }
  const double half_diagonal = std::hypot(edge[0], edge[1], edge[2]) / 2, part = edge[0] * edge[1] * edge[2];
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < samples * samples * samples; ++i) {
    const std::array<std::size_t, 3> index{i % samples, i / samples % samples, i / (samples * samples)};
    Cell& cell = cells.emplace_back();
    cell.scale = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) cell.center[axis] = lower[axis] + edge[axis] * (static_cast<double>(index[axis]) + 0.5);
  }
  double sum = 0;
  // Breadth first. A cell is divided where the size may be half of that at its center, or much more.
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const Cell cell = cells[k];
    const auto& [x, y, z] = cell.center;
    const std::size_t v = volumes.locate({x, y, z});
    const bool is_inside = v != Volumes_3<Default_kernel>::none && volumes.volumes()[v].material;
    const Sample sample = at(cell.center, volumes.volumes()[is_inside ? v : 0]);
    if (sample.size < 2 * slope * cell.scale * half_diagonal && cells.size() < most_samples) {
      for (int corner = 0; corner < 8; ++corner) {
        Cell& child = cells.emplace_back(cell);
        child.scale /= 2;
        for (std::size_t axis = 0; axis < 3; ++axis) child.center[axis] += (corner >> axis & 1 ? 0.5 : -0.5) * child.scale * edge[axis];
      }
    } else if (is_inside && sample.density > 0) {
      sum += part * cell.scale * cell.scale * cell.scale * sample.density;
    }
  }
  return sum;
}

/// Of the layer in which sizes grow with the distance from a surface, which samples may miss: what touches it has near / (1 - slope), or near if that is the size farther
/// than that away.
double count_near(const Distance_sizing_field& field, double volume, double unit) {
  const double near = field.near() / unit, far = field.far() / unit, slope = (field.far() - field.near()) / field.reach();
  const double margin = field.margin() / unit, touching = margin < near ? (near - slope * margin) / (1 - slope) : near;
  if (!(touching < far)) return 0;
  const double across = count(margin, touching) + (1 / touching / touching - 1 / far / far) / (2 * slope);
  return std::min(field.area(unit) * across, count(volume, near));
}

/// `place` in the coordinates of the domain.
Sizing_box scaled(Sizing_box place, double unit) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place.lower[axis] /= unit;
    place.upper[axis] /= unit;
  }
  place.radius /= unit;
  return place;
}

Sizing_box box_around(const Sizing_ball& ball) {
  Sizing_box box{ball.center, ball.center, ball.radius};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] -= ball.extent;
    box.upper[axis] += ball.extent;
  }
  return box;
}

}  // namespace

double expected_vertices(const Domain& domain, const Combined_sizing_field& sizing, bool ignore_region_sizes) {
  constexpr std::size_t in_place = 8, in_all = 16;  // samples along each axis
  const Combined_sizing_field::Local& local = sizing.local();
  const double unit = unit_of(domain), everywhere = local.outer().radius() / unit;
  std::vector<Sizing_box> places;
  for (const Sizing_box& box : local.boxes()) places.push_back(scaled(box, unit));
  for (const Sizing_ball& ball : local.balls())
    if (ball.extent > 0) places.push_back(scaled(box_around(ball), unit));
  const bool is_gradual = !sizing.near_surfaces().empty() || !sizing.functions().empty() || local.gradation() < Combined_sizing_field::Local::no_gradation;
  if (everywhere == infinity && places.empty() && !is_gradual && domain.regions.empty()) return 0;  // nothing asks for a size: the volumes need not be found
  const Volumes_3<Default_kernel> volumes(domain);
  if (volumes.volumes().empty()) return 0;
  const auto without_places = [&](const Volume& v) { return std::min(everywhere, size_of(v, ignore_region_sizes)); };
  double sum = 0, volume = 0;
  for (const Volume& v : volumes.volumes())
    if (v.material) {
      sum += count(v.volume, without_places(v));
      volume += v.volume;
    }
  // What the fields ask for beyond that, of each point once: in the first of the places that hold it, or outside of all.
  const auto more = [&](const std::array<double, 3>& p, const Volume& v, std::size_t place) -> Sample {
    const auto end = places.begin() + static_cast<std::ptrdiff_t>(place);
    if (std::any_of(places.begin(), end, [&p](const Sizing_box& box) { return box.contains(p); })) return {0, infinity};
    const double size = sizing(Default_kernel::Point_3(unit * p[0], unit * p[1], unit * p[2])) / unit, coarse = without_places(v);
    if (!(size < coarse)) return {0, size};
    const double density = count(1, size);
    return {density < infinity ? density - count(1, coarse) : infinity, size};
  };
  double slope = local.gradation() < Combined_sizing_field::Local::no_gradation ? local.gradation() : 0;
  for (const Distance_sizing_field& field : sizing.near_surfaces()) slope = std::max(slope, (field.far() - field.near()) / field.reach());
  const auto more_in = [&](const Sizing_box& box, std::size_t place, std::size_t samples) {
    return integral(domain, volumes, box, samples, slope, [&](const auto& p, const Volume& v) { return more(p, v, place); });
  };
  for (std::size_t k = 0; k < places.size(); ++k) sum += more_in(places[k], k, in_place);
  if (is_gradual) sum += more_in({domain.lower, domain.upper, 0}, places.size(), in_all);
  for (const Distance_sizing_field& field : sizing.near_surfaces()) sum = std::max(sum, count_near(field, volume, unit));
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
