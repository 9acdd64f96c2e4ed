// SPDX-License-Identifier: GPL-3.0-or-later
// Options that make no sense: exit code 2 and one sentence, before anything is read or written.
#include <string>

#include "program.h"

using pgdr_test::check_fails;
using pgdr_test::Run;
using pgdr_test::Sandbox;
using pgdr_test::shape;

TEST_CASE("help and version", "[apps]") {
  const Sandbox sandbox;
  const Run version = sandbox.run("--version");
  CHECK(version.exit_code == 0);
  CHECK(version.out.rfind("pgdr ", 0) == 0);
  CHECK(version.err.empty());
  const Run help = sandbox.run("--help");
  CHECK(help.exit_code == 0);
  for (const char* word : {"mesh", "check", "info"}) CHECK(help.out.find(word) != std::string::npos);
  const Run mesh_help = sandbox.run("mesh --help");
  CHECK(mesh_help.exit_code == 0);
  for (const char* option : {"--size", "--refine-box", "--radius-edge-ratio", "--coplanar-tolerance",
                             "--triangulate", "--ignore-region-sizes", "--min-edge-length", "--max-vertices",
                             "--threads", "--verify", "--quiet", "--stats", "--nested", "--output"})
    CHECK(mesh_help.out.find(option) != std::string::npos);
}

TEST_CASE("a command line that is incomplete or unknown", "[apps]") {
  const Sandbox sandbox;
  check_fails(sandbox, "", 2, {"command"});
  check_fails(sandbox, "knit", 2, {"no command knit", "mesh", "view"});
  check_fails(sandbox, "mesh " + shape("cube.poly"), 2, {"-o"});
  check_fails(sandbox, "mesh -o out.vtu", 2, {"INPUT"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.vtu --fast", 2, {"--fast"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.vtu --siez 0.5", 2, {"no option --siez", "did you mean --size?"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " --siez 0.5", 2, {"did you mean --size?"});  // -o is missing, too
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.vtu --max-memroy=4G", 2, {"did you mean --max-memory?"});
  // As of a variable that is not set.
  for (const char* option : {"--size", "--min-dihedral", "--tolerance", "--max-vertices", "--time-limit", "--stats", "--trace"})
    check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.vtu " + option + " ''", 2, {option, "empty"});
  check_fails(sandbox, "check out.mesh --min-dihedral ''", 2, {"--min-dihedral", "empty"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " " + shape("cube.poly") + " -o out.vtu", 2,
              {"cube.poly"});
  check_fails(sandbox, "check", 2, {"MESH"});
  check_fails(sandbox, "info", 2, {"INPUT"});
}

TEST_CASE("options of mesh that make no sense", "[apps]") {
  const Sandbox sandbox;
  const std::string mesh = "mesh " + shape("cube.poly") + " -o out.vtu ";
  for (const char* value : {"0", "-1", "nan", "inf", "abc", "''"})
    check_fails(sandbox, mesh + "--size=" + value, 2, {"--size"});
  check_fails(sandbox, mesh + "--size -1", 2, {"--size"});
  check_fails(sandbox, mesh + "--radius-edge-ratio 1.9", 2, {"--radius-edge-ratio", "at least 2", "because"});
  check_fails(sandbox, mesh + "--radius-edge-ratio nan", 2, {"--radius-edge-ratio"});
  check_fails(sandbox, mesh + "--coplanar-tolerance=-1", 2, {"--coplanar-tolerance"});
  check_fails(sandbox, mesh + "--coplanar-tolerance 1", 2, {"--coplanar-tolerance"});
  check_fails(sandbox, mesh + "--tolerance 2", 2, {"--tolerance", "diagonal", "1.732"});
  check_fails(sandbox, mesh + "--min-edge-length 0", 2, {"--min-edge-length"});
  check_fails(sandbox, mesh + "--max-vertices 0", 2, {"--max-vertices"});
  check_fails(sandbox, mesh + "--max-vertices=-5", 2, {"--max-vertices"});
  for (const char* value : {"-1", "1.5", "many", "1025", "99999999999"}) {
    check_fails(sandbox, mesh + "--threads=" + value, 2, {"--threads", "1024", value});
    check_fails(sandbox, std::string("check out.mesh --threads=") + value, 2, {"--threads", "1024", value});
  }
  for (const char* value : {"0", "much", "-4G", "1e9", "4 elephants"})
    check_fails(sandbox, mesh + "--max-memory=" + pgdr_test::quoted(value), 2, {"--max-memory", value});
  for (const char* value : {"0", "-1", "soon", "inf"}) check_fails(sandbox, mesh + "--time-limit=" + value, 2, {"--time-limit"});
  for (const char* value : {"0", "8", "50"}) check_fails(sandbox, mesh + "--octree-depth " + value, 2, {"--octree-depth"});
  check_fails(sandbox, mesh + "--nested sometimes", 2, {"--nested"});
  check_fails(sandbox, mesh + "--refine-box 0,0,0,1,1,1", 2, {"--refine-box"});
  check_fails(sandbox, mesh + "--refine-box 0,0,0,1,1,0:0.1", 2, {"--refine-box", "empty"});
  check_fails(sandbox, mesh + "--refine-box 0,0,0,1,1,1:0", 2, {"--refine-box", "positive"});
  check_fails(sandbox, mesh + "--size-ball 0,0,0,1", 2, {"--size-ball", "x,y,z,r:R"});
  check_fails(sandbox, mesh + "--size-near-surface 1:2", 2, {"--size-near-surface", "R0:R1:D"});
  check_fails(sandbox, mesh + "--size-near-surface 2:1:1", 2, {"--size-near-surface", "R0 <= R1"});
  check_fails(sandbox, mesh + "--size-near-surface 1:2:1", 2, {"--size-near-surface", "less than D"});
  check_fails(sandbox, mesh + "--gradation 0", 2, {"--gradation", "positive"});
  check_fails(sandbox, mesh + "--gradation 1 --refine-box 0,0,0,1,1,1:0.1", 2, {"--gradation", "less than 1"});
  check_fails(sandbox, mesh + "--gradation 0.5", 2, {"--gradation", "--size-ball"});
  check_fails(sandbox, mesh + "--size-ball 0,0,0,0:1", 2, {"--size-ball", "--gradation"});
}

TEST_CASE("outputs that make no sense", "[apps]") {
  const Sandbox sandbox;
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.stl", 2, {"out.stl", ".vtu", ".mesh"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out", 2, {"'out'"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.vtu -o out.stl", 2, {"out.stl"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.vtu -o ./out.vtu", 2, {"out.vtu", "twice"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.ele -o out.ele", 2, {"out.ele", "twice"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.msh --gmsh-format 3", 2, {"--gmsh-format", "4.1-ascii", "'3'"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.vtu --gmsh-format 2.2", 2, {"--gmsh-format", ".msh"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.msh -o out.mesh --vtu-triangles", 2, {"--vtu-triangles", ".vtu"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.msh --vtu-compression 9", 2, {"--vtu-compression", ".vtu"});
  check_fails(sandbox, "mesh " + shape("cube.poly") + " -o out.msh --markers-from colors", 2, {"--markers-from colors", ".off or .ply"});
  check_fails(sandbox, "info " + shape("cube.poly") + " --write-plc out.off", 2, {"out.off", ".poly"});
  check_fails(sandbox, "check out.vtu", 2, {"out.vtu", ".mesh"});

  const std::string cube = pgdr_test::file_text(pgdr_test::data_file("cube.poly"));
  sandbox.write("cube.poly", cube);
  check_fails(sandbox, "mesh cube.poly -o out.vtu --stats cube.poly", 2, {"cube.poly", "overwritten"});
  check_fails(sandbox, "info cube.poly --write-plc cube.poly", 2, {"cube.poly", "overwritten"});
  CHECK(pgdr_test::file_text(sandbox / "cube.poly") == cube);
  // The vertices may be in a file of their own, and .ele is written with one of that name.
  const std::string nodes = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  const std::string facets = "4 0\n1\n3 1 2 3\n1\n3 1 2 4\n1\n3 2 3 4\n1\n3 3 1 4\n0\n0\n";
  sandbox.write("apart.node", nodes);
  sandbox.write("apart.poly", "0 3 0 0\n" + facets);
  check_fails(sandbox, "mesh apart.poly -o apart.ele", 2, {"apart.node", "overwritten"});
  CHECK(pgdr_test::file_text(sandbox / "apart.node") == nodes);
  sandbox.write("whole.poly", nodes + facets);
  for (int time = 0; time < 2; ++time) CHECK(sandbox.run("mesh whole.poly -o whole.ele --quiet").exit_code == 0);
}
