// SPDX-License-Identifier: GPL-3.0-or-later
// What is in a protected ball is kept present by nothing but that no vertex is in the balls of its pieces (docs/theory.md, section 12).
#include <pgdr/conforming/encroachment_3.h>
#include <pgdr/conforming/split_points_3.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <pgdr/acute/acute_neighborhood_3.h>
#include <pgdr/io/read_plc.h>

#include "catch.h"
#include "inputs.h"
#include "refinement/refined.h"

using namespace pgdr_test;

namespace {

using Tr = Mesh::Triangulation;

/// Subfacets in protected balls, and how many of these a vertex inside of a volume encroaches.
std::pair<std::size_t, std::size_t> protected_subfacets(const Mesh& mesh) {
  const pgdr::Acute_neighborhood_3 acute(mesh.domain());
  const auto& complex = mesh.complex();
  const pgdr::Split_points_3<Tr> pieces(complex, acute);
  std::pair<std::size_t, std::size_t> count;
  for (const auto c : mesh.triangulation().finite_cell_handles())
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t t = c->subfacet(i);
      if (t == complex.none || !pieces.is_subfacet_protected(t)) continue;
      ++count.first;
      count.second +=
          c->vertex(i)->in_dimension() == 3 && pgdr::encroaches(complex, complex.subfacet(t), c->vertex(i));
    }
  return count;
}

}  // namespace

TEST_CASE("No vertex encroaches a subfacet in a protected ball for the sake of a sliver", "[slivers]") {
  std::size_t all = 0;
  for (const char* file :
       {"fan_1097", "fan_120", "fan_134", "fan_141", "fan_15",  "fan_155", "fan_169", "fan_197", "fan_204",
        "fan_211",  "fan_218", "fan_22",  "fan_225", "fan_232", "fan_253", "fan_260", "fan_267", "fan_274",
        "fan_288",  "fan_29",  "fan_295", "fan_302", "fan_309", "fan_330", "fan_344", "fan_351", "fan_358",
        "fan_36",   "fan_365", "fan_386", "fan_393", "fan_64",  "fan_78",  "fan_8",   "fan_92",  "fan_99"}) {
    CAPTURE(file);
    const auto [found, encroached] = protected_subfacets(
        refined(pgdr::read_plc(data_file(std::string("../test/corpus/") + file + ".poly")),
                std::numeric_limits<double>::infinity()));
    all += found;
    CHECK(encroached == 0);
  }
  CHECK(all > 100);
}

TEST_CASE("A run that is cancelled while slivers at features are removed ends, with every piece present",
          "[slivers]") {
  for (const std::size_t after : {1u, 5u, 10u}) {
    CAPTURE(after);
    std::atomic<bool> cancel = false;
    bool is_removing = false;
    std::size_t on_features = 0;
    pgdr::Parameters parameters;
    parameters.threads = 1;
    parameters.verify = true;
    parameters.cancel = &cancel;
    parameters.progress = [&](const pgdr::Progress& p) {
      is_removing = is_removing || std::string(p.phase) == "removing slivers";
    };
    parameters.inserted = [&](const pgdr::Inserted_vertex& v) {
      on_features += is_removing && v.dimension < 3;
      cancel = cancel || on_features >= after;
    };
    const Mesh mesh = refined(pgdr::read_plc(data_file("../test/corpus/needle_121.poly")),
                              std::numeric_limits<double>::infinity(), parameters);
    CHECK(on_features >= after);
    CHECK(mesh.statistics().stop == pgdr::Stop_reason::cancelled);
    CHECK(mesh.statistics().unrecovered == 0);
    CHECK(mesh.triangulation().is_valid());
  }
}
