// SPDX-License-Identifier: GPL-3.0-or-later
// A run that another thread stops: what there is by then is a valid mesh, and says why it ended.
#include <atomic>
#include <chrono>
#include <iostream>
#include <thread>

#include <pgdr/refine_mesh_3.h>

#include "cube.h"

int main() {
  std::atomic<bool> cancel = false;
  pgdr::Parameters parameters;
  parameters.cancel = &cancel;
  parameters.max_vertices = 2'000'000;  // a limit, in case nobody stops it
  parameters.progress = [](const pgdr::Progress& p) { std::cout << p.phase << ": " << p.vertices << " vertices\n"; };
  std::thread stopper([&cancel] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    cancel = true;
  });
  const auto mesh = pgdr::refine_mesh_3(cube(), pgdr::Uniform_sizing_field(0.004), parameters);
  stopper.join();
  std::cout << mesh.statistics().stop_message << "; " << mesh.triangulation().number_of_finite_cells() << " tetrahedra\n";
  return mesh.statistics().stop == pgdr::Stop_reason::finished ? 1 : 0;
}
