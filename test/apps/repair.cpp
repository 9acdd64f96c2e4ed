// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

#include "program.h"

using pgdr_test::file_text;
using pgdr_test::Run;
using pgdr_test::Sandbox;

namespace {

/// A box along the first axis as a surface file, without its first triangles, as many as are said.
void write_box(const std::filesystem::path& path, double lower, double upper, int left_out = 0, bool other_diagonals = false) {
  std::ofstream out(path);
  out << "OFF\n8 " << 12 - left_out << " 0\n";
  for (int i = 0; i < 8; ++i) out << (i & 1 ? upper : lower) << ' ' << (i & 2 ? 1 : 0) << ' ' << (i & 4 ? 1 : 0) << '\n';
  const int sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (int s = 0; s < 6; ++s) {
    const int* q = sides[s];
    const int k = other_diagonals ? 1 : 0;
    if (s != 0 || left_out < 1) out << "3 " << q[k] << ' ' << q[k + 1] << ' ' << q[k + 2] << '\n';
    if (s != 0 || left_out < 2) out << "3 " << q[k] << ' ' << q[k + 2] << ' ' << q[(k + 3) % 4] << '\n';
  }
}

}  // namespace

TEST_CASE("an open surface is refused with a remedy, and meshed with it", "[apps]") {
  const Sandbox sandbox;
  write_box(sandbox / "open.off", 0, 1, 1);
  const Run refused = sandbox.run("mesh open.off -o out.mesh");
  CHECK(refused.exit_code == 3);
  CHECK(refused.err.find("--repair") != std::string::npos);
  const Run run = sandbox.run("mesh open.off --repair -o out.mesh --stats s.json");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  CHECK(run.out.find("1 hole filled") != std::string::npos);
  const nlohmann::json stats = nlohmann::json::parse(file_text(sandbox / "s.json"));
  CHECK(stats["repair"]["filled_holes"] == 1);
  CHECK(std::abs(stats["regions"][0]["volume"].get<double>() - 1) < 1e-12);
  CHECK(sandbox.run("check out.mesh --plc open.off --repair").exit_code == 0);
}

TEST_CASE("holes wider than --fill-holes are named", "[apps]") {
  const Sandbox sandbox;
  write_box(sandbox / "open.off", 0, 1, 2);
  const Run run = sandbox.run("mesh open.off --repair --fill-holes 1 -o out.mesh");
  CHECK(run.exit_code == 3);
  CHECK(run.err.find("1.41421 wide") != std::string::npos);
  CHECK(run.err.find("--fill-holes") != std::string::npos);
  CHECK(sandbox.run("mesh open.off --fill-holes 1 -o out.mesh").exit_code == 2);
}

TEST_CASE("a part that others have all of is worth a warning", "[apps]") {
  const Sandbox sandbox;
  write_box(sandbox / "inner.off", 0.25, 0.75);
  write_box(sandbox / "outer.off", 0, 1);
  const Run lost = sandbox.run("mesh inner.off outer.off -o out.vtu --quiet");
  CHECK(lost.exit_code == 0);
  CHECK(lost.err.find("region 1, 'inner', has no tetrahedra; regions are 2") != std::string::npos);
  CHECK(sandbox.run("mesh outer.off inner.off -o out.vtu --quiet").err.empty());
}

TEST_CASE("several inputs are an assembly, a region each", "[apps]") {
  const Sandbox sandbox;
  write_box(sandbox / "a.off", 0, 1);
  write_box(sandbox / "b.off", 1, 3, 0, true);
  const Run run = sandbox.run("mesh a.off b.off -o out.mesh --stats s.json");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const nlohmann::json regions = nlohmann::json::parse(file_text(sandbox / "s.json"))["regions"];
  REQUIRE(regions.size() == 2);
  CHECK(std::abs(regions[0]["volume"].get<double>() - 1) < 1e-12);
  CHECK(std::abs(regions[1]["volume"].get<double>() - 2) < 1e-12);
  CHECK(sandbox.run("check out.mesh --plc a.off --plc b.off").exit_code == 0);
  CHECK(sandbox.run("mesh a.off a.off b.off -o a.off").exit_code == 2);
}

TEST_CASE("a triangle without area is no reason to refuse a surface, and none of a complex", "[apps]") {
  const Sandbox sandbox;
  const std::string vertices = "0 0 0\n4 0 0\n0 4 0\n0 0 4\n1 0 0\n";
  std::ofstream(sandbox / "cap.off") << "OFF\n5 6 0\n" << vertices << "3 0 2 1\n3 0 3 2\n3 1 2 3\n3 0 1 4\n3 0 4 3\n3 4 1 3\n";
  const Run run = sandbox.run("mesh cap.off --tolerance 0 -o out.mesh --stats s.json");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const nlohmann::json stats = nlohmann::json::parse(file_text(sandbox / "s.json"));
  CHECK(stats["repair"]["degenerate_triangles"] == 1);
  CHECK(std::abs(stats["regions"][0]["volume"].get<double>() - 64.0 / 6) < 1e-12);
  CHECK(sandbox.run("check out.mesh --plc cap.off --tolerance 0").exit_code == 0);
  CHECK(sandbox.run("info cap.off").out.find("1 triangle without area taken away") != std::string::npos);
  CHECK(sandbox.run("info cap.off --write-plc cap.poly").exit_code == 0);
  CHECK(sandbox.run("info cap.poly").exit_code == 0);
}
