// SPDX-License-Identifier: GPL-3.0-or-later
//
// Refines the unit cube to a given size on one thread, then lets CGAL build the Delaunay triangulation of the same
// vertices in bulk, and prints the ratio of the two times: what refinement costs over knowing the points beforehand.
//
// usage: bulk_construction [SIZE [REPETITIONS]]     default 0.017 (about a million tetrahedra), 3

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <CGAL/Delaunay_triangulation_3.h>

#include <pgdr/refine_mesh_3.h>
#include <pgdr/report/memory.h>

namespace {

using Kernel = pgdr::Default_kernel;

pgdr::Plc unit_cube() {
  pgdr::Plc cube;
  for (int i = 0; i < 8; ++i) cube.vertices.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  using Polygon = std::vector<pgdr::Index>;
  for (const Polygon& side : {Polygon{0, 2, 3, 1}, Polygon{4, 5, 7, 6}, Polygon{0, 1, 5, 4}, Polygon{2, 6, 7, 3},
                              Polygon{0, 4, 6, 2}, Polygon{1, 3, 7, 5}})
    cube.facets.push_back({{side}, {}, 0});
  return cube;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
  const double size = argc > 1 ? std::atof(argv[1]) : 0.017;
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 3;
  std::vector<double> ratios;
  for (int i = 0; i < repetitions; ++i) {
    std::vector<Kernel::Point_3> points;
    double refinement = 0;
    std::size_t cells = 0;
    {
      pgdr::Parameters parameters;
      parameters.threads = 1;  // bulk construction without locks has one, too
      const auto mesh = pgdr::refine_mesh_3(unit_cube(), pgdr::Uniform_sizing_field(size), parameters);
      for (const auto& [phase, s] : mesh.statistics().seconds) refinement += s;
      cells = mesh.triangulation().number_of_finite_cells();
      const auto& tr = mesh.triangulation();
      for (auto v = tr.finite_vertices_begin(); v != tr.finite_vertices_end(); ++v) points.push_back(v->point());
    }
    const auto start = std::chrono::steady_clock::now();
    const CGAL::Delaunay_triangulation_3<Kernel> bulk(points.begin(), points.end());
    const double construction = seconds_since(start);
    ratios.push_back(refinement / construction);
    std::printf("%9zu tetrahedra  refinement %7.3f s, %.3f M/s  bulk construction %7.3f s (%zu)  ratio %.3f\n", cells,
                refinement, 1e-6 * static_cast<double>(cells) / refinement, construction,
                static_cast<std::size_t>(bulk.number_of_finite_cells()), ratios.back());
  }
  std::sort(ratios.begin(), ratios.end());
  std::printf("median ratio %.3f, peak memory of both %.0f MB\n", ratios[ratios.size() / 2],
              1e-6 * static_cast<double>(pgdr::peak_memory_bytes()));
}
