// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/write_quality.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include <pgdr/io/output_error.h>
#include <pgdr/parallel/thread_arena.h>
#include <pgdr/quality/measures.h>
#include <pgdr/quality/shape_measures.h>

#include "catch.h"
#include "io/sample_mesh.h"
#include "io/temporary_folder.h"
#include "thread_counts.h"

using pgdr_test::Temporary_folder;

TEST_CASE("The quality of every tetrahedron is written, in order, the same for every number of threads", "[io]") {
  auto mesh = pgdr_test::sample_mesh(13);  // more than one block of rows
  mesh.unrefined = {5};
  mesh.exponent = 3;
  const Temporary_folder folder;
  std::string first;
  for (const unsigned threads : pgdr_test::thread_counts()) {
    pgdr::with_threads(threads, [&] { pgdr::write_quality(mesh, folder / "q.csv"); });
    const std::string text = pgdr_test::content_of(folder / "q.csv");
    if (first.empty()) first = text;
    REQUIRE(text == first);
  }
  std::istringstream lines(first);
  std::string line;
  REQUIRE(std::getline(lines, line));
  CHECK(line ==
        "tetrahedron,region,volume,circumradius,radius_edge_ratio,min_dihedral_angle,max_dihedral_angle,edge_ratio,aspect_ratio,mean_ratio,"
        "scaled_jacobian,exempt,unrefined");
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    REQUIRE(std::getline(lines, line));
    std::istringstream fields(line);
    std::vector<double> row;
    for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
    const auto& t = mesh.tetrahedra[i];
    const auto &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]], &d = mesh.points[t[3]];
    const auto angles = pgdr::dihedral_angles_deg(a, b, c, d);
    const pgdr::Shape_measures m = pgdr::shape_measures(a, b, c, d);
    const std::vector<double> wanted{double(i), double(mesh.tetrahedron_references[i]), 512 * pgdr::signed_volume(a, b, c, d),
                                     8 * std::sqrt(pgdr::squared_circumradius(a, b, c, d)), pgdr::radius_edge_ratio(a, b, c, d),
                                     std::ranges::min(angles), std::ranges::max(angles), m.edge_ratio, m.aspect_ratio, m.mean_ratio,
                                     m.scaled_jacobian, double(std::ranges::binary_search(mesh.exempt, i)), double(i == 5)};
    REQUIRE(row.size() == wanted.size());
    for (std::size_t k = 0; k < row.size(); ++k) REQUIRE(row[k] == Approx(wanted[k]).epsilon(1e-6));
  }
  CHECK_FALSE(std::getline(lines, line));
}

TEST_CASE("The quality of no tetrahedra is a line of names, and a folder that is not there an error", "[io]") {
  const Temporary_folder folder;
  pgdr::write_quality({}, folder / "q.csv");
  const std::string text = pgdr_test::content_of(folder / "q.csv");
  CHECK(text.find('\n') + 1 == text.size());
  CHECK_THROWS_AS(pgdr::write_quality({}, folder / "none" / "q.csv"), pgdr::Output_error);
}
