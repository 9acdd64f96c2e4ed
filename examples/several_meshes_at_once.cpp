// SPDX-License-Identifier: GPL-3.0-or-later
// Four threads make a mesh each, on one and on all cores: it is the same one, bit for bit.
#include <cstdint>
#include <iostream>
#include <set>
#include <thread>
#include <vector>

#include <pgdr/quality/mesh_quality.h>
#include <pgdr/refine_mesh_3.h>

#include "cube.h"

int main() {
  std::vector<std::uint64_t> checksums(4);
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < checksums.size(); ++i)
    threads.emplace_back([&, i] {
      pgdr::Parameters parameters;
      parameters.threads = i;  // 0: as many as there are cores
      checksums[i] = pgdr::mesh_checksum(pgdr::indexed_mesh_3(pgdr::refine_mesh_3(cube(), pgdr::Uniform_sizing_field(0.05), parameters)));
    });
  for (std::thread& t : threads) t.join();
  for (const std::uint64_t c : checksums) std::cout << std::hex << c << "\n";
  return std::set(checksums.begin(), checksums.end()).size() == 1 ? 0 : 1;
}
