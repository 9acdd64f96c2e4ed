// SPDX-License-Identifier: GPL-3.0-or-later
#include <sstream>
#include <string>

#include "program.h"

using pgdr_test::file_text;
using pgdr_test::Run;
using pgdr_test::Sandbox;
using pgdr_test::shape;

TEST_CASE("check passes on what mesh wrote", "[apps]") {
  for (const char* name : {"cube.poly", "l_block.poly", "cavity.poly", "two_regions.poly",
                           "plate_with_hole.poly", "winged_body_in_box.poly"}) {
    const Sandbox sandbox;
    const Run mesh = sandbox.run("mesh --quiet " + shape(name) + " -o out.mesh");
    INFO(name << '\n' << mesh.err);
    REQUIRE(mesh.exit_code == 0);
    const Run check = sandbox.run("check out.mesh --plc " + shape(name));
    INFO(check.out << check.err);
    CHECK(check.exit_code == 0);
    CHECK(check.out.find("FAIL") == std::string::npos);
    CHECK(check.err.empty());
  }
}

TEST_CASE("check fails on a mesh of something else, and on a broken one", "[apps]") {
  const Sandbox sandbox;
  REQUIRE(sandbox.run("mesh --quiet " + shape("cube.poly") + " --size 0.5 -o out.mesh").exit_code == 0);
  CHECK(sandbox.run("check out.mesh").exit_code == 0);
  const Run other = sandbox.run("check out.mesh --plc " + shape("l_block.poly"));
  CHECK(other.exit_code == 1);
  CHECK(other.out.find("FAIL") != std::string::npos);
  const Run strict = sandbox.run("check out.mesh --radius-edge-ratio 0.7");
  CHECK(strict.exit_code == 1);

  // One tetrahedron less.
  std::string text = file_text(sandbox / "out.mesh");
  const std::size_t keyword = text.find("Tetrahedra\n");
  REQUIRE(keyword != std::string::npos);
  const std::size_t count = keyword + std::string("Tetrahedra\n").size();
  const std::size_t first = text.find('\n', count) + 1;
  const std::size_t second = text.find('\n', first) + 1;
  const int tetrahedra = std::stoi(text.substr(count));
  text = text.substr(0, count) + std::to_string(tetrahedra - 1) + "\n" + text.substr(second);
  const Run broken = sandbox.run("check " + sandbox.write("broken.mesh", text));
  CHECK(broken.exit_code == 1);
  CHECK(broken.out.find("FAIL") != std::string::npos);
}

TEST_CASE("mesh and check say the same of the quality, and write it", "[apps]") {
  const Sandbox sandbox;
  const Run mesh = sandbox.run("mesh " + shape("two_regions.poly") + " -o out.mesh --quality a.csv");
  REQUIRE(mesh.exit_code == 0);
  const Run check = sandbox.run("check out.mesh --quality b.csv");
  REQUIRE(check.exit_code == 0);
  // But for what no .mesh tells.
  std::istringstream written(file_text(sandbox / "a.csv"));
  std::string line, without_marks;
  while (std::getline(written, line)) without_marks += line.substr(0, line.rfind(',', line.rfind(',') - 1)) + "\n";
  CHECK(without_marks == file_text(sandbox / "b.csv"));
  for (const std::string name : {"radius-edge ratio", "circumradius", "dihedral angle", "scaled Jacobian"}) {
    const auto figures = [&](const std::string& text) {
      const std::size_t begin = text.find("\n" + name);
      REQUIRE(begin != std::string::npos);
      return text.substr(begin, text.find('\n', begin + 1) - begin);
    };
    CHECK(figures(mesh.out) == figures(check.out));
  }
  CHECK(sandbox.run("check out.mesh --quality out.mesh").exit_code == 2);
  CHECK(sandbox.run("check out.mesh --plc b.csv --quality b.csv").exit_code == 2);
  CHECK(sandbox.run("mesh " + shape("cube.poly") + " -o out.mesh --quality out.mesh").exit_code == 2);
  CHECK(sandbox.run("check out.mesh --quality none/b.csv").exit_code == 1);
  CHECK(sandbox.run("check out.mesh --quality -").exit_code == 2);
  CHECK(sandbox.run("mesh " + shape("cube.poly") + " -o out.mesh --quality -").exit_code == 2);
}

TEST_CASE("check without sense", "[apps]") {
  const Sandbox sandbox;
  pgdr_test::check_fails(sandbox, "check out.mesh --radius-edge-ratio 0", 2, {"--radius-edge-ratio"});
  pgdr_test::check_fails(sandbox, "check out.mesh --coplanar-tolerance x", 2, {"--coplanar-tolerance"});
  pgdr_test::check_fails(sandbox, "check out.mesh --plc missing.poly", 3, {"missing.poly"});
  for (const char* option : {"--tolerance 1e-3d", "--patch-angle 7", "--hole 1,2,3", "--repair"})
    pgdr_test::check_fails(sandbox, std::string("check out.mesh ") + option, 2, {"--plc"});
}
