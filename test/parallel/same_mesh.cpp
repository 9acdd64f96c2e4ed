// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that comes after the refinement: right, and the same for every number of threads.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/io/read_plc.h>
#include <pgdr/io/write_mesh.h>
#include <pgdr/parallel/thread_arena.h>
#include <pgdr/quality/check_mesh.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/refine_mesh_3.h>

#include "../catch.h"
#include "../inputs.h"
#include "../io/temporary_folder.h"
#include "../thread_counts.h"

using pgdr::Indexed_mesh_3;

namespace {

using Refined = pgdr::Refined_mesh_3<pgdr::Default_kernel>;
using Tetrahedron = std::array<std::uint32_t, 4>;

Refined refined(const std::string& shape, double size) {
  return pgdr::refine_mesh_3(pgdr::read_plc(pgdr_test::data_file(shape)), pgdr::Uniform_sizing_field(size));
}

/// The smallest of a tetrahedron's even permutations, found by trying all.
Tetrahedron smallest_even_permutation(const Tetrahedron& t) {
  Tetrahedron best = t;
  for (const auto& p : {std::array<std::size_t, 4>{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 0, 3, 2}, {1, 2, 0, 3},
                        {1, 3, 2, 0}, {2, 0, 1, 3}, {2, 1, 3, 0}, {2, 3, 0, 1}, {3, 0, 2, 1}, {3, 1, 0, 2}, {3, 2, 1, 0}})
    best = std::min(best, Tetrahedron{t[p[0]], t[p[1]], t[p[2]], t[p[3]]});
  return best;
}

/// The meshed cells of the triangulation with the vertex numbers of `mesh`, sorted, and their region ids.
std::vector<std::pair<Tetrahedron, std::int32_t>> cells_of(const Refined& refined, const Indexed_mesh_3& mesh) {
  std::map<std::array<double, 3>, std::uint32_t> number;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) number[mesh.points[v]] = v;
  REQUIRE(number.size() == mesh.points.size());
  std::vector<std::pair<Tetrahedron, std::int32_t>> cells;
  const auto& tr = refined.triangulation();
  for (auto c = tr.finite_cells_begin(); c != tr.finite_cells_end(); ++c) {
    if (c->subdomain() == 0) continue;
    Tetrahedron t;
    for (int i = 0; i < 4; ++i) {
      const auto& p = c->vertex(i)->point();
      t[std::size_t(i)] = number.at({p.x(), p.y(), p.z()});
    }
    cells.emplace_back(smallest_even_permutation(t), refined.subdomains()[std::size_t(c->subdomain())].id);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

void check_canonical(const Refined& refined, const Indexed_mesh_3& mesh) {
  const auto cells = cells_of(refined, mesh);
  REQUIRE(mesh.tetrahedra.size() == cells.size());
  REQUIRE(mesh.tetrahedron_references.size() == cells.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
    different += mesh.tetrahedra[i] != cells[i].first || mesh.tetrahedron_references[i] != cells[i].second;
  CHECK(different == 0);
  CHECK(std::is_sorted(mesh.triangles.begin(), mesh.triangles.end()));
  CHECK(std::is_sorted(mesh.edges.begin(), mesh.edges.end()));
  // Domain vertices come first, in the order of the input.
  std::size_t corners = 0;
  for (const auto& p : refined.domain().vertices) {
    const bool next = corners < mesh.points.size() && mesh.points[corners] == std::array<double, 3>{p.x(), p.y(), p.z()};
    corners += next;
  }
  CHECK(corners == std::size_t(std::count(mesh.point_dimensions.begin(), mesh.point_dimensions.end(), 0)));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) REQUIRE((mesh.point_dimensions[v] == 0) == (v < corners));
}

bool same(const Indexed_mesh_3& a, const Indexed_mesh_3& b) {
  return a.points == b.points && a.point_references == b.point_references &&
         a.point_dimensions == b.point_dimensions && a.edges == b.edges && a.edge_references == b.edge_references &&
         a.triangles == b.triangles && a.triangle_references == b.triangle_references &&
         a.tetrahedra == b.tetrahedra && a.tetrahedron_references == b.tetrahedron_references && a.exempt == b.exempt;
}

bool same(const pgdr::Mesh_quality::Measure& a, const pgdr::Mesh_quality::Measure& b) { return a.worst == b.worst && a.mean == b.mean; }

bool same(const pgdr::Mesh_quality& a, const pgdr::Mesh_quality& b) {
  return a.max_radius_edge_ratio == b.max_radius_edge_ratio && a.mean_radius_edge_ratio == b.mean_radius_edge_ratio &&
         a.max_circumradius == b.max_circumradius && a.shortest_edge == b.shortest_edge &&
         a.min_dihedral_deg == b.min_dihedral_deg && a.max_dihedral_deg == b.max_dihedral_deg &&
         a.volume == b.volume && a.region_volumes == b.region_volumes && a.region_tetrahedra == b.region_tetrahedra &&
         a.dihedral_histogram == b.dihedral_histogram && a.ratio_histogram == b.ratio_histogram && same(a.edge_ratio, b.edge_ratio) &&
         same(a.aspect_ratio, b.aspect_ratio) && same(a.mean_ratio, b.mean_ratio) && same(a.scaled_jacobian, b.scaled_jacobian);
}

}  // namespace

TEST_CASE("the arrays, figures and files of a mesh are the same for every number of threads", "[parallel]") {
  const Refined mesh = refined("two_regions.poly", 0.035);
  const Indexed_mesh_3 expected = pgdr::with_threads(1, [&] { return pgdr::indexed_mesh_3(mesh); });
  REQUIRE(expected.tetrahedra.size() > 200'000);
  check_canonical(mesh, expected);
  const auto quality = pgdr::with_threads(1, [&] { return pgdr::mesh_quality(expected); });
  CHECK(quality.region_tetrahedra.size() == 2);
  const auto checksum = pgdr::with_threads(1, [&] { return pgdr::mesh_checksum(expected); });

  const pgdr_test::Temporary_folder folder;
  std::string medit, vtu;
  for (const unsigned threads : pgdr_test::thread_counts()) {
    INFO(threads << " threads");
    pgdr::with_threads(threads, [&] {
      const Indexed_mesh_3 again = pgdr::indexed_mesh_3(mesh);
      CHECK(same(again, expected));
      CHECK(same(pgdr::mesh_quality(again), quality));
      CHECK(pgdr::mesh_checksum(again) == checksum);
      pgdr::write_mesh(again, folder / "out.mesh");
      pgdr::write_mesh(again, folder / "out.vtu");
    });
    // Not by CHECK: megabytes of text would be copied into the message.
    const std::string new_medit = pgdr_test::content_of(folder / "out.mesh");
    const std::string new_vtu = pgdr_test::content_of(folder / "out.vtu");
    if (threads == 1) medit = new_medit, vtu = new_vtu;
    CHECK(medit.size() > 1'000'000);
    CHECK((new_medit == medit));
    CHECK((new_vtu == vtu));
  }
}

TEST_CASE("where most cells are outside, and some tetrahedra exempt", "[parallel]") {
  for (const char* shape : {"l_block.poly", "cavity.poly", "winged_body_in_box.poly", "plate_with_hole.poly"}) {
    INFO(shape);
    const Refined mesh = refined(shape, 1e9);
    const Indexed_mesh_3 expected = pgdr::with_threads(1, [&] { return pgdr::indexed_mesh_3(mesh); });
    check_canonical(mesh, expected);
    for (const unsigned threads : pgdr_test::thread_counts())
      CHECK(pgdr::with_threads(threads, [&] { return same(pgdr::indexed_mesh_3(mesh), expected); }));
  }
}

TEST_CASE("the checker says the same for every number of threads", "[parallel]") {
  const auto domain = pgdr::make_domain_3(pgdr::read_plc(pgdr_test::data_file("two_regions.poly")));
  Indexed_mesh_3 mesh = pgdr::indexed_mesh_3(pgdr::refine_mesh_3(domain, pgdr::Uniform_sizing_field(0.1)));
  REQUIRE(mesh.tetrahedra.size() > 8'000);  // chunks are smaller
  const auto lines_of = [&](unsigned threads) {
    std::string text;
    for (const auto& line : pgdr::with_threads(threads, [&] { return pgdr::check_mesh(mesh, &domain); }))
      text += line.property + (line.passed ? " ok " : " FAIL ") + line.detail + "\n";
    return text;
  };
  const std::string good = lines_of(1);
  CHECK(good.find("FAIL") == std::string::npos);
  for (const unsigned threads : pgdr_test::thread_counts()) CHECK(lines_of(threads) == good);

  std::swap(mesh.tetrahedra[5000][0], mesh.tetrahedra[5000][1]);
  mesh.tetrahedra[7000] = mesh.tetrahedra[100];
  const std::string bad = lines_of(1);
  CHECK(bad.find("orientation FAIL") != std::string::npos);
  CHECK(bad.find("duplicates FAIL") != std::string::npos);
  for (const unsigned threads : pgdr_test::thread_counts()) CHECK(lines_of(threads) == bad);
}

TEST_CASE("meshes of no tetrahedron and of one", "[parallel]") {
  Indexed_mesh_3 mesh;
  const pgdr_test::Temporary_folder folder;
  for (const unsigned threads : pgdr_test::thread_counts()) {
    pgdr::with_threads(threads, [&] {
      CHECK(pgdr::mesh_quality(mesh).tetrahedra == 0);
      CHECK(pgdr::mesh_quality(mesh).volume == 0);
      pgdr::write_mesh(mesh, folder / "none.mesh");
      pgdr::write_mesh(mesh, folder / "none.vtu");
    });
    CHECK(pgdr_test::content_of(folder / "none.mesh").find("Tetrahedra\n0\n") != std::string::npos);
  }
  const std::uint64_t none = pgdr::mesh_checksum(mesh);
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.point_references = {0, 0, 0, 0};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  mesh.tetrahedron_references = {1};
  const std::uint64_t one = pgdr::mesh_checksum(mesh);
  CHECK(one != none);
  const auto quality = pgdr::mesh_quality(mesh);
  CHECK(quality.volume == Approx(1.0 / 6));
  CHECK(quality.max_circumradius == Approx(std::sqrt(0.75)));
  // Three right angles, and three between the oblique face and the others.
  CHECK(quality.dihedral_histogram[18] == 3);
  CHECK(quality.dihedral_histogram[10] == 3);
  CHECK(quality.max_dihedral_deg == Approx(90));
  CHECK(quality.min_dihedral_deg == Approx(54.735610317));
  std::swap(mesh.points[1], mesh.points[2]);
  CHECK(pgdr::mesh_checksum(mesh) != one);
}
