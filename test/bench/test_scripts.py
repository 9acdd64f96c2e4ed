#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/scaling.py and bench/peers.py, run with programs that only pretend to make meshes, and the angles of bench/quality.py."""

import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
failures = []

PRETENDER = """#!{python} -B
import json, sys
words = dict(zip(sys.argv, sys.argv[1:]))
threads = int(words.get("--threads", 1))
if {exit_code} != 0:
    print("no mood today")
    sys.exit({exit_code})
open(words.get("-o", "cube.1.mesh"), "w").write("MeshVersionFormatted 2\\nTetrahedra\\n{count}\\n1 2 3 4 0\\nEnd\\n")
if "--stats" in words:
    seconds = {{"refinement": 2 / threads, "total": 1 + 2 / threads}}
    json.dump({{"tetrahedra": {count}, "threads": threads, "seconds": seconds, "peak_memory_bytes": 1000,
               "mesh_checksum": "{checksum}".replace("T", str(threads))}}, open(words["--stats"], "w"))
"""


def pretender(folder, name, count=1000, checksum="same", exit_code=0):
    path = pathlib.Path(folder) / name
    path.write_text(PRETENDER.format(python=sys.executable, count=count, checksum=checksum, exit_code=exit_code))
    path.chmod(0o755)
    return str(path)


def check(script, words, exit_code, expected):
    run = subprocess.run([sys.executable, "-B", ROOT / "bench" / script, "--repetitions", "2", *words],
                         capture_output=True, text=True, check=False)
    text = run.stdout + run.stderr
    lacking = [part for part in expected if part not in text]
    if run.returncode != exit_code or lacking:
        failures.append(f"{script} {words}: exit code {run.returncode}, lacks {lacking}\n{text}")
    return run.stdout


def check_angles():
    """Of the regular tetrahedron, the corner of a cube, and a flat one, where NumPy and meshio are installed."""
    sys.path.insert(0, str(ROOT / "bench"))
    try:
        import numpy
        from quality import dihedral_angles
    except ImportError as error:
        print(f"left out: {error}")
        return
    corners = numpy.array([[[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
                           [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]], dtype=float)
    found = numpy.sort(dihedral_angles(corners), axis=1)
    wanted = [[70.5287794] * 6, [54.7356103] * 3 + [90] * 3, [0] * 4 + [180] * 2]
    if not numpy.allclose(found, wanted):
        failures.append(f"quality.py: angles {found}")


def main():
    check_angles()
    with tempfile.TemporaryDirectory() as folder:
        same = pretender(folder, "same")
        differs = pretender(folder, "differs", checksum="checksum-T")
        fails = pretender(folder, "fails", exit_code=4)

        check("scaling.py", ["--pgdr", same], 0,
              ["cube.poly", "winged_body_in_box.poly", "2.00 x as fast", "reached", "All 4 meshes are the same"])
        check("scaling.py", ["--pgdr", differs, "--threads", "1,2,4"], 1, ["differ", "checksum-4"])
        check("scaling.py", ["--pgdr", fails], 1, ["failed: cube", "exit code 4", "no mood today"])
        check("scaling.py", ["--pgdr", f"{folder}/nobody"], 1, ["failed: cube"])
        check("scaling.py", ["--threads", "1,x"], 2, ["--threads"])

        peer = ["--gmsh", f"{folder}/nobody", "--mesh-3", fails, "--pgdr", same]
        out = check("peers.py", [*peer, "--tetgen", pretender(folder, "close", count=1020)], 1,
                    ["skipped: Gmsh", "failed: CGAL Mesh_3", "exit code 4", "| pgdr, 2 threads | 1,000 |",
                     "| TetGen, 1 thread | 1,020 |"])
        if "Gmsh" in out or "Mesh_3" in out or "count differs" in out:
            failures.append("peers.py: a peer without figures is in the table, or a fair count is unfair\n" + out)
        far = pretender(folder, "far", count=1040)
        check("peers.py", ["--only", "pgdr-1,tetgen", "--pgdr", same, "--tetgen", far], 0,
              ["the count differs by more than 3%"])
        check("peers.py", ["--only", "pgdr-3"], 2, ["there is no pgdr-3"])
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
