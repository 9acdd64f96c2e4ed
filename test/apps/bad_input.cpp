// SPDX-License-Identifier: GPL-3.0-or-later
// Every kind of bad input: exit code 3, one sentence that names the file, line or facet, and no file left.
#include <string>

#include <nlohmann/json.hpp>

#include "program.h"

using pgdr_test::check_fails;
using pgdr_test::data_file;
using pgdr_test::file_text;
using pgdr_test::quoted;
using pgdr_test::Run;
using pgdr_test::Sandbox;
using pgdr_test::shape;

namespace {

/// The unit tetrahedron's surface with vertex 3 as given, and one face replaced.
std::string tetrahedron_off(const std::string& last_vertex = "0 0 1",
                            const std::string& last_face = "3 1 2 3") {
  return "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n" + last_vertex + "\n3 0 2 1\n3 0 1 3\n3 0 3 2\n" + last_face +
         "\n";
}

/// Two unit squares that cross each other in the middle of a box.
std::string crossing_poly() {
  std::string text = file_text(data_file("cube.poly"));
  const auto replace = [&text](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
  };
  replace("\n8 3 0 0\n", "\n16 3 0 0\n");
  replace("\n# facets",
          "9 0.25 0.25 0.5\n10 0.75 0.25 0.5\n11 0.75 0.75 0.5\n12 0.25 0.75 0.5\n"
          "13 0.5 0.3 0.25\n14 0.5 0.7 0.25\n15 0.5 0.7 0.75\n16 0.5 0.3 0.75\n# facets");
  replace("\n6 1\n", "\n8 1\n1 0 7\n4 9 10 11 12\n1 0 8\n4 13 14 15 16\n");
  return text;
}

/// All commands that read an input refuse it alike.
void check_refused(const Sandbox& sandbox, const std::string& input, const std::vector<std::string>& words,
                   bool one_line = true) {
  check_fails(sandbox, "mesh " + input + " -o out.vtu -o out.mesh --stats out.json", 3, words, one_line);
  check_fails(sandbox, "mesh " + input + " -o out.vtu --quiet", 3, words, one_line);
}

}  // namespace

TEST_CASE("a file that is missing or no file", "[apps]") {
  const Sandbox sandbox;
  check_refused(sandbox, "missing.poly", {"missing.poly"});
  check_fails(sandbox, "info missing.off", 3, {"missing.off"});
  check_fails(sandbox, "check missing.mesh", 3, {"missing.mesh"});
  check_refused(sandbox, sandbox.write("shape.step", "ISO-10303-21;"), {"shape.step"});
  check_refused(sandbox, sandbox.write("empty.off", ""), {"empty.off"});
  std::filesystem::create_directory(sandbox / "folder.poly");
  check_refused(sandbox, "folder.poly", {"folder.poly"});
}

TEST_CASE("a file that is truncated", "[apps]") {
  const Sandbox sandbox;
  const std::string poly = file_text(data_file("cube.poly"));
  check_refused(sandbox, sandbox.write("half.poly", poly.substr(0, poly.size() / 2)), {"half.poly"});
  check_refused(sandbox, sandbox.write("short.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n"), {"short.off"});
  check_refused(sandbox,
                sandbox.write("short.stl", std::string(80, ' ') + std::string("\x10\x00\x00\x00", 4)),
                {"short.stl"});
  check_fails(sandbox,
              "check " + sandbox.write("short.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 9\n"), 3,
              {"short.mesh"});
}

TEST_CASE("coordinates that are not finite", "[apps]") {
  const Sandbox sandbox;
  check_refused(sandbox, sandbox.write("nan.off", tetrahedron_off("0 nan 1")), {"nan.off"});
  check_refused(sandbox, sandbox.write("inf.off", tetrahedron_off("0 inf 1")), {"inf.off"});
  check_refused(sandbox, sandbox.write("big.off", tetrahedron_off("0 1e999 1")), {"big.off"});
}

TEST_CASE("an index out of range", "[apps]") {
  const Sandbox sandbox;
  check_refused(sandbox, sandbox.write("index.off", tetrahedron_off("0 0 1", "3 1 2 4")), {"index.off"});
  check_refused(sandbox, sandbox.write("index.off", tetrahedron_off("0 0 1", "3 1 2 -1")), {"index.off"});
}

TEST_CASE("nothing to mesh", "[apps]") {
  const Sandbox sandbox;
  check_refused(sandbox, sandbox.write("none.off", "OFF\n0 0 0\n"), {});
  check_refused(sandbox, sandbox.write("points.off", "OFF\n4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"), {});
}

TEST_CASE("a surface that encloses nothing names an open edge", "[apps]") {
  const Sandbox sandbox;
  check_refused(
      sandbox,
      sandbox.write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n"),
      {"edge"}, false);
  const Run info = sandbox.run("info open.off");
  CHECK(info.exit_code == 3);
  CHECK(info.err.find("edge") != std::string::npos);
}

TEST_CASE("self-intersecting facets are named", "[apps]") {
  const Sandbox sandbox;
  check_refused(sandbox, sandbox.write("crossing.poly", crossing_poly()), {"facet"}, false);
}

TEST_CASE("what is wrong is written for ParaView, too", "[apps]") {
  const Sandbox sandbox;
  const auto count = [&](const std::string& word) {
    const std::string text = file_text(sandbox / "problems.vtu");
    const std::size_t at = text.find(word + "=\"");
    REQUIRE(at != std::string::npos);
    return std::stoul(text.substr(at + word.size() + 2));
  };
  sandbox.write("crossing.poly", crossing_poly());
  for (const std::string command : {"info crossing.poly", "mesh crossing.poly -o out.vtu"}) {
    const Run run = sandbox.run(command + " --problems problems.vtu");
    INFO(command << '\n' << run.err);
    CHECK(run.exit_code == 3);
    CHECK(run.err.find("facets 1 and 2 intersect at (0.5, 0.") != std::string::npos);
    CHECK(count("NumberOfCells") == 2);
    CHECK(count("NumberOfPoints") == 8);
    std::filesystem::remove(sandbox / "problems.vtu");
  }
  // An open surface: every edge with one facet is an error of its own, with that facet.
  sandbox.write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n");
  const Run open = sandbox.run("info open.off --problems problems.vtu");
  INFO(open.err);
  CHECK(open.exit_code == 3);
  CHECK(std::count(open.err.begin(), open.err.end(), '\n') == 4);  // and what may help
  CHECK(count("NumberOfCells") == 6);
  // What cannot be understood at all is drawn from the file's own polygons.
  sandbox.write("flat.poly", "4 3 0\n0 0 0 0\n1 1 0 0\n2 2 0 0\n3 0 1 1\n4 0\n1\n3 0 1 2\n1\n3 0 1 3\n1\n3 1 2 3\n1\n3 0 2 3\n0\n");
  CHECK(sandbox.run("info flat.poly --problems problems.vtu").exit_code == 3);
  CHECK(count("NumberOfCells") == 1);
  // Nothing wrong: no cells, so that no old file misleads.
  CHECK(sandbox.run("info " + shape("cube.poly") + " --problems problems.vtu").exit_code == 0);
  CHECK(count("NumberOfCells") == 0);
  check_fails(sandbox, "info crossing.poly --problems problems.txt", 2, {"--problems", ".vtu"});
  check_fails(sandbox, "info crossing.poly --problems crossing.poly", 2, {"--problems"});
}

TEST_CASE("a hole that leaves nothing", "[apps]") {
  const Sandbox sandbox;
  std::string text = file_text(data_file("cavity.poly"));
  const std::size_t holes = text.find("\n1\n1 1.5 1.5 1.5\n");
  REQUIRE(holes != std::string::npos);
  text.replace(holes, 17, "\n2\n1 1.5 1.5 1.5\n2 0.5 0.5 0.5\n");
  check_refused(sandbox, sandbox.write("nothing.poly", text), {});
}

TEST_CASE("a seed outside of everything is only worth a warning", "[apps]") {
  const Sandbox sandbox;
  std::string text = file_text(data_file("cavity.poly"));
  const std::size_t holes = text.find("\n1\n1 1.5 1.5 1.5\n");
  REQUIRE(holes != std::string::npos);
  text.replace(holes, 17, "\n2\n1 1.5 1.5 1.5\n2 9 9 9\n");
  sandbox.write("seed.poly", text);
  for (const std::string arguments : {"mesh --quiet seed.poly -o out.vtu", "info seed.poly"}) {
    const Run run = sandbox.run(arguments);
    CHECK(run.exit_code == 0);
    CHECK(run.err.rfind("pgdr: warning: ", 0) == 0);
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  }
}

TEST_CASE("a region seed that another seed overrules is worth a warning", "[apps]") {
  const Sandbox sandbox;
  const auto warning = [&](const std::string& seeds) {
    const Run run = sandbox.run("mesh --quiet " + shape("cube.poly") + " -o out.vtu " + seeds);
    CHECK(run.exit_code == 0);
    return run.err;
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  CHECK(has(warning("--region .5,.5,.5:1 --region .4,.5,.5:2"), "region seed 2 at (0.4, 0.5, 0.5) lies in the volume of region seed 1 and is left out"));
  CHECK(has(warning("--region .5,.5,.5:1 --name-region 7=steel"), "region 7, 'steel', has no tetrahedra; regions are 1"));
  CHECK(warning("--region .5,.5,.5:1 --region .4,.5,.5:1").empty());
  const Run run = sandbox.run("info " + shape("two_regions.poly") + " --region .25,.5,.5:4 --hole .2,.5,.5");
  CHECK(run.exit_code == 0);
  CHECK(has(run.err, "lies in the volume of hole seed 1"));
}

TEST_CASE("a seed on a facet, an edge or a vertex is an error", "[apps]") {
  const Sandbox sandbox;
  sandbox.write("out.mesh", "precious");
  for (const auto& [point, place] : {std::pair{"0.5,0.5,0", "facet"}, {"0.5,0,0", "segment"}, {"0,0,0", "vertex"}})
    for (const std::string& seed : {"--hole " + std::string(point), "--region " + std::string(point) + ":7"}) {
      check_fails(sandbox, "mesh " + shape("cube.poly") + " " + seed + " -o out.mesh", 3, {"lies on", place});
      check_fails(sandbox, "mesh " + shape("cube.poly") + " " + seed + " -o new.mesh", 3, {"lies on", place});
    }
  CHECK(file_text(sandbox / "out.mesh") == "precious");
}

TEST_CASE("sizes that ask for more than the memory holds are refused before the start", "[apps]") {
  const Sandbox sandbox;
  const std::string mesh = "mesh " + shape("cube.poly") + " -o out.mesh ";
  for (const char* size : {"--size 1e-300", "--size 1e-6", "--size 0.1 --refine-box 0.2,0.2,0.2,0.4,0.4,0.4:1e-6", "--region 0.5,0.5,0.5:3:1e-6", "--size-ball 0.5,0.5,0.5,0.1:1e-6", "--size-near-surface 1e-6:1e-5:1",
                           "--size-ball 0,0,0,0:1e-7 --gradation 1e-6", "--size 1e-104 --refine-box 0,0,0,1,1,1:1e-110"})
    check_fails(sandbox, mesh + size, 4, {"vertices", "memory", "--max-vertices"});
  check_fails(sandbox, mesh + "--size 0.01 --max-memory 100M", 4, {"1e+06 vertices", "100 MiB"});
  // Not what lies outside, and not where it is told to stop.
  CHECK(sandbox.run(mesh + "--refine-box 5,5,5,6,6,6:1e-6").exit_code == 0);
  CHECK(sandbox.run(mesh + "--size 1e-6 --max-vertices 500").exit_code == 4);
  // Nor where a place is so small that no more than a few vertices are near it, wherever samples are taken.
  for (const char* place : {"0.46875,0.46875,0.46875,0:5e-5", "0.5,0.47,0.46,0:5e-5", "0,0,0,0:5e-5", "0.3,0.3,0.3,1e-6:5e-5"})
    CHECK(sandbox.run(mesh + "--size-ball " + place + " --gradation 0.2").exit_code == 0);
  CHECK(std::filesystem::exists(sandbox / "out.mesh"));
}

TEST_CASE("coordinates near the ends of double's range are meshed, checked and read back, or refused", "[apps]") {
  const auto cube = [](const char* length) {
    const std::string l = length;
    std::string text = "OFF\n8 6 0\n";
    for (int i = 0; i < 8; ++i) text += (i & 1 ? l : "0") + " " + (i & 2 ? l : "0") + " " + (i & 4 ? l : "0") + "\n";
    return text + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 1 3 7 5\n4 3 2 6 7\n4 2 0 4 6\n";
  };
  const Sandbox sandbox;
  for (const std::string exponent : {"200", "100", "40", "-40", "-80", "-200"}) {
    sandbox.write("cube.off", cube(("1e" + exponent).c_str()));
    CAPTURE(exponent);
    CHECK(sandbox.run("mesh --quiet cube.off --size 0.3e" + exponent + " -o out.mesh -o out.vtu --stats s.json").exit_code == 0);
    const Run check = sandbox.run("check out.mesh --plc cube.off");
    CHECK(check.exit_code == 0);
    CHECK(check.out.find(" inf") == std::string::npos);  // nor in the figures
    CHECK(check.out.find("nan") == std::string::npos);
    const auto stats = nlohmann::json::parse(file_text(sandbox / "s.json"));
    CHECK(stats["tetrahedra"].get<int>() > 100);
    CHECK(stats["max_radius_edge_ratio"].get<double>() < 2);
    for (const std::string sizes : {"--size-near-surface 0.1e@:0.5e@:1e@", "--size-ball 0,0,0,0.1e@:0.05e@ --gradation 0.3"}) {
      std::string options = sizes;
      for (std::size_t at; (at = options.find('@')) != std::string::npos;) options.replace(at, 1, exponent);
      CAPTURE(options);
      REQUIRE(sandbox.run("mesh --quiet cube.off " + options + " -o near.mesh --stats near.json").exit_code == 0);
      const int tetrahedra = nlohmann::json::parse(file_text(sandbox / "near.json"))["tetrahedra"].get<int>();
      CHECK((300 < tetrahedra && tetrahedra < 20000));
    }
    CHECK(sandbox.run("info cube.off --write-plc out.poly").exit_code == 0);
    CHECK(sandbox.run("check out.mesh --plc out.poly").exit_code == 0);
  }
  std::string far = cube("1e200");
  far.replace(far.find("\n0 0 0\n"), 7, "\n0 0 1e-200\n");
  sandbox.write("far.off", far);
  check_fails(sandbox, "mesh far.off -o new.mesh", 3, {"too far apart"});
  sandbox.write("tiny.off", cube("1e-310"));
  check_fails(sandbox, "mesh tiny.off -o new.mesh", 3, {"no room"});
}

TEST_CASE("a refined box outside of the input is worth a warning", "[apps]") {
  const Sandbox sandbox;
  const Run run = sandbox.run("mesh --quiet " + shape("cube.poly") + " --refine-box 5,5,5,6,6,6:0.1 -o out.mesh");
  CHECK(run.exit_code == 0);
  CHECK(run.err.starts_with("pgdr: warning: the refined box from 5,5,5 "));
  const Run ball = sandbox.run("mesh --quiet " + shape("cube.poly") + " --size-ball=-2,0,0,0.5:0.1 -o out.mesh");
  CHECK(ball.exit_code == 0);
  CHECK(ball.err.starts_with("pgdr: warning: the refined ball around -2,0,0 "));
}

TEST_CASE("the bad real models", "[apps]") {
  const auto camel = pgdr_test::input_model("a22_bad_camel_selfint.off");
  const auto head = pgdr_test::input_model("a23_bad_head_open.off");
  const auto sheet = pgdr_test::input_model("a24_bad_degtri_sliding.off");
  if (!camel || !head || !sheet) PGDR_SKIP("no models in " << pgdr_test::inputs_folder());
  const Sandbox sandbox;
  check_refused(sandbox, quoted(camel->string()), {"facet"}, false);
  check_refused(sandbox, quoted(head->string()), {"edge"}, false);
  check_refused(sandbox, quoted(sheet->string()), {}, false);
}

TEST_CASE("an output that cannot be written is found before the work starts", "[apps]") {
  const Sandbox sandbox;
  // The input does not exist: had it been looked at first, the exit code would be 3.
  check_fails(sandbox, "mesh missing.poly -o nowhere/out.vtu", 1, {"nowhere"});
  check_fails(sandbox, "mesh missing.poly -o out.vtu --stats nowhere/out.json", 1, {"nowhere"});
  check_fails(sandbox, "info missing.poly --write-plc nowhere/out.poly", 1, {"nowhere"});
  std::filesystem::create_directory(sandbox / "folder.vtu");
  check_fails(sandbox, "mesh missing.poly -o folder.vtu", 1, {"folder.vtu"});
}

TEST_CASE("an existing output survives a failed run", "[apps]") {
  const Sandbox sandbox;
  sandbox.write("out.vtu", "precious");
  check_fails(sandbox, "mesh " + sandbox.write("nan.off", tetrahedron_off("0 nan 1")) + " -o out.vtu", 3, {});
  CHECK(file_text(sandbox / "out.vtu") == "precious");
}
