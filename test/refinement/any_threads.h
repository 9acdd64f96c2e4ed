// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_REFINEMENT_ANY_THREADS_H
#define PGDR_TEST_REFINEMENT_ANY_THREADS_H

#include <cstddef>
#include <limits>
#include <vector>

#include "catch.h"
#include "refinement/refined.h"
#include "thread_counts.h"

namespace pgdr_test {

/// The mesh of a PLC by quality alone, which ends with so many vertices at most, passes, and is the same for any number of threads.
inline pgdr::Indexed_mesh_3 mesh_with_any_threads(const pgdr::Plc& plc, std::size_t most) {
  pgdr::Parameters parameters;
  parameters.max_vertices = most;
  std::vector<pgdr::Indexed_mesh_3> meshes;
  for (const unsigned threads : thread_counts()) {
    parameters.threads = threads;
    const Mesh mesh = refined(plc, std::numeric_limits<double>::infinity(), parameters);
    REQUIRE(mesh.statistics().stop == pgdr::Stop_reason::finished);
    meshes.push_back(pgdr::indexed_mesh_3(mesh));
    if (threads == 1) CHECK(failures(pgdr::check_mesh(meshes.back(), &mesh.domain())) == "");
    CHECK(equal(meshes.front(), meshes.back()));
  }
  return meshes.front();
}

}  // namespace pgdr_test

#endif
