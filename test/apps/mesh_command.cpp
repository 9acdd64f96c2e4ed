// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>
#include <tuple>

#include <nlohmann/json.hpp>

#include "program.h"

using nlohmann::json;
using pgdr_test::file_text;
using pgdr_test::Run;
using pgdr_test::Sandbox;
using pgdr_test::shape;

TEST_CASE("mesh writes every output and a summary", "[apps]") {
  const Sandbox sandbox;
  const Run run = sandbox.run("mesh " + shape("cube.poly") + " --size 0.3 -o out.vtu -o out.mesh");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  CHECK(run.err.empty());  // no progress line where stderr is no terminal
  CHECK(sandbox.names() == std::set<std::string>{"out.vtu", "out.mesh"});
  for (const char* word : {"vertices", "tetrahedra", "radius-edge ratio", "dihedral", "seconds", "memory"})
    CHECK(run.out.find(word) != std::string::npos);
}

TEST_CASE("mesh --quiet says nothing", "[apps]") {
  const Sandbox sandbox;
  const Run run = sandbox.run("mesh --quiet " + shape("l_block.poly") + " -o out.mesh");
  CHECK(run.exit_code == 0);
  CHECK(run.out.empty());
  CHECK(run.err.empty());
  CHECK(sandbox.names() == std::set<std::string>{"out.mesh"});
}

TEST_CASE("the keys of --stats are stable", "[apps]") {
  const Sandbox sandbox;
  const std::string arguments =
      "mesh " + shape("two_regions.poly") + " --quiet --verify --threads 1 --size 0.5 -o out.mesh --stats ";
  REQUIRE(sandbox.run(arguments + "a.json").exit_code == 0);
  const json stats = json::parse(file_text(sandbox / "a.json"));
  for (const char* key : {"vertices", "tetrahedra", "triangles", "edges", "exempt_tetrahedra", "threads",
                          "peak_memory_bytes"}) {
    INFO(key);
    REQUIRE(stats.contains(key));
    CHECK(stats[key].is_number_unsigned());
  }
  for (const char* key :
       {"max_radius_edge_ratio", "mean_radius_edge_ratio", "max_circumradius", "min_dihedral_deg", "max_dihedral_deg"}) {
    INFO(key);
    REQUIRE(stats.contains(key));
    CHECK(stats[key].get<double>() > 0);
  }
  for (const char* key : {"edge_ratio", "aspect_ratio", "mean_ratio", "scaled_jacobian"}) {
    INFO(key);
    CHECK(stats[key]["worst"].get<double>() > 0);
    CHECK(stats[key]["mean"].get<double>() > 0);
  }
  CHECK(stats["dihedral_histogram"]["counts"].size() == 36);
  CHECK(stats["vertices"].get<int>() > 12);
  CHECK(stats["max_radius_edge_ratio"].get<double>() <= 2 + 1e-9);
  CHECK(stats["max_circumradius"].get<double>() <= 0.5 + 1e-9);
  CHECK(stats["exempt_tetrahedra"] == 0);
  CHECK(stats["threads"] == 1);
  CHECK(stats["stop"] == "finished");
  CHECK(stats["peak_memory_bytes"].get<double>() > 1e6);
  CHECK(stats["mesh_checksum"].get<std::string>().size() == 16);
  double sum = 0;
  for (const auto& [phase, seconds] : stats["seconds"].items()) {
    if (phase != "total") sum += seconds.get<double>();
  }
  CHECK(stats["seconds"]["total"].get<double>() >= 0.9 * sum);
  REQUIRE(stats["regions"].size() == 2);
  CHECK(stats["regions"][0]["id"] == 10);
  CHECK(stats["regions"][1]["id"] == 20);
  for (const json& region : stats["regions"]) CHECK(region["volume"].get<double>() == Approx(1));
  // The second region has a volume bound in the file.
  CHECK(stats["regions"][1]["tetrahedra"].get<int>() >= 256);

  REQUIRE(sandbox.run(arguments + "b.json").exit_code == 0);
  CHECK(json::parse(file_text(sandbox / "b.json"))["mesh_checksum"] == stats["mesh_checksum"]);
  REQUIRE(sandbox.run(arguments + "c.json --ignore-region-sizes").exit_code == 0);
  CHECK(json::parse(file_text(sandbox / "c.json"))["tetrahedra"] < stats["tetrahedra"]);
}

TEST_CASE("the outputs are the same for every number of threads", "[apps]") {
  const Sandbox sandbox;
  const auto run = [&sandbox](const std::string& threads) {
    const Run mesh = sandbox.run("mesh " + shape("two_regions.poly") + " --quiet --size 0.15" + threads +
                                 " -o out.mesh -o out.vtu --stats s.json");
    INFO(mesh.err);
    REQUIRE(mesh.exit_code == 0);
    const Run check = sandbox.run("check out.mesh" + threads + " --plc " + shape("two_regions.poly"));
    CHECK(check.exit_code == 0);
    const json stats = json::parse(file_text(sandbox / "s.json"));
    return std::tuple(stats["threads"].get<unsigned>(), file_text(sandbox / "out.mesh"), file_text(sandbox / "out.vtu"),
                      stats["mesh_checksum"].get<std::string>(), check.out);
  };
  auto expected = run(" --threads 1");
  CHECK(std::get<0>(expected) == 1);
  for (const unsigned threads : {2u, 3u, 8u}) {
    std::get<0>(expected) = threads;
    CHECK((run(" --threads " + std::to_string(threads)) == expected));
  }
  const auto all = run("");
  CHECK(std::get<0>(all) >= 1);
  CHECK((run(" --threads 0") == all));
  std::get<0>(expected) = std::get<0>(all);
  CHECK((all == expected));
}

TEST_CASE("sizes bound the circumradii", "[apps]") {
  const Sandbox sandbox;
  const auto tetrahedra = [&sandbox](const std::string& options) {
    const Run run =
        sandbox.run("mesh " + shape("cube.poly") + " --quiet -o out.mesh --stats s.json " + options);
    REQUIRE(run.exit_code == 0);
    return json::parse(file_text(sandbox / "s.json"))["tetrahedra"].get<int>();
  };
  const int coarse = tetrahedra("--size 0.4");
  const int corner = tetrahedra("--size 0.4 --refine-box 0,0,0,0.25,0.25,0.25:0.1");
  const int fine = tetrahedra("--size 0.1");
  CHECK(coarse < corner);
  CHECK(corner < fine);
  CHECK(tetrahedra("--refine-box=-1,-1,-1,2,2,2:0.1 --refine-box -2,-2,-2,0.5,2,2:0.4") == fine);
  const int ball = tetrahedra("--size 0.4 --size-ball 0.1,0.1,0.1,0.3:0.1");
  CHECK((coarse < ball && ball < fine));
  const int graded = tetrahedra("--size 0.4 --size-ball 0.1,0.1,0.1,0.3:0.1 --gradation 0.2");
  CHECK((ball < graded && graded < fine));
  CHECK(tetrahedra("--size-ball 0.5,0.5,0.5,0:0.1 --gradation 1e-9") == fine);  // hardly grows
  const int near = tetrahedra("--size-near-surface 0.1:0.4:0.4");
  CHECK((2 * coarse < near && near < fine));
  CHECK(tetrahedra("--size-near-surface 0.1:0.1:1") == fine);
  CHECK(tetrahedra("--size 0.1 --size-near-surface 0.4:0.4:1") == fine);
}

TEST_CASE("a vertex budget stops the run with exit code 4 and a valid mesh", "[apps]") {
  const Sandbox sandbox;
  const Run run = sandbox.run("mesh " + shape("cube.poly") +
                              " --size 0.05 --max-vertices 500 -o out.mesh --stats s.json");
  CHECK(run.exit_code == 4);
  CHECK(run.err.rfind("pgdr: ", 0) == 0);
  const json stats = json::parse(file_text(sandbox / "s.json"));
  CHECK(stats["stop"] == "vertex_budget");
  CHECK(stats["vertices"].get<int>() <= 500);
  const Run check = sandbox.run("check out.mesh --radius-edge-ratio 1e9 --plc " + shape("cube.poly"));
  INFO(check.out << check.err);
  CHECK(check.exit_code == 0);
}

TEST_CASE("a run that stops before there are tetrahedra leaves the file alone", "[apps]") {
  const auto elephant = pgdr_test::input_model("a09_elephant.off");
  if (!elephant) return;
  const Sandbox sandbox;
  sandbox.write("keep.mesh", "precious");
  const Run run = sandbox.run("mesh --quiet " + pgdr_test::quoted(elephant->string()) + " -o keep.mesh --max-vertices 4000");
  CHECK(run.exit_code == 4);
  CHECK(run.err.find("nothing was written") != std::string::npos);
  CHECK(file_text(sandbox / "keep.mesh") == "precious");
}

TEST_CASE("a tolerance is measured by check, and named where a run stops at needles", "[apps]") {
  const auto wing = pgdr_test::input_model("a04_anchor.off");
  if (!wing) return;
  const Sandbox sandbox;
  const std::string model = pgdr_test::quoted(wing->string());
  const Run stopped = sandbox.run("mesh --quiet " + model + " -o out.mesh --max-vertices 2000");
  CHECK(stopped.exit_code == 4);
  CHECK(stopped.err.find("--tolerance 1e-5d") != std::string::npos);
  CHECK(sandbox.run("mesh --quiet " + model + " -o exact.mesh --stats exact.json").exit_code == 0);
  CHECK(sandbox.run("mesh --quiet " + model + " -o out.mesh --tolerance 1e-4d --stats out.json").exit_code == 0);
  const auto count = [&](const char* file) { return json::parse(file_text(sandbox / file))["tetrahedra"].get<int>(); };
  CHECK(count("out.json") < 0.9 * count("exact.json"));
  const Run check = sandbox.run("check out.mesh --tolerance 1e-4d --plc " + model);
  CHECK(check.exit_code == 0);
  CHECK(check.out.find("ok    tolerance ") != std::string::npos);
  // Against the file as it is, the mesh is none of it.
  CHECK(sandbox.run("check out.mesh --plc " + model).exit_code == 1);
}

TEST_CASE("limits stop the run with exit code 4, say why, and count what is left", "[apps]") {
  const Sandbox sandbox;
  const std::string mesh = "mesh " + shape("cube.poly") + " -o out.mesh --stats - ";
  for (const auto& [limit, reason] : {std::pair{"--size 0.002 --time-limit 0.3 --max-vertices 1000000000", "time_limit"},
                                      {"--size 0.002 --max-memory 300M --max-vertices 1000000000", "memory_limit"},
                                      {"--size 0.02 --max-memory 3 --max-vertices 1000000000", "memory_limit"},
                                      {"--size 0.02 --min-edge-length 0.3", "min_edge_length"},
                                      {"--size 0.02 --max-vertices 500", "vertex_budget"}}) {
    const Run run = sandbox.run(mesh + limit);
    CAPTURE(limit, run.err);
    CHECK(run.exit_code == 4);
    CHECK(run.err.starts_with("pgdr: stopped at the "));
    const json stats = json::parse(run.out);  // and nothing else
    CHECK(stats["stop"] == reason);
    CHECK(stats["exempt_tetrahedra"] == 0);
    CHECK(stats["unrefined_tetrahedra"].get<int>() > 0);
    CHECK(stats["steiner_vertices"].get<std::size_t>() + 8 == stats["vertices"].get<std::size_t>());
    CHECK(stats["peak_memory_bytes"].get<double>() < 350e6);
    CHECK(sandbox.run("check out.mesh --radius-edge-ratio 1e9 --plc " + shape("cube.poly")).exit_code == 0);
  }
}

TEST_CASE("Ctrl-C stops the run with exit code 4 and a valid mesh", "[apps]") {
  const Sandbox sandbox;
  const std::string program = pgdr_test::app().string();
  const std::string input = pgdr_test::data_file("cube.poly").string();
  const std::string output = (sandbox / "out.mesh").string();
  // Not through a shell: it would have background jobs ignore the signal.
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, 2);
    execl(program.c_str(), program.c_str(), "mesh", input.c_str(), "--size", "0.004", "--quiet", "-o",
          output.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // into the refinement, which takes minutes
  REQUIRE(kill(child, SIGINT) == 0);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 4);
  CHECK(sandbox.names() == std::set<std::string>{"out.mesh"});
  CHECK(file_text(output).find("Tetrahedra") != std::string::npos);
}

TEST_CASE("seeds of the command line make holes, name regions and bound their sizes", "[apps]") {
  const Sandbox sandbox;
  const std::string model = shape("two_regions.poly");
  const auto tetrahedra = [&](const std::string& seeds) {
    const Run run = sandbox.run("mesh " + model + " -o out.mesh --stats out.json --quiet --ignore-region-sizes " + seeds);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(sandbox.run("check out.mesh --plc " + model + " " + seeds).exit_code == 0);
    return nlohmann::json::parse(file_text(sandbox / "out.json")).at("tetrahedra").get<std::size_t>();
  };
  const auto info = [&](const std::string& seeds) { return sandbox.run("info " + model + " " + seeds).out; };
  const std::size_t both = tetrahedra("");
  CHECK(tetrahedra("--hole 0.25,0.5,0.5") < both);
  CHECK(tetrahedra("--region 0.25,0.5,0.5:77:0.1") > 2 * both);
  CHECK(info("--hole 0.25,0.5,0.5").find("region 10") == std::string::npos);
  // The first seed of a volume counts, and those of the command line come before those of the file.
  const std::string named = info("--region 0.25,0.5,0.5:77");
  CHECK(named.find("region 77") != std::string::npos);
  CHECK(named.find("region 10") == std::string::npos);
  CHECK(named.find("region 20") != std::string::npos);
}
