// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstddef>
#include <functional>
#include <regex>
#include <string>
#include <vector>

#include <pgdr/io/medit.h>
#include <pgdr/io/write_mesh.h>
#include <pgdr/quality/measures.h>

#include "../catch.h"
#include "../inputs.h"
#include "read_back.h"
#include "sample_mesh.h"
#include "temporary_folder.h"

namespace {

using pgdr_test::read_back;
using pgdr_test::run;

bool has_meshio() {
  const std::string python = pgdr_test::python();
  return !python.empty() && run("'" + python + "' -c 'import meshio' >/dev/null 2>&1") == 0;
}

double volume_of(const pgdr::Indexed_mesh_3& mesh) {
  double volume = 0;
  for (const auto& t : mesh.tetrahedra) {
    volume += pgdr::signed_volume(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]);
  }
  return volume;
}

}  // namespace

TEST_CASE("written meshes read into meshio and VTK") {
  if (!has_meshio()) PGDR_SKIP("python3-meshio is not installed");
  const pgdr_test::Temporary_folder folder;
  // 22 * 22 * 22 * 6 tetrahedra take several compressed blocks, the last one not full; 2 * 2 * 2 takes one.
  for (const std::uint32_t n : {2u, 23u}) {
    auto mesh = pgdr_test::sample_mesh(n);
    const std::size_t points = mesh.points.size(), tetrahedra = mesh.tetrahedra.size();
    char more[100];
    std::snprintf(more, sizeof more, " --exempt %zu --volume %.17g", mesh.exempt.size(), volume_of(mesh));
    for (const char* name : {"a.vtu", "a.mesh"}) {
      pgdr::write_mesh(mesh, folder / name);
      CHECK(read_back(folder / name, points, tetrahedra, more) == 0);
    }
    CHECK(read_back(folder / "a.vtu", points + 1, tetrahedra, " 2>/dev/null") == 1);
    CHECK(read_back(folder / "a.mesh", points, tetrahedra - 1, " 2>/dev/null") == 1);
    CHECK(read_back(folder / "a.vtu", points, tetrahedra, " --exempt 100000 2>/dev/null") == 1);
    // What a .mesh file brings back has no dimensions and no exempt tetrahedra.
    pgdr::write_mesh(pgdr::read_medit(folder / "a.mesh"), folder / "b.vtu");
    CHECK(read_back(folder / "b.vtu", points, tetrahedra, " --exempt 0") == 0);
  }
}

TEST_CASE("vtu: blocks that are exactly full, and no tetrahedra at all") {
  if (!has_meshio()) PGDR_SKIP("python3-meshio is not installed");
  const pgdr_test::Temporary_folder folder;
  auto mesh = pgdr_test::sample_mesh(20);
  mesh.tetrahedra.resize(16384);  // times four bytes: one block
  mesh.exempt.clear();
  mesh.exempt.push_back(16383);
  pgdr::write_mesh(mesh, folder / "full.vtu");
  CHECK(read_back(folder / "full.vtu", mesh.points.size(), 16384, " --exempt 1") == 0);
  mesh.tetrahedra.clear();
  mesh.exempt.clear();
  pgdr::write_mesh(mesh, folder / "empty.mesh");
  CHECK(pgdr::read_medit(folder / "empty.mesh").tetrahedra.empty());
  pgdr::write_mesh(mesh, folder / "empty.vtu");
  CHECK(std::filesystem::exists(folder / "empty.vtu"));
}

TEST_CASE("vtu: two runs write the same bytes") {
  const pgdr_test::Temporary_folder folder;
  pgdr::write_mesh(pgdr_test::sample_mesh(12), folder / "a.vtu");
  pgdr::write_mesh(pgdr_test::sample_mesh(12), folder / "b.vtu");
  CHECK(pgdr_test::content_of(folder / "a.vtu") == pgdr_test::content_of(folder / "b.vtu"));
}

TEST_CASE("vtu: the offsets of arrays descend, so that meshio finds each of them") {
  const pgdr_test::Temporary_folder folder;
  pgdr::Write_options options;
  options.vtu.triangles = true;
  pgdr::write_mesh(pgdr_test::sample_mesh(5), folder / "a.vtu", options);
  const std::string text = pgdr_test::content_of(folder / "a.vtu");
  const std::regex offset("offset=\"([0-9]+)\"");
  std::vector<std::size_t> offsets;
  for (std::sregex_iterator it(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find("<AppendedData")), offset), end; it != end; ++it) offsets.push_back(std::stoul((*it)[1]));
  CHECK(offsets.size() == 13);
  CHECK(std::ranges::is_sorted(offsets, std::greater()));
  CHECK(offsets.back() == 0);
}
