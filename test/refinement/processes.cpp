// SPDX-License-Identifier: GPL-3.0-or-later
// Many meshes in one process: one after the other, at once, inside a caller's arena, and in a forked child.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <thread>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "catch.h"
#include "domain/shapes.h"
#include "refined.h"

using namespace pgdr_test;

namespace {

std::uint64_t checksum_of_a_mesh(unsigned threads, double size = 0.1) {
  pgdr::Parameters parameters;
  parameters.threads = threads;
  parameters.time_limit = 600;  // with its watch
  return pgdr::mesh_checksum(pgdr::indexed_mesh_3(refined(box(), size, parameters)));
}

}  // namespace

TEST_CASE("A thousand meshes in one process take no more memory than a hundred", "[refinement]") {
#ifdef __SANITIZE_ADDRESS__
  WARN("pgdr-test-skip: the address sanitizer keeps freed memory in quarantine");
  return;
#endif
  const auto make = [](int n) {
    for (int i = 0; i < n; ++i) checksum_of_a_mesh(2, 0.3);
    return pgdr::resident_memory_bytes();
  };
  const std::size_t before = make(100), after = make(900);
  CHECK(after < before + (std::size_t{8} << 20));
}

TEST_CASE("Eight meshes at once, from eight threads", "[refinement]") {
  const std::uint64_t alone = checksum_of_a_mesh(1);
  std::vector<std::uint64_t> found(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i)
    threads.emplace_back([&found, i] { found[i] = checksum_of_a_mesh(static_cast<unsigned>(i % 3)); });
  for (auto& t : threads) t.join();
  CHECK(found == std::vector<std::uint64_t>(8, alone));
}

TEST_CASE("Meshes inside a caller's arena and a caller's parallel loop", "[refinement]") {
  const std::uint64_t alone = checksum_of_a_mesh(1);
  tbb::task_arena arena(3);
  std::vector<std::uint64_t> found(6);
  arena.execute([&] {
    found[0] = checksum_of_a_mesh(0);
    tbb::parallel_for(1, 6, [&found](int i) { found[static_cast<std::size_t>(i)] = checksum_of_a_mesh(i % 2 ? 0 : 2); });
  });
  CHECK(found == std::vector<std::uint64_t>(6, alone));
}

TEST_CASE("A mesh in a forked child, whose parent has not used TBB yet", "[refinement]") {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    alarm(60);  // should it hang
    const std::uint64_t one = checksum_of_a_mesh(1);
    _exit(checksum_of_a_mesh(2) == one ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}
