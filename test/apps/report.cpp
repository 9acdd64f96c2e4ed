// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/report/format.h>
#include <pgdr/report/memory.h>
#include <pgdr/report/run_summary.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "catch.h"
#include "stats_file.h"

TEST_CASE("numbers for people", "[apps]") {
  CHECK(pgdr::with_separators(0) == "0");
  CHECK(pgdr::with_separators(999) == "999");
  CHECK(pgdr::with_separators(1000) == "1,000");
  CHECK(pgdr::with_separators(1234567) == "1,234,567");
  CHECK(pgdr::counted(1, "region", "regions") == "1 region");
  CHECK(pgdr::counted(2000, "region", "regions") == "2,000 regions");
  CHECK(pgdr::memory_size(0) == "0 bytes");
  CHECK(pgdr::memory_size(std::size_t(3) << 30) == "3 GiB");
  CHECK(pgdr::significant(0.125) == "0.125");
  CHECK(pgdr::fixed(1.0 / 3) == "0.33");
}

TEST_CASE("the peak of memory is that of the process", "[apps]") {
  const std::size_t before = pgdr::peak_memory_bytes();
  CHECK(before > 100 * 1024);
  CHECK(before < std::size_t(1) << 40);
  const std::string block(std::size_t(64) << 20, 'x');
  CHECK(pgdr::peak_memory_bytes() >= block.size());
}

TEST_CASE("statistics of an odd run are still JSON", "[apps]") {
  pgdr::Run_summary run;
  run.quality.max_radius_edge_ratio = std::numeric_limits<double>::infinity();
  run.checksum = 0xabc;
  run.stop = pgdr::Stop_reason::cancelled;
  run.stop_message = "a \"quoted\" \xff byte";
  const auto json = nlohmann::json::parse(pgdr::app::stats_json(run));
  CHECK(json["max_radius_edge_ratio"].is_null());
  CHECK(json["mesh_checksum"] == "0000000000000abc");
  CHECK(json["stop"] == "cancelled");
  CHECK(json["regions"].empty());
  std::ostringstream text;
  pgdr::print_summary(text, run);
  CHECK(text.str().find("inf") != std::string::npos);
}
